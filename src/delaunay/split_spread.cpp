// The last steps of the search: as many points as before, but farther apart.

#include "delaunay/split_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

constexpr int spread_passes = 3;
constexpr int polish_passes = 8;
constexpr int polish_tries = 16;
constexpr std::size_t most_points = 6;
/// Sines: angles above need no care; others are punished by the inverse of their square.
constexpr double large_enough = 0.17;

/// The sine of the smallest angle of the triangle with the side [a,b] of the x axis and the corner p above it.
[[nodiscard]] double smallest_sine(double a, double b, Point2 p) {
    const double base = b - a;
    const double left = std::sqrt((p.x - a) * (p.x - a) + p.y * p.y);
    const double right = std::sqrt((b - p.x) * (b - p.x) + p.y * p.y);
    const double longest = std::max({base, left, right});
    const double shortest = std::min({base, left, right});
    const double middle = std::max(std::min(base, std::max(left, right)), std::min(left, right));
    return shortest > 0 ? p.y * base / (longest * middle) : 0;
}

[[nodiscard]] double penalty(double sine) {
    const double s = std::max(sine, 1e-9);
    return s < large_enough ? 1 / (s * s) : 0;
}

}  // namespace

void SplitSearch::spread(std::uint64_t work) {
    limit_work(work);
    for (int pass = 0; pass < spread_passes; ++pass)
        for (std::uint32_t e = 0; e < model_.edge_count(); ++e)
            for (std::size_t i = 0; i < model_.point_count(e) && !repair_.is_exhausted(); ++i)
                if (model_.is_movable(e)) repair_.spread(e, i);
}

/// The point of edge `on` at a place in the frame of a side that sees it.
double SplitSearch::point_at(const Side& side, std::uint32_t on, Point2 place) const {
    const FacetLayout& layout = model_.layout();
    const Side other = layout.side(layout.edge(on).side[layout.side_within(on, side.facet)]);
    double least = std::numeric_limits<double>::infinity();
    double nearest = 0;
    for (const Part& part : model_.parts(on).first(model_.point_count(on))) {
        const Point2 d = side.to_frame(other.at(part.end)) - place;
        if (dot(d, d) >= least) continue;
        least = dot(d, d);
        nearest = part.end;
    }
    return nearest;
}

/// A point at the triangle at side k of part i, of those that may move; the edge of it is `none` if there is none.
SplitSearch::Target SplitSearch::point_near(std::uint32_t e, std::size_t i, std::size_t k, Point2 apex) {
    std::array<Target, 3> found;
    std::size_t count = 0;
    const auto parts = model_.parts(e);
    if (model_.is_movable(e)) {
        if (i > 0) found[count++] = {e, parts[i - 1].end};
        if (i + 1 < parts.size()) found[count++] = {e, parts[i].end};
    }
    const std::uint32_t culprit = parts[i].culprit[k];
    if (culprit != SplitModel::none && model_.is_movable(culprit))
        found[count++] = {culprit, point_at(model_.layout().side(model_.layout().edge(e).side[k]), culprit, apex)};
    return count == 0 ? Target{SplitModel::none, 0} : found[random_.below(count)];
}

/// The sine of the smallest angle in the triangles at the parts of an edge, and a point at that triangle.
double SplitSearch::smallest_angle(std::uint32_t e, Target& near) {
    const auto parts = model_.parts(e);
    const std::array<std::uint32_t, 2> sides = model_.layout().edge(e).side;
    double least = 1;
    std::size_t part = 0;
    std::size_t side = 0;
    Point2 apex;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const double start = model_.part_start(e, i);
        for (std::size_t k = 0; k < 2; ++k) {
            if (sides[k] == SplitModel::none) continue;
            if (parts.size() == 1 && parts[i].culprit[k] == SplitModel::none) continue;
            const Contact contact = model_.nearest(sides[k], start, parts[i].end);
            const double sine = smallest_sine(start, parts[i].end, contact.at);
            if (sine >= least) continue;
            least = sine;
            part = i;
            side = k;
            apex = contact.at;
        }
    }
    near = least < 1 ? point_near(e, part, side, apex) : Target{SplitModel::none, 0};
    return least;
}

double SplitSearch::penalty_before(std::uint32_t e) const {
    return e < angles_.size() ? penalty(angles_[e]) : 0;
}

/// Places the points around one anew; keeps that if the small angles nearby have become larger.
void SplitSearch::try_to_polish(const Target& near) {
    targets_.take_cluster(near, 1 + random_.below(random_.chance(0.5) ? 2 : most_points));
    const std::size_t most = model_.point_count();
    model_.begin();
    targets_.remove();
    if (!repair_.run(most, 6 * targets_.size() + 20, random_.chance(0.5))) return model_.rollback();
    double gain = 0;
    new_angles_.clear();
    model_.visit_changed([&](std::uint32_t changed) {
        Target ignored;
        new_angles_.push_back(smallest_angle(changed, ignored));
        gain += penalty_before(changed) - penalty(new_angles_.back());
    });
    if (!(gain > 0) && model_.point_count() == most) return model_.rollback();
    angles_.resize(std::max(angles_.size(), model_.edge_count()), 1);
    std::size_t i = 0;
    model_.visit_changed([&](std::uint32_t changed) { angles_[changed] = new_angles_[i++]; });
    model_.commit();
}

void SplitSearch::polish_edge(std::uint32_t e) {
    for (int i = 0; i < polish_tries && !repair_.is_exhausted(); ++i) {
        Target near;
        if (smallest_angle(e, near) >= large_enough || near.edge == SplitModel::none) return;
        try_to_polish(near);
    }
}

/// Edges with small angles, the smallest first.
void SplitSearch::find_small_angles(std::vector<std::uint32_t>& edges) {
    edges.clear();
    angles_.assign(model_.edge_count(), 1);
    for (std::uint32_t e = 0; e < model_.edge_count(); ++e) {
        if (model_.parts(e).empty() || model_.is_given_up(e)) continue;
        Target near;
        angles_[e] = smallest_angle(e, near);
        if (angles_[e] < large_enough && near.edge != SplitModel::none) edges.push_back(e);
    }
    std::sort(edges.begin(), edges.end(), [&](std::uint32_t a, std::uint32_t b) {
        return angles_[a] != angles_[b] ? angles_[a] < angles_[b] : a < b;
    });
}

void SplitSearch::polish(std::uint64_t work, const Context* context) {
    limit_work(work);
    std::vector<std::uint32_t> edges;
    for (int pass = 0; pass < polish_passes; ++pass) {
        find_small_angles(edges);
        for (const std::uint32_t e : edges) {
            if (repair_.is_exhausted() || is_cancelled(context)) return;
            polish_edge(e);
        }
    }
}

}  // namespace delmesh
