#include "delmesh/simplify/quadric_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

constexpr double tolerance = 1e-12;

/// How far x is outside of n.x >= offset, for |n| = 1; positive: outside.
double violation(const HalfSpace& h, const Vec3& x) {
    return h.offset - dot(h.normal, x);
}
double slack_allowed(const HalfSpace& h) {
    return tolerance * (1 + std::fabs(h.offset));
}

/// The shortest point on the line point + t direction (|direction| = 1, direction.point = 0) inside all half-spaces.
std::optional<Vec3> shortest_on_line(const Vec3& point, const Vec3& direction, std::span<const HalfSpace> inside) {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    for (const HalfSpace& h : inside) {
        const double slope = dot(h.normal, direction);
        const double rest = violation(h, point);
        if (std::fabs(slope) <= tolerance) {
            if (rest > 4 * slack_allowed(h)) return std::nullopt;
            continue;
        }
        const double t = rest / slope;
        if (slope > 0)
            low = std::max(low, t);
        else
            high = std::min(high, t);
    }
    if (low > high) {
        if (low - high > 8 * tolerance * (1 + std::fabs(low) + std::fabs(high))) return std::nullopt;
        low = high = 0.5 * (low + high);
    }
    return point + direction * std::clamp(0.0, low, high);
}

/// The shortest point on the plane n.x = d inside all half-spaces.
std::optional<Vec3> shortest_on_plane(const HalfSpace& plane, std::span<const HalfSpace> inside) {
    const Vec3& n = plane.normal;
    const Vec3 foot = n * plane.offset;
    Vec3 best = foot;
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const HalfSpace& h = inside[i];
        if (violation(h, best) <= slack_allowed(h)) continue;
        // The line where h's border meets the plane.
        const double along = dot(n, h.normal);
        const Vec3 in_plane = h.normal - n * along;
        const double length2 = squared_norm(in_plane);
        if (length2 <= tolerance * tolerance) {
            if (violation(h, foot) > 4 * slack_allowed(h)) return std::nullopt;
            continue;
        }
        const double length = std::sqrt(length2);
        const Vec3 m = in_plane * (1 / length);
        Vec3 direction = cross(n, m);
        direction = direction * (1 / std::sqrt(squared_norm(direction)));
        const Vec3 start = foot + m * (violation(h, foot) / length);
        const auto found = shortest_on_line(start, direction, inside.first(i));
        if (!found) return std::nullopt;
        best = *found;
    }
    return best;
}

/// The shortest point inside all half-spaces (unit normals).
std::optional<Vec3> shortest(std::span<HalfSpace> all) {
    Vec3 best;
    // The half-spaces before `settled` hold at `best`; the most violated other one goes to the front of the rest.
    for (std::size_t settled = 0; settled < all.size(); ++settled) {
        std::size_t worst = all.size();
        double amount = 0;
        for (std::size_t i = settled; i < all.size(); ++i) {
            const double by = violation(all[i], best) - slack_allowed(all[i]);
            if (by > amount) amount = by, worst = i;
        }
        if (worst == all.size()) break;
        std::swap(all[settled], all[worst]);
        const auto found = shortest_on_plane(all[settled], all.first(settled));
        if (!found) return std::nullopt;
        best = *found;
        std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(settled),
                    all.begin() + static_cast<std::ptrdiff_t>(settled) + 1);
    }
    return best;
}

}  // namespace

std::optional<QuadricFactors> factorise(const Quadric& q) {
    const double smallest = 1e-14 * q.trace();
    QuadricFactors f;
    if (!(q.xx > smallest)) return std::nullopt;
    f.l00 = std::sqrt(q.xx);
    f.l10 = q.xy / f.l00;
    f.l20 = q.xz / f.l00;
    const double d1 = q.yy - f.l10 * f.l10;
    if (!(d1 > smallest)) return std::nullopt;
    f.l11 = std::sqrt(d1);
    f.l21 = (q.yz - f.l20 * f.l10) / f.l11;
    const double d2 = q.zz - f.l20 * f.l20 - f.l21 * f.l21;
    if (!(d2 > smallest)) return std::nullopt;
    f.l22 = std::sqrt(d2);
    const double y0 = -q.b.x / f.l00;
    const double y1 = (-q.b.y - f.l10 * y0) / f.l11;
    const double y2 = (-q.b.z - f.l20 * y0 - f.l21 * y1) / f.l22;
    f.lowest.z = y2 / f.l22;
    f.lowest.y = (y1 - f.l21 * f.lowest.z) / f.l11;
    f.lowest.x = (y0 - f.l10 * f.lowest.y - f.l20 * f.lowest.z) / f.l00;
    return f;
}

std::optional<Vec3> minimise(const QuadricFactors& f, std::span<HalfSpace> half_spaces) {
    // y = L'(x - lowest) makes the quadric |y|^2; normals become L^-1 n.
    std::size_t used = 0;
    for (const HalfSpace& h : half_spaces) {
        const double n0 = h.normal.x / f.l00;
        const double n1 = (h.normal.y - f.l10 * n0) / f.l11;
        const double n2 = (h.normal.z - f.l20 * n0 - f.l21 * n1) / f.l22;
        const double length = std::sqrt(n0 * n0 + n1 * n1 + n2 * n2);
        const double offset = h.offset - dot(h.normal, f.lowest);
        if (!(length > 0)) {
            if (h.offset > 0) return std::nullopt;
            continue;
        }
        const double scale = 1 / length;
        half_spaces[used++] = {{n0 * scale, n1 * scale, n2 * scale}, offset * scale};
    }
    const auto y = shortest(half_spaces.first(used));
    if (!y) return std::nullopt;
    Vec3 x;
    x.z = y->z / f.l22;
    x.y = (y->y - f.l21 * x.z) / f.l11;
    x.x = (y->x - f.l10 * x.y - f.l20 * x.z) / f.l00;
    return f.lowest + x;
}

}  // namespace delmesh
