#include "measure/piece.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh::measure {
namespace {

/// The largest upper bound of the distance from a corner to the triangle: the distance to one convex set is convex, so
/// no point of the piece is farther from it. `worst` becomes the corner.
double face_bound(const Piece& piece, const Triangle& triangle, std::uint8_t& worst) {
    double largest = -1;
    for (std::uint8_t i = 0; i < 3; ++i) {
        const double d = upper_distance(piece.corner[i], triangle);
        if (d > largest) largest = d, worst = i;
    }
    return largest;
}

double radius_about(const Piece& piece, const Vec3& centre) {
    return std::max(norm(piece.corner[0] - centre),
                    std::max(norm(piece.corner[1] - centre), norm(piece.corner[2] - centre)));
}

/// A proved lower bound of the distance at p, if it may be above `lower`.
double raised(double lower, const Vec3& p, const FaceTree::Nearest& nearest, const FaceTree& to) {
    if (nearest.distance2 <= lower * lower) return lower;
    return std::max(lower, to.lower_distance(p, nearest.triangle));
}

/// A plane through `point`.
struct Plane {
    Vec3 point;
    Vec3 normal;
};

Vec3 unit(const Vec3& v) {
    const double length = norm(v);
    return length > 0 ? (1 / length) * v : v;
}

bool has_corners(const Triangle& t, const Vec3& p, const Vec3& q) {
    const auto is_corner = [&t](const Vec3& x) { return x == t.a || x == t.b || x == t.c; };
    return is_corner(p) && is_corner(q);
}

Vec3 normal_of(const Triangle& t) {
    return unit(cross(t.b - t.a, t.c - t.a));
}

/// The plane on which the distances to the planes of two triangles are equal, on the side of p of both.
Plane equidistant_plane(const Triangle& s, const Triangle& t, const Vec3& p) {
    const Vec3 m = normal_of(s), n = normal_of(t);
    const double to_s = dot(m, p - s.a), to_t = dot(n, p - t.a);
    const Vec3 normal = (to_s < 0 ? -m : m) - (to_t < 0 ? -n : n);
    const double length2 = squared_norm(normal);
    if (length2 < 1e-12) return {};  // parallel, both on one side
    const double excess = std::fabs(to_s) - std::fabs(to_t);
    return {p - excess / length2 * normal, unit(normal)};
}

/// Where the nearest triangle changes: the plane through that side of it beyond which the worst corner lies, upright on
/// it, or halfway to the rival if that lies at the same side. If the corner lies over the triangle, the rival is part
/// of another sheet: then the plane between the two. The zero normal if there is no such plane.
Plane dividing_plane(const Piece& piece, const FaceTree& to) {
    const Triangle& t = to.triangles()[piece.nearest];
    const Triangle& rival = to.triangles()[piece.rival];
    const Vec3 normal = normal_of(t);
    const Vec3& worst = piece.corner[piece.worst];
    const std::array<std::array<Vec3, 2>, 3> sides{{{t.a, t.b}, {t.b, t.c}, {t.c, t.a}}};
    double farthest = 0;
    Plane plane;
    for (const auto& [s, e] : sides) {
        const double beyond = dot(unit(cross(e - s, normal)), worst - s);
        if (beyond <= farthest) continue;
        farthest = beyond;
        Vec3 upright = normal;
        if (piece.rival != piece.nearest && has_corners(rival, s, e)) {
            const Vec3 other = normal_of(rival);
            upright = upright + (dot(other, normal) < 0 ? -other : other);
        }
        plane = {s, unit(cross(e - s, upright))};
    }
    if (farthest == 0 && piece.rival != piece.nearest) return equidistant_plane(t, rival, worst);
    return plane;
}

/// Cuts along a plane; no parts if the plane does not divide the piece well.
Parts cut(const Piece& piece, const Plane& plane) {
    Parts parts;
    const double tolerance = 1e-6 * radius_about(piece, piece.corner[0]);
    std::array<double, 3> side{};
    int positive = 0, negative = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        side[i] = dot(plane.normal, piece.corner[i] - plane.point);
        if (std::fabs(side[i]) <= tolerance) side[i] = 0;
        positive += side[i] > 0;
        negative += side[i] < 0;
    }
    if (positive == 0 || negative == 0) return parts;
    // The corner that is alone on its side; with a corner on the plane, either of the other two.
    const bool alone_positive = positive == 1;
    const auto is_alone = [&](std::size_t i) { return alone_positive ? side[i] > 0 : side[i] < 0; };
    const std::size_t i = is_alone(0) ? 0 : is_alone(1) ? 1 : 2, j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec3 &p = piece.corner[i], &q = piece.corner[j], &r = piece.corner[k];
    const auto crossing = [&](std::size_t other, const Vec3& end) {
        return side[other] == 0 ? end : p + side[i] / (side[i] - side[other]) * (end - p);
    };
    const Vec3 x = crossing(j, q), y = crossing(k, r);
    parts.add(piece, p, x, y);
    if (side[j] == 0 || side[k] == 0) {
        side[j] == 0 ? parts.add(piece, y, q, r) : parts.add(piece, x, q, r);
    } else if (squared_norm(r - x) <= squared_norm(q - y)) {
        parts.add(piece, x, q, r);
        parts.add(piece, x, r, y);
    } else {
        parts.add(piece, x, q, y);
        parts.add(piece, q, r, y);
    }
    return parts;
}

