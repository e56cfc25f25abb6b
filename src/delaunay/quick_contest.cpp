#include "delaunay/quick_contest.hpp"

#include "delaunay/choose_splits.hpp"
#include "delaunay/shell_bound.hpp"
#include "delaunay/split_trial.hpp"

#include <algorithm>
#include <utility>

namespace delmesh {
namespace {

/// Where construction and shells together need more splits than these, shells alone are tried instead.
constexpr std::size_t most_splits_per_edge = 40;
constexpr std::size_t least_most_splits = 500;

std::vector<SplitPoint> construct(const TrialStart& from) {
    SplitChooser chooser(from.marked, from.start.bad, {.seed = from.options.seed, .is_greedy = true});
    chooser.construct_quickly();
    return chooser.splits();
}

/// None if nothing was constructed.
TrialPointer by_construction(const TrialStart& from, std::size_t most_splits) {
    const std::vector<SplitPoint> plan = construct(from);
    return plan.empty() ? nullptr : try_plan(from, plan, most_splits);
}

/// Where construction and shells together need very many splits, or fail.
TrialPointer shells_first(const TrialStart& from) {
    TrialPointer shells = try_shells(from, unlimited_splits);
    if (!shells->done() && !shells->cancelled()) {
        TrialPointer ours = by_construction(from, unlimited_splits);
        if (ours && (ours->cancelled() || ours->done())) return ours;
    }
    if (shells->done()) shells->report.splits_by_shells = shells->report.splits;
    return shells;
}

}  // namespace

void preserve_quickly(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report,
                      const RefineStart& start) {
    const TrialStart from{marked, options, context, start, report};
    const auto take = [&](SplitTrial& best) {
        report = std::move(best.report);
        marked.take(std::move(best.marked));
    };
    const std::size_t least = start.bad.size();
    TrialPointer ours = by_construction(from, most_splits_per_edge * least + least_most_splits);
    if (ours && (ours->cancelled() || (ours->done() && ours->report.splits == least))) return take(*ours);
    if (!ours || !ours->done()) {
        ours.reset();  // to make room
        return take(*shells_first(from));
    }
    if (shells_need_more_than(marked, start.bad, options, ours->report.splits)) return take(*ours);
    RemeshReport by_shells = report;
    const std::size_t most = ours->report.splits - 1;
    marked.reserve_splits(std::min(most, 6 * least));
    refine_and_clean(marked, with_at_most_splits(options, marked.mesh(), most), context, by_shells, start.queue);
    if (by_shells.stop != StopReason::cancelled && ours->beats(by_shells)) return take(*ours);
    by_shells.splits_by_shells = by_shells.splits;
    report = std::move(by_shells);
}

}  // namespace delmesh
