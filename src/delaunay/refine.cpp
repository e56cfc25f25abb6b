#include "delaunay/refine.hpp"

#include "base/sort_unique.hpp"
#include "delaunay/clean.hpp"
#include "delaunay/non_delaunay.hpp"
#include "delaunay/sheets.hpp"
#include "delaunay/splitter.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace delmesh {
namespace {

/// What parts sheets may make more of them want the same edge.
constexpr std::size_t most_partings_per_edge = 8;
/// An edge in a plane that is split so often comes back for ever.
constexpr int most_splits_of_planar = 32;
/// Edges whose opposite angles a split may change.
constexpr std::size_t touched_per_split = 8;

class Refinement {
public:
    Refinement(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report,
               std::vector<HalfedgeId> queue)
        : marked_(marked),
          mesh_(marked.mesh()),
          context_(context),
          report_(report),
          splits_(std::move(queue)),
          splitter_(marked, options, report, suspects_) {}

    RefineStart flip_planar_edges() {
        suspects_ = find_non_delaunay(mesh_, context_);
        std::reverse(suspects_.begin(), suspects_.end());
        flip_suspects();
        std::vector<EdgeId> bad = find_bad();
        report_.lower_bound = bad.size();
        return {std::move(splits_), std::move(bad)};
    }

    /// Middle points of edges first, then those of their halves, and so on: put in one by one from an end, many points
    /// would make fans that take a number of flips quadratic in it. Returns what is left to be split afterwards.
    std::vector<HalfedgeId> carry_out(std::span<const SplitPoint> plan) {
        marked_.reserve_splits(plan.size() + plan.size() / 8);
        suspects_.reserve(touched_per_split * plan.size());
        std::vector<VertexId> made(plan.size());
        std::size_t longest = 0;
        for (std::size_t begin = 0, end = 0; begin < plan.size(); begin = end) {
            end = end_of_edge(plan, begin);
            longest = std::max(longest, end - begin);
        }
        for (std::size_t step = std::bit_floor(longest); step > 0; step /= 2) {
            for (std::size_t begin = 0, end = 0; begin < plan.size() && !splitter_.stopped(); begin = end) {
                end = end_of_edge(plan, begin);
                split_edge(plan.subspan(begin, end - begin), {made.data() + begin, end - begin}, step);
            }
            flip_suspects();
        }
        std::erase_if(splits_, [&](HalfedgeId h) { return !is_non_delaunay(mesh_, h); });
        return std::move(splits_);
    }

    std::vector<HalfedgeId> part_sheets() {
        std::vector<HalfedgeId> left;
        const std::size_t most = mesh_.vertex_count() + most_partings_per_edge * splits_.size();
        while (next_split_ < splits_.size() && !splitter_.stopped()) {
            const HalfedgeId h = splits_[next_split_++];
            if (!is_non_delaunay(mesh_, h)) continue;
            if (may_flip(h) || (mesh_.vertex_count() < most && part_sheets_at(h))) {
                suspects_.push_back(h);
                flip_suspects();
            } else {
                left.push_back(h);
            }
        }
        std::erase_if(left, [&](HalfedgeId h) { return !is_non_delaunay(mesh_, h); });
        return left;
    }

    void split_rest() {
        while (!splitter_.stopped() && next_split_ < splits_.size()) {
            treat(splits_[next_split_++]);
            flip_suspects();
            forget_done_splits();
        }
    }

private:
    static std::size_t end_of_edge(std::span<const SplitPoint> plan, std::size_t begin) {
        std::size_t end = begin;
        while (end < plan.size() && plan[end].a == plan[begin].a && plan[end].b == plan[begin].b) ++end;
        return end;
    }

    /// Puts in every point of an edge whose number, from 1, is an odd multiple of `step`.
    void split_edge(std::span<const SplitPoint> points, std::span<VertexId> made, std::size_t step) {
        VertexId before = points.front().a;
        for (std::size_t i = 0; i < points.size() && !splitter_.stopped(); ++i) {
            if (made[i].valid()) before = made[i];
            if ((i + 1) % (2 * step) != step) continue;
            const auto after = std::find_if(made.begin() + static_cast<std::ptrdiff_t>(i) + 1, made.end(),
                                            [](VertexId v) { return v.valid(); });
            made[i] = splitter_.split_between(before, after == made.end() ? points.front().b : *after, points[i]);
            if (made[i].valid()) before = made[i];
        }
    }

    /// Flips until only edges that can not be flipped are left; these go to the queue of splits.
    void flip_suspects() {
        while (!suspects_.empty()) {
            const HalfedgeId h = suspects_.back();
            suspects_.pop_back();
            if (!is_non_delaunay(mesh_, h)) continue;
            if (may_flip(h)) {
                flip_edge(h);
            } else {
                splits_.push_back(h);
            }
        }
    }

    bool may_flip(HalfedgeId h) { return marked_.is_planar(h) && marked_.is_flippable(h) && marked_.keeps_unfolded(h); }

