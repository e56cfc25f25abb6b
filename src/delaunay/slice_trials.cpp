#include "delaunay/slice_trials.hpp"

#include "base/sort_unique.hpp"
#include "delaunay/split_planner.hpp"

#include <array>
#include <utility>
#include <vector>

namespace delmesh {
namespace {

/// What planes keep from what rounding may do, in half units in the last place: one way after the other until shells
/// can finish what that leaves.
constexpr std::array<SliceOptions, 6> ways{{
    {.rounding = 0},
    {.rounding = 4},
    {.rounding = 1, .everywhere = true},
    {.rounding = 1, .everywhere = true, .dents_fans = true},
    {.rounding = 2, .everywhere = true, .dents_fans = true},
    {.rounding = 4, .everywhere = true, .dents_fans = true},
}};
/// Of a plan: with more splits than that it has not worked.
constexpr std::size_t shells_share = 8;

}  // namespace

TrialPointer try_slices(const TrialStart& from, TrialPointer exploded, bool is_spare) {
    const RemeshOptions& options = from.options;
    const double ulp = options.precision == Precision::float32 ? 0x1p-24 : 0x1p-53;
    TrialPointer trial = std::move(exploded);
    std::vector<std::array<VertexId, 2>> broken;
    for (const SliceOptions& way : ways) {
        if (is_spare) trial->marked.forget_all();
        std::vector<SplitPoint> none;
        SplitPlanner planner(from.marked, from.start.bad, {static_cast<int>(options.effort), options.seed}, none);
        const auto plan =
            planner.lay_slices({way.rounding * ulp, way.everywhere, way.dents_fans}, broken, from.context);
        if (!plan) break;
        trial.reset();  // to make room for the next
        std::vector<HalfedgeId> left;
        trial = carry_out_plan(from, *plan, unlimited_splits, left);
        if (!trial->done()) break;
        const std::vector<std::array<VertexId, 2>> more = input_edges(*trial, left);
        broken.insert(broken.end(), more.begin(), more.end());
        sort_unique(broken);
        finish_by_shells(from, *trial, plan->size() + plan->size() / shells_share, std::move(left));
        if (trial->done() || trial->cancelled()) break;
    }
    return trial;
}

}  // namespace delmesh