Parts bisect(const Piece& piece) {
    const auto& c = piece.corner;
    const std::array<double, 3> lengths2{squared_norm(c[1] - c[0]), squared_norm(c[2] - c[1]),
                                         squared_norm(c[0] - c[2])};
    const auto i = static_cast<std::size_t>(std::max_element(lengths2.begin(), lengths2.end()) - lengths2.begin());
    const Vec3 &p = c[i], &q = c[(i + 1) % 3], &r = c[(i + 2) % 3];
    const Vec3 middle = 0.5 * (p + q);
    Parts parts;
    parts.add(piece, p, middle, r);
    parts.add(piece, middle, q, r);
    return parts;
}

double longest_side(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::sqrt(std::max(squared_norm(b - a), std::max(squared_norm(c - b), squared_norm(a - c))));
}

}  // namespace

void Parts::add(const Piece& parent, const Vec3& a, const Vec3& b, const Vec3& c) {
    Piece& piece = part[count++];
    piece = parent;
    piece.corner = {a, b, c};
    ++piece.depth;
}

double evaluate(Piece& piece, const FaceTree& to, double lower, double enough) {
    const Vec3 centre = 1.0 / 3 * (piece.corner[0] + piece.corner[1] + piece.corner[2]);
    const FaceTree::Nearest middle = to.nearest(centre, piece.nearest);
    piece.nearest = piece.rival = middle.triangle;
    const Triangle& triangle = to.triangles()[middle.triangle];
    // Distances change no faster than points move.
    piece.upper = std::min(piece.upper, upper_distance(centre, triangle) + radius_about(piece, centre));
    lower = raised(lower, centre, middle, to);
    if (piece.upper <= enough) return lower;
    piece.upper = std::min(piece.upper, face_bound(piece, triangle, piece.worst));
    if (piece.upper <= enough) return lower;
    const Vec3& corner = piece.corner[piece.worst];
    const FaceTree::Nearest at_corner = to.nearest(corner, middle.triangle);
    lower = raised(lower, corner, at_corner, to);
    piece.rival = at_corner.triangle;
    if (piece.rival == piece.nearest) return lower;
    std::uint8_t unused = 0;
    piece.upper = std::min(piece.upper, face_bound(piece, to.triangles()[piece.rival], unused));
    return lower;
}

Parts split(const Piece& piece, const FaceTree& to) {
    constexpr std::uint8_t cuts_between_bisections = 3;
    const Triangle& t = to.triangles()[piece.nearest];
    const bool comparable =
        longest_side(piece.corner[0], piece.corner[1], piece.corner[2]) <= 4 * longest_side(t.a, t.b, t.c);
    if (comparable && piece.cuts < cuts_between_bisections) {
        Parts parts = cut(piece, dividing_plane(piece, to));
        for (std::size_t i = 0; i < parts.count; ++i) ++parts.part[i].cuts;
        if (parts.count > 0) return parts;
    }
    Parts parts = bisect(piece);
    for (std::size_t i = 0; i < parts.count; ++i) parts.part[i].cuts = 0;
    return parts;
}

}  // namespace delmesh::measure
