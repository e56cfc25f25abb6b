#pragma once
// Angles between vectors of any scale, as directions in the plane (cosine, sine up to a common factor).

#include "delmesh/base/vec3.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace delmesh::measure {

inline constexpr double degrees_per_radian = 180 / std::numbers::pi;

inline double largest_component(const Vec3& a) {
    return std::max(std::fabs(a.x), std::max(std::fabs(a.y), std::fabs(a.z)));
}

/// b - a, halved where the difference is too large for a double: only its direction counts.
inline Vec3 direction(const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    return is_finite(d) ? d : b * 0.5 - a * 0.5;
}

/// The vector times the power of two that brings its largest component into [1,2); zero stays.
inline Vec3 normalised(const Vec3& a) {
    const double largest = largest_component(a);
    if (largest == 0) return a;
    const int exponent = std::ilogb(largest);
    return {std::scalbn(a.x, -exponent), std::scalbn(a.y, -exponent), std::scalbn(a.z, -exponent)};
}

/// An angle in [0, 2 pi) as a direction. Angles add as complex numbers multiply.
struct PlaneDirection {
    double cosine = 1;
    double sine = 0;

    /// In (-pi, pi].
    [[nodiscard]] double radians() const { return std::atan2(sine, cosine); }
    friend PlaneDirection operator*(PlaneDirection a, PlaneDirection b) {
        return {a.cosine * b.cosine - a.sine * b.sine, a.cosine * b.sine + a.sine * b.cosine};
    }
};

/// The angle between two vectors whose squares neither over- nor underflow.
inline PlaneDirection angle_between(const Vec3& a, const Vec3& b) {
    return {dot(a, b), std::sqrt(squared_norm(cross(a, b)))};
}

/// The angle at u in the triangle (u, p, q), in [0, pi]; both components are at most 12 in size.
inline PlaneDirection angle_at(const Vec3& u, const Vec3& p, const Vec3& q) {
    return angle_between(normalised(direction(u, p)), normalised(direction(u, q)));
}

}  // namespace delmesh::measure
