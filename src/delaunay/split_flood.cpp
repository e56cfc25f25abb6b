// Walks through facets of many triangles.

#include "delaunay/split_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Points this near to the line of a side do not see it.
constexpr double flat = 1e-14;
/// A place this near to the line of a side may be one of its ends: rounding decides about the angle there.
constexpr double on_line = 1e-12;

/// Where the way from p to q lies against the disc of the points that see [a,b] with a cotangent below some level.
enum class Place { outside, inside, unclear };

/// The same, if only q lies above the axis, and not in the disc.
Place place_from_below(double a, double b, double level, Point2 p, Point2 q) {
    const Point2 d = q - p;
    if (std::fabs(p.y) <= on_line) {
        if (std::fabs(p.x - a) <= on_line) return -d.x < level * d.y ? Place::inside : Place::outside;
        if (std::fabs(p.x - b) <= on_line) return d.x < level * d.y ? Place::inside : Place::outside;
    }
    const double right_of_a = (p.x - a) * d.y - p.y * d.x;
    const double right_of_b = (p.x - b) * d.y - p.y * d.x;
    const double least = 2 * on_line * d.y;
    if (std::fabs(right_of_a) <= least || std::fabs(right_of_b) <= least) return Place::unclear;
    if (right_of_a > 0 && right_of_b < 0) return Place::inside;
    // Whatever part of the line lies in the disc, is all above the axis, or all below.
    const double height = level * (b - a);
    const double at_p = (a - p.x) * (b - p.x) + p.y * (p.y - height);
    const double slope = (2 * p.x - a - b) * d.x + (2 * p.y - height) * d.y;
    const double length2 = dot(d, d);
    const bool meets = slope * slope > 4 * length2 * at_p && slope + 2 * length2 > 0;
    return meets && 2 * length2 * p.y > slope * d.y ? Place::inside : Place::outside;
}

Place place_against(double a, double b, double level, Point2 p, Point2 q) {
    const bool is_p_above = p.y > on_line;
    const bool is_q_above = q.y > on_line;
    if (!(is_p_above || is_q_above) || !(level < infinity)) return Place::unclear;
    const double height = level * (b - a);
    const double at_p = (a - p.x) * (b - p.x) + p.y * (p.y - height);
    const double at_q = (a - q.x) * (b - q.x) + q.y * (q.y - height);
    if ((is_p_above && at_p < 0) || (is_q_above && at_q < 0)) return Place::inside;
    if (!is_p_above) return place_from_below(a, b, level, p, q);
    if (!is_q_above) return place_from_below(a, b, level, q, p);
    const Point2 d = q - p;
    const double slope = (2 * p.x - a - b) * d.x + (2 * p.y - height) * d.y;
    const double length2 = dot(d, d);
    if (slope >= 0 || slope + 2 * length2 <= 0 || slope * slope < 4 * length2 * at_p) return Place::outside;
    return Place::inside;
}

}  // namespace

void SplitModel::start_visit() const {
    if (seen_.size() < layout_.triangle_count()) seen_.resize(layout_.triangle_count(), 0);
    ++visit_;
}

void SplitModel::visit(std::uint32_t triangle) const {
    seen_[triangle] = visit_;
}

/// The smallest cotangent at which a point of the segment from p to q sees [a,b].
double SplitModel::portal_level(Point2 p, Point2 q, double a, double b) {
    const Point2 d = q - p;
    const double u = std::clamp(largest_angle_on_line(a, b, p, d), 0.0, 1.0);
    const Point2 seen = p + u * d;
    if (seen.y > on_line) return cot_of(a, b, seen);
    // From an end the angle on the way into the facet is the outer one of that way.
    const Point2 inward = u < 0.5 ? d : Point2{-d.x, -d.y};
    if (inward.y > on_line && std::fabs(seen.x - a) <= on_line) return -inward.x / inward.y;
    if (inward.y > on_line && std::fabs(seen.x - b) <= on_line) return inward.x / inward.y;
    return (a - seen.x) * (b - seen.x) <= 0 ? -infinity : infinity;
}

/// True if a point between p and q sees [a,b] with a cotangent below `level`.
bool SplitModel::is_open(Point2 p, Point2 q, double a, double b, double level) const {
    ++work_;
    const Place place = place_against(a, b, level, p, q);
    return place == Place::inside || (place == Place::unclear && portal_level(p, q, a, b) < level);
}

