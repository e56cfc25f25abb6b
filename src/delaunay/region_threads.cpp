#include "delaunay/region_threads.hpp"

#include "delaunay/split_at_seen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace delmesh {
namespace {

constexpr std::uint32_t most_sides = 64;
constexpr std::size_t most_points = 6;  ///< that threads may need at first, against what was there
constexpr int most_starts = 3;
constexpr std::uint64_t starting = 8;  ///< of the work, for each start
constexpr std::uint64_t early = 4;     ///< after that part of the work it must have come to less
/// What the search finds after all goes on to improve faster.
constexpr std::size_t worthwhile = 8;
/// Of threads, that are taken away together, as a rule, and the share of exceptions.
constexpr std::size_t few_taken = 3;
constexpr std::size_t many_taken = 6;
constexpr double many_share = 0.3;
constexpr std::size_t most_laid = 16;  ///< in their place
/// Of eight threads one begins near to each end of what it splits, and two at some distance from what that sees.
constexpr std::uint32_t ways = 8;
constexpr std::uint32_t last_beside = 3;
constexpr double farthest_beside = 0.15;
constexpr double least_near = 0.1;
constexpr std::size_t points_per_work = 16;
constexpr std::size_t parts_per_work = 4;

}  // namespace

// --- which edges ---

void RegionThreads::visit(std::uint32_t e) {
    model_.prepare(e);
    reached_.resize(model_.layout().edge_count(), false);
    visited_.resize(model_.layout().facet_count(), false);
    for (const std::uint32_t s : model_.layout().edge(e).side) {
        if (s == SplitModel::none) continue;
        const std::uint32_t f = model_.layout().facet_at(s);
        if (visited_[f]) continue;
        visited_[f] = true;
        const Facet& facet = model_.layout().facet(f);
        for (std::uint32_t i = facet.first_side; i < facet.first_side + facet.side_count; ++i) {
            const std::uint32_t other = model_.layout().edge_at(i);
            const bool is_concerned = model_.point_count(other) > 0 || !model_.layout().edge(other).is_delaunay;
            if (reached_[other] || !model_.is_movable(other) || !is_concerned) continue;
            reached_[other] = true;
            edges_.push_back(other);
        }
    }
}

void RegionThreads::gather(std::uint32_t e) {
    edges_.assign(1, e);
    reached_.assign(model_.layout().edge_count(), false);
    visited_.assign(model_.layout().facet_count(), false);
    reached_[e] = true;
    for (std::size_t done = 0; done < edges_.size(); ++done) visit(edges_[done]);
}

std::size_t RegionThreads::point_count() const {
    std::size_t count = 0;
    for (const std::uint32_t e : edges_) count += model_.point_count(e);
    return count;
}

RegionThreads::Thread RegionThreads::places() const {
    Thread places;
    for (const std::uint32_t e : edges_)
        for (const Part& part : model_.parts(e).first(model_.point_count(e))) places.push_back({e, part.end});
    return places;
}

/// In place of all threads.
void RegionThreads::put_back(std::span<const Place> places) {
    take_all();
    add_points(model_, places);
    while (model_.suspect_count() > 0) model_.drop_suspect(model_.suspect_count() - 1);
}

// --- threads ---

bool RegionThreads::has_room(std::uint32_t e, std::size_t part, double at) const {
    return at > model_.part_start(e, part) + room_between_points &&
           at < model_.parts(e)[part].end - room_between_points;
}

/// Where to split a bad part: at the foot of what it sees, or where that does for other parts as well.
double RegionThreads::choose_place(std::uint32_t e, std::size_t part) {
    const double a = model_.part_start(e, part);
    const double b = model_.parts(e)[part].end;
    const double u = least_near + (1 - least_near) * random_.uniform();
    const std::uint32_t way = is_first_ ? ways : random_.below(ways);
    if (way == 0) return a + u * u * (b - a);
    if (way == 1) return b - u * u * (b - a);
    double at = split_at_what_is_seen(model_, e, part, [](std::uint32_t, const Contact& seen) { return seen.at.x; });
    if (way <= last_beside) at += farthest_beside * (2 * u - 1) * (b - a);
    return has_room(e, part, at) ? at : a + 0.5 * (b - a);
}

void RegionThreads::put(std::uint32_t e, std::size_t part, double at) {
    model_.prepare(e);
    model_.cut(e, part, part, {&at, 1});
    if (model_.first_bad(e) >= 0) model_.add_suspect(e);
    model_.count_work(model_.parts(e).size() / parts_per_work);
    threads_.back().push_back({e, at});
}

/// Goes on from a point on a side to the bad parts that lie straight ahead.
void RegionThreads::cross(std::uint32_t s, double at) {
    const FacetLayout& layout = model_.layout();
    const Facet facet = layout.facet(layout.facet_at(s));
    if (facet.side_count > most_sides) return;
    const Point2 p = layout.side(s).at(at);
    for (std::uint32_t i = facet.first_side; i < facet.first_side + facet.side_count; ++i) {
        const std::uint32_t e = layout.edge_at(i);
        if (e == layout.edge_at(s) || !model_.is_movable(e)) continue;
        const Side side = layout.side(i);
        const double x = dot(p - side.start, side.x_row);
        if (!(x > room_between_points) || !(x < 1 - room_between_points)) continue;
        const std::size_t part = model_.part_at(e, x);
        if (has_room(e, part, x) && model_.is_bad(e, model_.parts(e)[part])) put(e, part, x);
    }
    model_.count_work(facet.side_count);
}

