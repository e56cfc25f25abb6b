#include "simplify/paper_region.hpp"

#include <cmath>

namespace delmesh {
namespace {

/// Parallel to pq, at `height` from its middle, upright on the plane of p, q and `towards`.
std::optional<HalfSpace> beside(const Vec3& p, const Vec3& q, double height, const Vec3& towards) {
    const Vec3 middle = (p + q) * 0.5;
    const Vec3 side = q - p;
    const double side2 = squared_norm(side);
    if (!(side2 > 0)) return std::nullopt;
    const Vec3 arm = towards - middle;
    const Vec3 away = arm - side * (dot(arm, side) / side2);
    const double length = std::sqrt(squared_norm(away));
    if (!(length > 0)) return std::nullopt;
    const Vec3 normal = away * (1 / length);
    return HalfSpace{normal, dot(normal, middle) + height};
}

}  // namespace

std::optional<HalfSpace> outside_diametral_sphere(const Vec3& p, const Vec3& q, const Vec3& towards) {
    return beside(p, q, 0.5 * std::sqrt(squared_norm(q - p)), towards);
}

std::optional<HalfSpace> outside_chordal_spheroid(const Vec3& p, const Vec3& q, const Vec3& other,
                                                  const Vec3& towards) {
    const Vec3 a = p - other;
    const Vec3 b = q - other;
    const double lengths = std::sqrt(squared_norm(a) * squared_norm(b));
    const double reach = lengths + dot(a, b);
    if (!(reach > 0)) return std::nullopt;  // an angle of pi: nowhere is far enough
    const double tan_half = std::sqrt(squared_norm(cross(a, b))) / reach;
    return beside(p, q, 0.5 * std::sqrt(squared_norm(q - p)) * tan_half, towards);
}

std::optional<std::array<HalfSpace, 2>> between_neighbours(const Vec3& o, const Vec3& p, const Vec3& q) {
    const Vec3 plane = cross(o - p, q - p);
    const double area2 = squared_norm(plane);
    const Vec3 chord = q - o;
    const double chord2 = squared_norm(chord);
    if (!(area2 > 0) || !(chord2 > 0)) return std::nullopt;
    // r sees oq under pi minus the angle at p, from the side of oq that p is not on, as far from o as from q.
    const double lengths = std::sqrt(squared_norm(o - p) * squared_norm(q - p));
    const double tan_half = std::sqrt(area2) / (lengths + dot(o - p, q - p));
    const Vec3 away = cross(plane, chord) * (1 / std::sqrt(area2));  // |chord| long, to the side of p or not
    const Vec3 middle = (o + q) * 0.5;
    const double side = dot(away, p - middle) > 0 ? -0.5 : 0.5;
    const Vec3 r = middle + away * (side * tan_half);
    const auto through = [&](const Vec3& end, const Vec3& inner) {
        Vec3 normal = cross(plane, r - end);
        const double length = std::sqrt(squared_norm(normal));
        if (!(length > 0)) return HalfSpace{{}, 1};  // nowhere
        normal = normal * (1 / length);
        if (dot(normal, inner - end) < 0) normal = -normal;
        return HalfSpace{normal, dot(normal, end)};
    };
    // The centre of the circle and the other neighbour lie on the same side of such a chord, or the centre on it.
    return std::array{through(q, o), through(o, q)};
}

HalfSpace right_angle_at(const Vec3& q, const Vec3& p) {
    const Vec3 normal = p - q;
    return {normal, dot(normal, q)};
}

bool find_paper_region(const Star& star, const Vec3& middle, std::vector<HalfSpace>& out) {
    out.clear();
    const auto add = [&](const std::optional<HalfSpace>& h) {
        if (h) out.push_back(*h);
        return h.has_value();
    };
    for (std::size_t i = 0; i < star.face_count(); ++i) {
        const Star::Corner& corner = star.ring[i];
        const Vec3& q = star.ring[star.after(i)].point;
        const bool ok = corner.outer.valid()
                            ? add(outside_chordal_spheroid(corner.point, q, corner.outer_point, middle))
                            : add(outside_diametral_sphere(corner.point, q, middle));
        if (!ok) return false;
    }
    for (std::size_t i = 0; i < star.ring.size(); ++i) {
        const Vec3& p = star.ring[i].point;
        if (!star.closed && i == 0) {
            out.push_back(right_angle_at(star.ring[1].point, p));
        } else if (!star.closed && i + 1 == star.ring.size()) {
            out.push_back(right_angle_at(star.ring[i - 1].point, p));
        } else {
            const auto pair = between_neighbours(star.ring[star.before(i)].point, p, star.ring[star.after(i)].point);
            if (!pair) return false;
            out.insert(out.end(), pair->begin(), pair->end());
        }
    }
    return true;
}

}  // namespace delmesh