/// Grows the disc of the points that see [a,b] until it holds one, through the triangles of the facet: the triangle
/// that the disc reaches first comes first. A point in the part of the disc that is connected to [a,b] within the facet
/// proves that there is one that sees [a,b] (follow the shortest way back to its last bend), so looking for connected
/// points is enough, and it respects holes and notches.
Contact SplitModel::flood_in_order(std::uint32_t s, double a, double b, double bound) const {
    const Side side = layout_.side(s);
    start_visit();
    heap_.assign(1, {-infinity, side.triangle});
    Contact best{bound, {}, none};
    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end());
        const Portal portal = heap_.back();
        heap_.pop_back();
        if (portal.level >= best.cot) break;
        if (seen_[portal.triangle] == visit_) continue;
        visit(portal.triangle);
        const FacetTriangle& triangle = layout_.triangle(portal.triangle);
        const auto take = [&](Contact found) {
            found.cot = std::max(found.cot, portal.level);
            if (found.cot < best.cot) best = found;
        };
        work_ += triangle_work_;
        std::array<Point2, 3> corner;
        std::array<bool, 3> known{};  // from a triangle that was visited before, at a lower level
        for (std::size_t i = 0; i < 3; ++i) {
            corner[i] = side.to_frame(layout_.corner(triangle.corner[i]));
            if (!triangle.is_side[i] && seen_[triangle.beyond[i]] == visit_) known[i] = known[(i + 1) % 3] = true;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            if (!known[i] && corner[i].y > flat) take({cot_of(a, b, corner[i]), corner[i], none});
            if (!triangle.is_side[i]) continue;
            const std::uint32_t other = triangle.beyond[i];
            Contact found{best.cot, {}, none};
            if (layout_.edge_at(other) != side.edge && has_points(other)) scan(side, s, other, a, b, found);
            if (found.edge != none) take(found);
        }
        for (std::size_t i = 0; i < 3; ++i) {
            if (triangle.is_side[i] || seen_[triangle.beyond[i]] == visit_) continue;
            const Point2 p = corner[i];
            const Point2 q = corner[(i + 1) % 3];
            if (place_against(a, b, best.cot, p, q) == Place::outside) continue;
            const double level = std::max(portal.level, portal_level(p, q, a, b));
            if (level >= best.cot) continue;
            heap_.push_back({level, triangle.beyond[i]});
            std::push_heap(heap_.begin(), heap_.end());
        }
    }
    return best;
}

/// Goes through the triangles of the facet that the disc of the points that see [a,b] reaches from there, and shrinks
/// it to what has been found. Much faster than in order, and the same, unless the disc does not reach what has been
/// found any more: by then it may have been too small to find what it does reach.
Contact SplitModel::flood(std::uint32_t s, double a, double b, double bound) const {
    const Side side = layout_.side(s);
    start_visit();
    gates_.assign(1, {side.triangle, none, none, 0, {}, {}, bound});
    Contact best{bound, {}, none};
    std::size_t way = 0;
    for (std::size_t next = 0; next < gates_.size(); ++next) {
        const Gate gate = gates_[next];
        if (seen_[gate.triangle] == visit_) continue;
        if (best.cot < gate.level && !is_open(gate.p, gate.q, a, b, best.cot)) continue;
        visit(gate.triangle);
        const FacetTriangle& triangle = layout_.triangle(gate.triangle);
        work_ += triangle_work_;
        std::array<Point2, 3> corner;
        std::array<bool, 3> known{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t c = triangle.corner[i];
            known[i] = c == gate.from || c == gate.to;
            corner[i] = !known[i] ? side.to_frame(layout_.corner(c)) : c == gate.from ? gate.p : gate.q;
        }
        const double before = best.cot;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!known[i] && corner[i].y > flat) {
                const double cot = cot_of(a, b, corner[i]);
                if (cot < best.cot) best = {cot, corner[i], none};
            }
            if (!triangle.is_side[i]) continue;
            const std::uint32_t other = triangle.beyond[i];
            if (layout_.edge_at(other) == side.edge || !has_points(other)) continue;
            if (place_against(a, b, best.cot, corner[i], corner[(i + 1) % 3]) != Place::outside)
                scan(side, s, other, a, b, best);
        }
        if (best.cot < before) way = next;
        for (std::size_t i = 0; i < 3; ++i) {
            if (triangle.is_side[i] || seen_[triangle.beyond[i]] == visit_) continue;
            const std::size_t k = (i + 1) % 3;
            if (is_open(corner[i], corner[k], a, b, best.cot))
                gates_.push_back({triangle.beyond[i], triangle.corner[i], triangle.corner[k],
                                  static_cast<std::uint32_t>(next), corner[i], corner[k], best.cot});
        }
    }
    for (; way > 0; way = gates_[way].before)
        if (!is_open(gates_[way].p, gates_[way].q, a, b, best.cot)) return flood_in_order(s, a, b, bound);
    return best;
}

bool SplitModel::reaches_through(std::uint32_t s, double a, double b, double level, std::uint32_t t) const {
    const Side side = layout_.side(s);
    const std::uint32_t goal = layout_.side(t).triangle;
    if (goal == side.triangle) return true;
    start_visit();
    ahead_.assign(1, side.triangle);
    visit(side.triangle);
    while (!ahead_.empty()) {
        const FacetTriangle& triangle = layout_.triangle(ahead_.back());
        ahead_.pop_back();
        for (std::size_t i = 0; i < 3; ++i) {
            if (triangle.is_side[i] || seen_[triangle.beyond[i]] == visit_) continue;
            const Point2 p = side.to_frame(layout_.corner(triangle.corner[i]));
            const Point2 q = side.to_frame(layout_.corner(triangle.corner[(i + 1) % 3]));
            if (!is_open(p, q, a, b, level)) continue;
            if (triangle.beyond[i] == goal) return true;
            visit(triangle.beyond[i]);
            ahead_.push_back(triangle.beyond[i]);
        }
    }
    return false;
}

}  // namespace delmesh
