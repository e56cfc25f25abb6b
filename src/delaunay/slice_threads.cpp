#include "delaunay/slice_threads.hpp"

#include "delaunay/split_at_seen.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace delmesh {
namespace {

constexpr std::size_t parts_per_work = 4;  ///< looked at: an edge may have a hundred thousand
/// What has been solved at all took hardly more than a quarter of it.
constexpr std::uint64_t work_per_edge = 2'000'000;
constexpr std::size_t most_steps = 1'000'000;
constexpr std::size_t steps_per_look = 1024;
/// See `slice`.
constexpr double thin = 4;
constexpr double thinnest = 1. / 64;
/// Parts that end so many times farther from a corner than they begin are not halved in the middle.
constexpr double far = 4;
constexpr int most_doubts = 20;
constexpr double least_part = 1e-13;

}  // namespace

// --- which edges ---

bool SliceThreads::reach(std::uint32_t e) {
    if (reached_.size() <= e) reached_.resize(model_.layout().edge_count() + 1, false);
    if (reached_[e]) return false;
    reached_[e] = true;
    return true;
}

bool SliceThreads::is_concerned(std::uint32_t e) const {
    return model_.is_given_up(e) || model_.point_count(e) > 0 || !model_.layout().edge(e).is_delaunay;
}

/// `rim`: so many edges from those to be solved.
void SliceThreads::visit(std::uint32_t e, std::size_t rim) {
    model_.prepare(e);
    for (const std::uint32_t s : model_.layout().edge(e).side) {
        if (s == SplitModel::none) continue;
        const Facet facet = model_.layout().facet(model_.layout().facet_at(s));
        for (std::uint32_t i = facet.first_side; i < facet.first_side + facet.side_count; ++i) {
            const std::uint32_t other = model_.layout().edge_at(i);
            if (!model_.is_movable(other) || (rim == rim_.size() && !is_concerned(other)) || !reach(other)) continue;
            (is_concerned(other) ? edges_ : rim_[rim]).push_back(other);
        }
    }
}

void SliceThreads::gather(std::uint32_t e) {
    edges_.assign(1, e);
    reached_.clear();
    (void)reach(e);
    for (std::size_t done = 0;;) {
        for (; done < edges_.size(); ++done) visit(edges_[done], 0);
        const auto next = std::find_if(rim_.begin(), rim_.end(), [](const auto& edges) { return !edges.empty(); });
        if (next == rim_.end()) return;
        const std::uint32_t edge = next->back();
        next->pop_back();
        visit(edge, static_cast<std::size_t>(next - rim_.begin()) + 1);
    }
}

// --- where ---

/// Where the plane cuts that the part sees under the larger angle; negative if neither does.
double SliceThreads::slice(std::uint32_t e, std::size_t part) {
    const double a = model_.part_start(e, part);
    const double b = model_.parts(e)[part].end;
    return split_at_what_is_seen(model_, e, part, [&](std::uint32_t s, const Contact& seen) {
        const double x = levels_.place_of(e, levels_.level_of(s, seen));
        // So near to an end, and so far from what is seen, halving helps at once, and leaves longer parts.
        const double most = std::min(thin * seen.at.y * seen.at.y / (b - a), thinnest * (b - a));
        return x - a < most || b - x < most ? -1 : x;
    });
}

/// In the middle, or nearer to a corner that is near: facets get narrow there.
double SliceThreads::middle(std::uint32_t e, std::size_t part) const {
    const double a = model_.part_start(e, part);
    const double b = model_.parts(e)[part].end;
    if (a > 0 && b <= 0.5 && b > far * a) return std::sqrt(a * b);
    if (b < 1 && a >= 0.5 && 1 - a > far * (1 - b)) return 1 - std::sqrt((1 - a) * (1 - b));
    return 0.5 * (a + b);
}

