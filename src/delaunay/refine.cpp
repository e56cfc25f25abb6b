#include "delaunay/refine.hpp"

#include "delaunay/non_delaunay.hpp"
#include "delaunay/splitter.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

class Refinement {
public:
    Refinement(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report)
        : marked_(marked),
          mesh_(marked.mesh()),
          context_(context),
          report_(report),
          splitter_(marked, options, report, suspects_) {}

    void run(const SplitPlanner& planner) {
        suspects_ = find_non_delaunay(mesh_, context_);
        std::reverse(suspects_.begin(), suspects_.end());
        flip_suspects();
        const std::vector<EdgeId> bad = find_bad();
        report_.lower_bound = bad.size();
        if (planner && !bad.empty()) {
            carry_out(planner(marked_, bad));
        } else {
            marked_.reserve_splits(6 * bad.size());
        }
        while (!splitter_.stopped() && next_split_ < splits_.size()) {
            treat(splits_[next_split_++]);
            flip_suspects();
            forget_done_splits();
        }
    }

private:
    /// Flips until only edges that can not be flipped are left; these go to the queue of splits.
    void flip_suspects() {
        while (!suspects_.empty()) {
            const HalfedgeId h = suspects_.back();
            suspects_.pop_back();
            if (!is_non_delaunay(mesh_, h)) continue;
            if (marked_.is_planar(h) && marked_.is_flippable(h)) {
                flip_edge(h);
            } else {
                splits_.push_back(h);
            }
        }
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
        std::sort(bad.begin(), bad.end());
        bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
        return bad;
    }

    void carry_out(const std::vector<SplitPoint>& plan) {
        if (is_cancelled(context_)) return splitter_.stop(StopReason::cancelled, splits_.front());
        marked_.reserve_splits(plan.size() + plan.size() / 8);
        for (std::size_t begin = 0, end = 0; begin < plan.size() && !splitter_.stopped(); begin = end) {
            while (end < plan.size() && plan[end].a == plan[begin].a && plan[end].b == plan[begin].b) ++end;
            splitter_.split_edge_at({plan.data() + begin, end - begin});
        }
        flip_suspects();
    }

    /// One edge of the queue, which may have become Delaunay, flippable or another edge in the meantime.
    void treat(HalfedgeId h) {
        if (++treated_ % 1024 == 0) take_breath(h);
        if (splitter_.stopped() || !is_non_delaunay(mesh_, h)) return;
        if (!marked_.is_planar(h)) {
            splitter_.split_at_shell(h);
        } else if (marked_.is_flippable(h)) {
            flip_edge(h);
        } else {
            splitter_.halve(h);
        }
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
    std::size_t treated_ = 0;
    double furthest_ = 0;
    Splitter splitter_;
};

}  // namespace

void refine(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report,
            const SplitPlanner& planner) {
    Refinement(marked, options, context, report).run(planner);
}

}  // namespace delmesh
