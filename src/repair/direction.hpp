#pragma once
// Lengths and directions that neither overflow nor underflow. For choices of taste only: what is valid is decided
// exactly elsewhere. No functions whose bits differ between systems.

#include "delmesh/base/vec3.hpp"

#include <cmath>

namespace delmesh::repairing {

/// b - a, or half of it where that would overflow.
inline Vec3 difference(const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    return is_finite(d) ? d : b * 0.5 - a * 0.5;
}

inline double largest_component(const Vec3& v) {
    return std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
}

/// v times a power of two, so that its largest component lies in [1, 2); zero stays.
inline Vec3 normalised(const Vec3& v) {
    const double largest = largest_component(v);
    if (!(largest > 0)) return v;
    const int exponent = -std::ilogb(largest);
    return {std::scalbn(v.x, exponent), std::scalbn(v.y, exponent), std::scalbn(v.z, exponent)};
}

inline Vec3 direction(const Vec3& a, const Vec3& b) {
    return normalised(difference(a, b));
}

/// Unit length but for rounding; zero stays.
inline Vec3 unit(const Vec3& v) {
    const Vec3 n = normalised(v);
    const double length = std::sqrt(squared_norm(n));
    return length > 0 ? n * (1 / length) : n;
}

}  // namespace delmesh::repairing
