#pragma once
// The distance of a point and a triangle, accurate for slivers, caps and triangles without area.

#include "delmesh/base/vec3.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh::measure {

/// A triangle whose longest edge is ab.
struct Triangle {
    Vec3 a, b, c;
};

/// The triangle turned so that its longest edge comes first; the first of equals.
inline Triangle longest_first(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double ab = squared_norm(b - a), bc = squared_norm(c - b), ca = squared_norm(a - c);
    if (ab >= bc && ab >= ca) return {a, b, c};
    return bc >= ca ? Triangle{b, c, a} : Triangle{c, a, b};
}

/// The parameter in [0,1] of the point nearest to s + ap on the segment from s to s + ab.
inline double nearest_parameter(const Vec3& ap, const Vec3& ab) {
    const double along = dot(ap, ab), length2 = squared_norm(ab);
    return along <= 0 ? 0 : along >= length2 ? 1 : along / length2;
}

inline double segment_squared_distance(const Vec3& ap, const Vec3& ab) {
    return squared_norm(ap - nearest_parameter(ap, ab) * ab);
}

/// Where a point lies over a triangle: in a frame of the longest edge, the height on it and the normal.
///
/// The height is made orthogonal to the longest edge, and the normal to both. Of a sliver, rounding can then only turn
/// the plane about the long edge, where that does no harm; it can not tilt it along the edge.
struct Foot {
    Vec3 ab, ac, ap, height;
    double x = 0;  ///< the foot is a + x ab + y ac
    double y = 0;
    bool flat = false;  ///< no plane to speak of: the height is below 2^-40 of the longest edge

    Foot(const Vec3& p, const Triangle& t) : ab(t.b - t.a), ac(t.c - t.a), ap(p - t.a) {
        const double inverse = 1 / squared_norm(ab);
        const double foot = dot(ac, ab) * inverse;
        height = ac - foot * ab;
        double height2 = squared_norm(height);
        if (height2 * inverse < 0x1p-20) {  // cancellation has left a part along ab: once more
            height = height - (dot(height, ab) * inverse) * ab;
            height2 = squared_norm(height);
        }
        flat = !(height2 * inverse > 0x1p-80 && height2 > 0x1p-400);
        y = dot(ap, height) / height2;
        x = dot(ap, ab) * inverse - y * foot;
    }

    [[nodiscard]] bool is_inside() const { return x >= 0 && y >= 0 && x + y <= 1; }
    /// The squared distance from the plane.
    [[nodiscard]] double squared_elevation() const {
        const Vec3 normal = cross(ab, height);
        const double elevation = dot(normal, ap);
        return elevation * elevation / squared_norm(normal);
    }
};

/// The squared distance of p and the triangle, within a few units of rounding of |p - a| + |ab|.
inline double squared_distance(const Vec3& p, const Triangle& t) {
    const Foot foot(p, t);
    if (!foot.flat && foot.is_inside()) return foot.squared_elevation();
    // The nearest point lies on an edge that is seen from the foot.
    const bool all = foot.flat;
    double best = std::numeric_limits<double>::infinity();
    if (all || foot.y < 0) best = segment_squared_distance(foot.ap, foot.ab);
    if (all || foot.x < 0) best = std::min(best, segment_squared_distance(foot.ap, foot.ac));
    if (all || foot.x + foot.y > 1) best = std::min(best, segment_squared_distance(p - t.b, t.c - t.b));
    return best;
}

/// A point of the triangle (within rounding of the coordinates) that is nearest to p as nearly as doubles tell.
inline Vec3 nearest_point(const Vec3& p, const Triangle& t) {
    const Foot foot(p, t);
    if (!foot.flat && foot.is_inside()) return t.a + foot.x * foot.ab + foot.y * foot.ac;
    Vec3 best = t.a;
    double best2 = std::numeric_limits<double>::infinity();
    const auto try_segment = [&](const Vec3& s, const Vec3& e) {
        const Vec3 q = s + nearest_parameter(p - s, e - s) * (e - s);
        const double d2 = squared_norm(p - q);
        if (d2 < best2) best = q, best2 = d2;
    };
    try_segment(t.a, t.b);
    try_segment(t.a, t.c);
    try_segment(t.b, t.c);
    return best;
}

/// At least the distance of p and the triangle, but for the rounding of coordinates: q is a point of it.
inline double upper_distance(const Vec3& p, const Triangle& t) {
    return norm(p - nearest_point(p, t));
}

/// At most the distance of p and the triangle, but for the rounding of coordinates: any plane between p and the three
/// corners proves it.
inline double lower_distance(const Vec3& p, const Triangle& t) {
    const Vec3 w = p - nearest_point(p, t);
    const double length = norm(w);
    if (!(length > 0x1p-400)) return 0;
    const double least = std::min(dot(w, p - t.a), std::min(dot(w, p - t.b), dot(w, p - t.c)));
    return std::max(0.0, least / length);
}

}  // namespace delmesh::measure
