#pragma once

#include "delmesh/base/vec3.hpp"

#include <algorithm>
#include <array>

namespace delmesh {

struct TrianglePoint {
    std::array<double, 3> weights{};  ///< barycentric
    double distance2 = 0;
};

/// The point of the triangle abc that is nearest to p. Source: Ericson 2005, section 5.1.5.
inline TrianglePoint nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto at = [&](double wa, double wb, double wc) {
        return TrianglePoint{{wa, wb, wc}, squared_norm(p - (a * wa + b * wb + c * wc))};
    };
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return at(1, 0, 0);
    const Vec3 bp = p - b;
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return at(0, 1, 0);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        const double t = d1 / (d1 - d3);
        return at(1 - t, t, 0);
    }
    const Vec3 cp = p - c;
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return at(0, 0, 1);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        const double t = d2 / (d2 - d6);
        return at(1 - t, 0, t);
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return at(0, 1 - t, t);
    }
    const double scale = 1 / (va + vb + vc);
    return at(1 - (vb + vc) * scale, vb * scale, vc * scale);
}

}  // namespace delmesh
