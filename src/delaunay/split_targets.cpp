#include "delaunay/split_targets.hpp"

#include <algorithm>
#include <limits>

namespace delmesh {
namespace {

constexpr std::size_t many_sides = 8;
constexpr std::size_t very_many_sides = 64;
constexpr std::size_t most_taken = 400;
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

bool SplitTargets::is_taken(const Point& t) const {
    return std::any_of(taken_.begin(), taken_.end(),
                       [&](const Point& other) { return other.edge == t.edge && other.at == t.at; });
}

/// The nearest points on the other sides of a facet; in a facet with many sides, the nearest one of all.
void SplitTargets::add_nearest(const Side& from, Point2 at) {
    const Facet& facet = model_.layout().facet(from.facet);
    Point nearest;
    double least = infinity;
    for (std::uint32_t s = facet.first_side; s < facet.first_side + facet.side_count; ++s) {
        const Side side = model_.layout().side(s);
        const std::size_t n = model_.point_count(side.edge);
        if (n == 0 || side.edge == from.edge || !model_.is_movable(side.edge)) continue;
        const auto parts = model_.parts(side.edge);
        std::size_t i = 0;
        if (n > 1) {
            const double t = dot(at - side.start, side.x_row);
            i = std::min(model_.part_at(side.edge, t), n - 1);
            if (i > 0 && t - parts[i - 1].end < parts[i].end - t) --i;
        }
        const Point target{side.edge, parts[i].end};
        if (facet.side_count <= many_sides) {
            nearby_.push_back(target);
            continue;
        }
        const Point2 d = side.at(target.at) - at;
        if (dot(d, d) >= least) continue;
        least = dot(d, d);
        nearest = target;
    }
    if (least < infinity) nearby_.push_back(nearest);
}

void SplitTargets::add_neighbours(const Point& of) {
    const std::size_t i = model_.part_at(of.edge, of.at);
    const auto parts = model_.parts(of.edge);
    if (i > 0) nearby_.push_back({of.edge, parts[i - 1].end});
    if (i + 2 < parts.size()) nearby_.push_back({of.edge, parts[i + 1].end});
    for (const std::uint32_t s : model_.layout().edge(of.edge).side)
        if (s != SplitModel::none) add_nearest(model_.layout().side(s), model_.layout().side(s).at(of.at));
}

/// Neighbouring points, in random order.
void SplitTargets::take_cluster(Point seed, std::size_t size) {
    nearby_.clear();
    taken_.assign(1, seed);
    if (size > 1) add_neighbours(seed);
    while (taken_.size() < size && !nearby_.empty()) {
        const std::size_t i = random_.below(nearby_.size());
        const Point next = nearby_[i];
        nearby_[i] = nearby_.back();
        nearby_.pop_back();
        if (is_taken(next)) continue;
        taken_.push_back(next);
        add_neighbours(next);
    }
}

/// All points of neighbouring edges.
void SplitTargets::take_edges(std::uint32_t edge, std::size_t size) {
    const FacetLayout& layout = model_.layout();
    taken_.clear();
    edges_.assign(1, edge);
    for (std::size_t done = 0; done < edges_.size() && done < size && taken_.size() < most_taken; ++done) {
        if (done > 0) std::swap(edges_[done], edges_[done + random_.below(edges_.size() - done)]);
        const std::uint32_t e = edges_[done];
        for (const Part& part : model_.parts(e).first(model_.point_count(e))) taken_.push_back({e, part.end});
        for (const std::uint32_t s : layout.edge(e).side) {
            if (s == SplitModel::none) continue;
            const Facet& facet = layout.facet(layout.facet_at(s));
            if (facet.side_count > very_many_sides) continue;
            for (std::uint32_t i = facet.first_side; i < facet.first_side + facet.side_count; ++i) {
                const std::uint32_t other = layout.edge_at(i);
                if (model_.point_count(other) == 0 || !model_.is_movable(other)) continue;
                if (std::find(edges_.begin(), edges_.end(), other) == edges_.end()) edges_.push_back(other);
            }
        }
    }
}

/// Moves `at` across the facet at side k of its edge to the nearest point there, and k to the far side of the edge that
/// it comes to.
bool SplitTargets::move_across(int& k, Point& at) {
    const FacetLayout& layout = model_.layout();
    const std::uint32_t s = layout.edge(at.edge).side[k];
    if (s == SplitModel::none) return false;
    const Side from = layout.side(s);
    const Point2 p = from.at(at.at);
    nearby_.clear();
    add_nearest(from, p);
    double least = infinity;
    for (const Point& t : nearby_) {
        if (is_taken(t)) continue;
        const auto near = static_cast<int>(layout.side_within(t.edge, from.facet));
        const Point2 d = layout.side(layout.edge(t.edge).side[near]).at(t.at) - p;
        if (dot(d, d) >= least) continue;
        least = dot(d, d);
        at = t;
        k = 1 - near;
    }
    return least < infinity;
}

/// Takes a point and those that follow it on both sides, each the nearest to the one before across a facet.
void SplitTargets::follow(const Point& seed, std::size_t size) {
    taken_.push_back(seed);
    const std::size_t end = taken_.size() - 1 + size;
    for (const int direction : {0, 1}) {
        Point at = seed;
        int k = direction;
        while (taken_.size() < end && move_across(k, at)) taken_.push_back(at);
    }
}

void SplitTargets::take_thread(Point seed, std::size_t size) {
    taken_.clear();
    follow(seed, size);
}

void SplitTargets::take_threads(Point seed, std::size_t size) {
    taken_.clear();
    follow(seed, size / 2);
    const auto parts = model_.parts(seed.edge);
    const std::size_t i = model_.part_at(seed.edge, seed.at);
    if (parts.size() <= 2) return;
    const std::size_t next = i + 2 < parts.size() ? i + 1 : i - 1;
    const Point second{seed.edge, parts[next].end};
    if (!is_taken(second)) follow(second, size / 2);
}

/// Neighbours on an edge that follow each other in the list go together.
void SplitTargets::remove() {
    for (std::size_t next = 0; next < taken_.size();) {
        const Point& t = taken_[next++];
        if (!model_.is_movable(t.edge)) continue;
        model_.prepare(t.edge);
        const std::size_t first = model_.part_at(t.edge, t.at);
        const auto points = model_.parts(t.edge).first(model_.point_count(t.edge));
        if (first >= points.size() || points[first].end != t.at) continue;
        std::size_t last = first + 1;
        while (last < points.size() && next < taken_.size() && taken_[next].edge == t.edge &&
               taken_[next].at == points[last].end) {
            ++last;
            ++next;
        }
        model_.cut(t.edge, first, last, {});
    }
}

}  // namespace delmesh