/// Rounding moves what it sees by so much along the part, at a distance y, which changes the cotangent by the quotient.
bool SliceThreads::is_doubtful(std::uint32_t e, std::size_t part) {
    const double a = model_.part_start(e, part);
    const double b = model_.parts(e)[part].end;
    const double rounding = levels_.rounding(e);
    double sum = 0;
    for (const std::uint32_t s : model_.layout().edge(e).side) {
        if (s == SplitModel::none) continue;
        const Contact seen = model_.nearest(s, a, b);
        sum += seen.cot - rounding / seen.at.y;
    }
    return sum < 0;
}

// --- threads ---

/// Splits one bad part, and has the edge looked at again.
SliceThreads::Found SliceThreads::split(std::uint32_t e, bool halves) {
    const std::size_t parts = model_.parts(e).size();
    model_.count_work(parts / parts_per_work);
    Found found = Found::nothing;
    for (std::size_t part = 0; part < parts; ++part) {
        if (!model_.is_bad(e, model_.parts(e)[part])) continue;
        double at = slice(e, part);
        if (at < 0 && halves) at = middle(e, part);
        if (at >= 0) return cut(e, part, at) ? Found::cut : Found::no_room;
        found = Found::no_plane;
    }
    return found;
}

bool SliceThreads::cut(std::uint32_t e, std::size_t part, double at) {
    if (at - model_.part_start(e, part) < least_part || model_.parts(e)[part].end - at < least_part) return false;
    model_.cut(e, part, part, {&at, 1});
    model_.add_suspect(e);
    return true;
}

/// Works off the model's suspects.
bool SliceThreads::work_off(const Context* context) {
    std::vector<std::uint32_t> later;
    for (; model_.suspect_count() > 0 || !later.empty(); ++steps_) {
        const bool halves = model_.suspect_count() == 0;
        const std::uint32_t e = halves ? later.back() : model_.suspect(model_.suspect_count() - 1);
        if (steps_ >= most_steps || is_exhausted() || !model_.is_movable(e)) return false;
        if (steps_ % steps_per_look == 0 && is_cancelled(context)) return false;
        halves ? later.pop_back() : model_.drop_suspect(model_.suspect_count() - 1);
        model_.prepare(e);
        const Found found = split(e, halves);
        if (found == Found::no_room) return false;
        if (found == Found::no_plane) later.push_back(e);
    }
    return true;
}

/// Splits what rounding may make bad. Not so at corners: there it does more the shorter a part is.
bool SliceThreads::split_doubtful(const Context* context) {
    std::vector<std::uint32_t> changed;
    model_.visit_changed([&](std::uint32_t e) {
        const bool is_watched = options_.everywhere || model_.is_distrusted(e);
        if (is_watched && !model_.is_given_up(e) && model_.is_movable(e)) changed.push_back(e);
    });
    for (const std::uint32_t e : changed) {
        for (std::size_t part = 0; part < model_.parts(e).size(); ++part) {
            if (!is_doubtful(e, part)) continue;
            model_.prepare(e);
            double at = slice(e, part);
            if (at < 0 && part > 0 && part + 1 < model_.parts(e).size()) at = middle(e, part);
            if (at < 0 || !cut(e, part, at)) continue;
            if (!work_off(context)) return false;
            --part;
        }
    }
    return true;
}

bool SliceThreads::solve(const Context* context) {
    steps_ = 0;
    work_limit_ = model_.work() + work_per_edge * edges_.size();
    levels_.find_axis(edges_);
    for (const std::uint32_t e : edges_) {
        model_.cut(e, 0, model_.point_count(e), {});
        model_.give_up(e, false);
        model_.add_suspect(e);
    }
    std::size_t before = 0;
    if (!work_off(context)) return false;
    for (int round = 0; options_.rounding > 0 && round < most_doubts && model_.point_count() != before; ++round) {
        before = model_.point_count();
        if (!split_doubtful(context)) return false;
    }
    return true;
}

}  // namespace delmesh