bool RegionThreads::lay(std::uint32_t e, std::size_t part, double at, std::size_t max_points) {
    threads_.emplace_back();
    put(e, part, at);
    for (std::size_t i = 0; i < threads_.back().size(); ++i) {
        if (model_.point_count() > max_points || limits_.is_exhausted()) return false;
        const Place from = threads_.back()[i];
        const std::array<std::uint32_t, 2> sides = model_.layout().edge(from.edge).side;
        for (const std::uint32_t s : sides)
            if (s != SplitModel::none) cross(s, from.at);
    }
    return true;
}

/// Works off the model's suspects.
bool RegionThreads::close(std::size_t max_points, std::size_t most_threads) {
    for (std::size_t laid = 0; model_.suspect_count() > 0;) {
        const std::size_t i = random_.below(model_.suspect_count());
        const std::uint32_t e = model_.suspect(i);
        const int bad = model_.first_bad(e);
        model_.drop_suspect(i);
        if (bad < 0) continue;
        if (++laid > most_threads || limits_.is_exhausted() || !model_.is_movable(e)) return false;
        if (model_.point_count() >= max_points) return false;
        model_.prepare(e);
        const auto part = static_cast<std::size_t>(bad);
        const double at = choose_place(e, part);
        if (!has_room(e, part, at) || !lay(e, part, at, max_points)) return false;
    }
    return true;
}

bool RegionThreads::lay_first(std::size_t max_points) {
    take_all();
    for (const std::uint32_t e : edges_) {
        model_.cut(e, 0, model_.point_count(e), {});
        model_.add_suspect(e);
    }
    is_first_ = true;
    const bool closed = close(max_points, std::numeric_limits<std::size_t>::max());
    is_first_ = false;
    return closed;
}

// --- search ---

/// The threads nearest to a point, along its edge, the last ones first.
void RegionThreads::choose_threads(const Place& near, std::size_t count) {
    std::vector<std::pair<double, std::size_t>> found;
    for (std::size_t t = 0; t < threads_.size(); ++t)
        for (const Place& place : threads_[t])
            if (place.edge == near.edge) found.emplace_back(std::fabs(place.at - near.at), t);
    std::sort(found.begin(), found.end());
    chosen_.clear();
    for (const auto& [distance, t] : found) {
        if (chosen_.size() == count) break;
        if (std::find(chosen_.begin(), chosen_.end(), t) == chosen_.end()) chosen_.push_back(t);
    }
    std::sort(chosen_.rbegin(), chosen_.rend());
    model_.count_work(model_.point_count() / points_per_work);
}

/// Their points next to each other on an edge go together.
void RegionThreads::take_chosen() {
    taken_.clear();
    points_.clear();
    for (const std::size_t t : chosen_) {
        points_.insert(points_.end(), threads_[t].begin(), threads_[t].end());
        std::swap(threads_[t], threads_.back());
        taken_.push_back(std::move(threads_.back()));
        threads_.pop_back();
    }
    std::sort(points_.begin(), points_.end());
    for (std::size_t next = 0; next < points_.size();) {
        const std::uint32_t e = points_[next].edge;
        const std::size_t first = model_.part_at(e, points_[next].at);
        const auto parts = model_.parts(e);
        std::size_t last = first;
        for (; next < points_.size() && points_[next].edge == e && points_[next].at == parts[last].end; ++next) ++last;
        model_.cut(e, first, last, {});
    }
}

void RegionThreads::take_all() {
    chosen_.resize(threads_.size());
    std::iota(chosen_.rbegin(), chosen_.rend(), std::size_t{0});
    take_chosen();
}

void RegionThreads::try_once() {
    const Thread& thread = threads_[random_.below(threads_.size())];
    const Place near = thread[random_.below(thread.size())];
    choose_threads(near, 1 + random_.below(random_.chance(many_share) ? many_taken : few_taken));
    const std::size_t before = model_.point_count();
    const std::size_t kept = threads_.size() - chosen_.size();
    model_.begin();
    take_chosen();
    if (close(before, most_laid)) return model_.commit();
    model_.rollback();
    threads_.resize(kept);
    for (Thread& taken : taken_) threads_.push_back(std::move(taken));
}

bool RegionThreads::thin(std::uint64_t work, const Context* context) {
    const Thread before = places();
    const std::size_t others = model_.point_count() - before.size();
    threads_.clear();
    std::vector<Thread> best;
    std::size_t most = others + most_points * before.size();
    const std::uint64_t end = model_.work() + work;
    for (int i = 0; i < most_starts; ++i) {
        limits_.set_work_limit(model_.work() + work / starting);
        model_.begin();
        const bool laid = lay_first(most);
        laid ? model_.commit() : model_.rollback();
        if (laid) {
            best = threads_;
            most = model_.point_count() - 1;
        } else {
            threads_ = best;
        }
    }
    if (threads_.empty()) return false;
    limits_.set_work_limit(end);
    const auto count = [&] { return model_.point_count() - others; };
    const std::uint64_t look = model_.work() + work / early;
    while (!threads_.empty() && !limits_.is_exhausted() && !is_cancelled(context)) {
        if (model_.work() >= look && count() >= before.size()) break;
        try_once();
    }
    if (count() <= before.size() - before.size() / worthwhile) return true;
    put_back(before);
    return false;
}

}  // namespace delmesh