    /// False if no edge is in the way of a flip there, or none that can be split.
    bool part_sheets_at(HalfedgeId h) {
        const HalfedgeId other = edge_in_the_way(marked_, h);
        if (!other.valid()) return false;
        return splitter_.split_between(mesh_.origin(other), mesh_.target(other), place_of_parting(marked_, other))
            .valid();
    }

    void flip_edge(HalfedgeId h) {
        const HalfedgeId t = mesh_.twin(h);
        marked_.flip_planar(h);
        ++report_.flips;
        for (const HalfedgeId outer : {h, Mesh::next(h), t, Mesh::next(t)}) suspects_.push_back(outer);
    }

    /// Once planar edges have been flipped, each physical edge left over must be split at least once by any method that
    /// keeps the surface: vertices added elsewhere can only make the angles opposite to it larger.
    std::vector<EdgeId> find_bad() const {
        std::vector<EdgeId> bad;
        for (const HalfedgeId h : splits_)
            if (!marked_.is_planar(h) && is_non_delaunay(mesh_, h)) bad.push_back(mesh_.edge(h));
        sort_unique(bad);
        return bad;
    }

    /// One edge of the queue, which may have become Delaunay, flippable or another edge in the meantime.
    void treat(HalfedgeId h) {
        if (++treated_ % 1024 == 0) take_breath(h);
        if (splitter_.stopped() || !is_non_delaunay(mesh_, h)) return;
        if (may_flip(h)) return flip_edge(h);
        if (marked_.is_planar(h) && comes_back_endlessly(h)) return;
        if (marked_.is_planar(h) && !marked_.is_flippable(h)) return splitter_.halve(h);
        splitter_.split_at_shell(h);
    }

    /// Where rounding folds faces that should lie in a plane, flips may restore an edge whenever it is split, at one
    /// place, again and again.
    bool comes_back_endlessly(HalfedgeId h) {
        const auto [a, b] = std::minmax({mesh_.origin(h).value(), mesh_.target(h).value()});
        if (++planar_splits_[(std::uint64_t{a} << 32) | b] <= most_splits_of_planar) return false;
        report_.endless = true;
        splitter_.stop(StopReason::unresolved, h);
        return true;
    }

    void take_breath(HalfedgeId h) {
        const double left = static_cast<double>(splits_.size() - next_split_);
        const double done = static_cast<double>(report_.splits);
        furthest_ = std::max(furthest_, done / (done + left + 1));
        report_progress(context_, "remesh", furthest_);
        if (is_cancelled(context_)) splitter_.stop(StopReason::cancelled, h);
    }

    void forget_done_splits() {
        if (next_split_ < 65536 || next_split_ < splits_.size() / 2) return;
        splits_.erase(splits_.begin(), splits_.begin() + static_cast<std::ptrdiff_t>(next_split_));
        next_split_ = 0;
    }

    MarkedMesh& marked_;
    const Mesh& mesh_;
    const Context* context_;
    RemeshReport& report_;
    std::vector<HalfedgeId> suspects_;  ///< worked off last in, first out
    std::vector<HalfedgeId> splits_;    ///< worked off first in, first out, from next_split_
    std::size_t next_split_ = 0;
    std::unordered_map<std::uint64_t, std::uint8_t> planar_splits_;  ///< by the ends of the edge
    std::size_t treated_ = 0;
    double furthest_ = 0;
    Splitter splitter_;
};

}  // namespace

RefineStart flip_planar_edges(MarkedMesh& marked, const RemeshOptions& options, const Context* context,
                              RemeshReport& report) {
    return Refinement(marked, options, context, report, {}).flip_planar_edges();
}

std::vector<HalfedgeId> carry_out(MarkedMesh& marked, const RemeshOptions& options, const Context* context,
                                  RemeshReport& report, const RefineStart& start, std::span<const SplitPoint> plan) {
    return Refinement(marked, options, context, report, start.queue).carry_out(plan);
}

std::vector<HalfedgeId> part_sheets(MarkedMesh& marked, const RemeshOptions& options, RemeshReport& report,
                                    std::vector<HalfedgeId> left) {
    return Refinement(marked, options, nullptr, report, std::move(left)).part_sheets();
}

void split_rest(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report,
                std::vector<HalfedgeId> queue) {
    Refinement(marked, options, context, report, std::move(queue)).split_rest();
}

void refine_and_clean(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report,
                      std::vector<HalfedgeId> queue) {
    constexpr int most_cleanings = 50;
    const std::size_t lower_bound = report.lower_bound;
    split_rest(marked, options, context, report, std::move(queue));
    for (int round = 0; report.stop == StopReason::done; ++round) {
        const Cleaning cleaning = clean_up(marked, context);
        if (cleaning.changes == 0 && !cleaning.left) break;
        if (cleaning.changes == 0 || round == most_cleanings) {
            report.stop = StopReason::unresolved;
            report.witness = cleaning.left;
            break;
        }
        std::vector<HalfedgeId> again = flip_planar_edges(marked, options, context, report).queue;
        split_rest(marked, options, context, report, std::move(again));
    }
    report.lower_bound = lower_bound;
    report.splits = marked.split_count();
}

}  // namespace delmesh
