#include "delaunay/fewest.hpp"

#include "base/sort_unique.hpp"
#include "delaunay/probe_splits.hpp"
#include "delaunay/quick_contest.hpp"
#include "delaunay/sheets.hpp"
#include "delaunay/slice_trials.hpp"
#include "delaunay/split_bound.hpp"
#include "delaunay/split_planner.hpp"
#include "delaunay/split_trial.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace delmesh {
namespace {

/// Rounds of mending, in the model, what rounding breaks.
constexpr int most_mendings = 3;
/// Rounds of parting sheets that want the same edges; points in a plan for the next sheets may bring new ones.
constexpr int most_partings = 12;
/// Rounds in a row that leave hardly less.
constexpr int most_useless_partings = 2;

/// What the shells have come to.
struct Baseline {
    RemeshReport report;
    std::vector<SplitPoint> splits;

    [[nodiscard]] bool done() const { return report.stop == StopReason::done; }
};

class Contest {
public:
    Contest(const TrialStart& from, bool has_other_way, Mesh* spare, bool may_part = true)
        : from_(from),
          has_other_way_(has_other_way),
          spare_(spare),
          may_part_(may_part) {}

    TrialPointer run() {
        // Needles make shells explode; then what is found without them is all that is needed.
        const std::size_t few = few_splits(from_.start.bad.size(), has_other_way_);
        TrialPointer best = try_shells(from_, few);
        if (best->report.endless || (best->report.stop == StopReason::max_vertices && best->report.splits >= few)) {
            most_splits_ = few;
            TrialPointer without = better_of(std::move(best), few);
            most_splits_ = unlimited_splits;
            if (without->done() || without->cancelled() || has_other_way_) return without;
            without.reset();
            best = try_shells(from_, unlimited_splits);
            if (!best->done() && !best->cancelled()) return by_closest_plan(std::move(best));
        }
        const std::size_t splits_by_shells = best->done() ? best->report.splits : 0;
        if (!best->cancelled() && splits_by_shells != from_.start.bad.size())
            best = better_of(std::move(best), unlimited_splits);
        best->report.splits_by_shells = splits_by_shells;
        return best;
    }

    /// What the search has proved that any method needs; 0: nothing.
    [[nodiscard]] std::size_t proved_bound() const { return proved_bound_; }

private:
    /// The mesh of the shells is not kept meanwhile: to make it again takes less than its memory is worth.
    TrialPointer better_of(TrialPointer by_shells, std::size_t most_splits) {
        Baseline shells{by_shells->report, {}};
        if (shells.done()) shells.splits = by_shells->marked.take_provenance().splits;
        by_shells.reset();
        TrialPointer best = better_of(shells);
        return best ? std::move(best) : try_shells(from_, most_splits);
    }

    /// None if that is the baseline.
    TrialPointer better_of(Baseline& shells) {
        if (TrialPointer trial = by_probes(shells)) return trial;
        most_by_plan_ = shells.done() ? 2 * shells.report.splits : unlimited_splits;
        std::optional<SplitPlanner> planner(std::in_place, from_.marked, from_.start.bad, search_options(),
                                            shells.splits);
        TrialPointer trial = by_search(*planner);
        const bool is_broken = trial->misses_its_plan() && !planner->leaves_open();
        if (!shells.done()) planner.reset();  // has nothing to say about regions
        if (is_broken && part(trial, shells)) return trial;
        if (is_broken && !trial->cancelled()) trial = by_less_searching(std::move(trial), shells);
        if (trial->cancelled()) return trial;
        if (!shells.done())
            return trial->done() || has_other_way_ ? std::move(trial) : by_failed_plans(std::move(trial));
        trial = with_better_regions(std::move(trial), *planner);
        return trial->cancelled() || trial->beats(shells.report) ? std::move(trial) : nullptr;
    }

    [[nodiscard]] SplitSearchOptions search_options() const {
        SplitSearchOptions options{static_cast<int>(from_.options.effort), from_.options.seed};
        options.bound = bound_options(from_.options);
        return options;
    }

    /// A handful of points that only exact arithmetic finds.
    TrialPointer by_probes(const Baseline& shells) {
        const std::size_t below = shells.done() ? shells.report.splits : unlimited_splits;
        const std::vector<SplitPoint> plan =
            probe_splits(from_.marked, from_.options, from_.start, below, from_.context);
        if (plan.empty()) return nullptr;
        TrialPointer trial = try_plan(from_, plan, unlimited_splits);
        return trial->beats(shells.report) ? std::move(trial) : nullptr;
    }

    /// What the search leaves open is left to the shells: mostly they need far fewer points for that than in all of the
    /// region. Where they do not end, the region is taken from the baseline.
    TrialPointer by_search(SplitPlanner& planner) {
        TrialPointer trial = by_plan(planner, planner.search(from_.context));
        proved_bound_ = std::max(proved_bound_, planner.proved_bound());
        const bool explodes = most_by_plan_ == unlimited_splits && !trial->done() && !trial->cancelled();
        if (explodes && may_part_ && !has_sliced_ && !has_other_way_) {
            has_sliced_ = true;
            // Of one whose plan is kept only the report is needed: see `by_failed_plans`.
            return try_slices(from_, std::move(trial), !failed_.empty());
        }
        if (!planner.leaves_open() || trial->done() || trial->cancelled()) return trial;
        trial.reset();
        return by_plan(planner, planner.close_by_baseline());
    }

    /// Stops early where the shells that finish it explode.
    TrialPointer by_plan(SplitPlanner& planner, std::vector<SplitPoint> plan) {
        for (int mendings = most_mendings;;) {
            const std::size_t allowed = most_by_plan_ != unlimited_splits ? most_by_plan_ : some_more_than(plan.size());
            const std::size_t most = std::min(allowed, most_splits_);
            std::vector<HalfedgeId> left;
            TrialPointer trial = carry_out_plan(from_, plan, most, left);
            if (!left.empty() && trial->done() && mendings > 0) {
                const std::vector<std::array<VertexId, 2>> broken = input_edges(*trial, left);
                trial.reset();  // to make room for the model
                auto mended = planner.mend(broken);
                mendings = mended ? mendings - 1 : 0;
                if (mended) plan = std::move(*mended);
                continue;
            }
            const std::size_t still_open = left.size();
            note_blocked(*trial, plan, left);
            finish_by_shells(from_, *trial, most, std::move(left));
            if (trial->report.stop == StopReason::max_vertices && !has_other_way_)
                failed_.push_back({still_open, std::move(plan)});
            return trial;
        }
    }

    /// Rounding broke what was found. It may leave alone what takes less searching.
    TrialPointer by_less_searching(TrialPointer trial, Baseline& shells) {
        for (const bool quick : {false, true}) {
            if (trial->cancelled() || (quick && !shells.done())) break;
            if (!shells.done() && !trial->done()) trial.reset();
            SplitPlanner simple(from_.marked, from_.start.bad, {0, from_.options.seed, quick}, shells.splits);
            TrialPointer other = by_search(simple);
            if (!trial || other->cancelled() || other->beats(trial->report)) trial = std::move(other);
        }
        return trial;
    }

    /// By now it is known what the points cost in truth: regions where the shells need fewer take these.
    TrialPointer with_better_regions(TrialPointer trial, SplitPlanner& planner) {
        if (trial->done()) {
            trial->marked.forget_marks();
            if (spare_ != nullptr) *spare_ = Mesh();
        }
        auto plan = planner.take_better_regions(trial->marked.splits());
        if (!plan) return trial;
        TrialPointer second = by_plan(planner, std::move(*plan));
        return second->cancelled() || second->beats(trial->report) ? std::move(second) : std::move(trial);
    }

    // --- sheets that lie on each other ---

    void note_blocked(SplitTrial& trial, const std::vector<SplitPoint>& plan, const std::vector<HalfedgeId>& left) {
        if (has_other_way_ && may_part_) return;
        const auto is_blocked = [&](HalfedgeId h) { return edge_in_the_way(trial.marked, h).valid(); };
        if (left.size() < blocked_.open && std::any_of(left.begin(), left.end(), is_blocked))
            blocked_ = {left.size(), plan};
    }

    /// Replaces the trial by one with parted sheets, if that is better. True if nothing else need be tried.
    bool part(TrialPointer& trial, const Baseline& shells) {
        if (!may_part_ || has_other_way_ || blocked_.plan.empty() || trial->cancelled()) return false;
        if (!trial->done()) trial.reset();
        TrialPointer parted = by_parting();
        if (parted->cancelled() || !trial || parted->beats(trial->report)) trial = std::move(parted);
        return trial->cancelled() || (!trial->misses_its_plan() && trial->beats(shells.report));
    }

    /// Carries out the plan that sheets of the surface break, parts these, and searches again for what is not Delaunay
    /// by then. The points that are there stay, so each round has less to do.
    TrialPointer by_parting() {
        TrialPointer best;
        RefineStart start;
        std::size_t least_open = blocked_.open;
        int useless = 0;
        TrialPointer base = part_by_plan(start);
        for (int round = 1; base->done(); ++round) {
            Contest next({base->marked, from_.options, from_.context, start, base->report}, true, nullptr, false);
            TrialPointer trial = next.run();
            const bool is_over = trial->cancelled() || !trial->misses_its_plan() || next.blocked_.plan.empty();
            if (!best || trial->cancelled() || trial->beats(best->report)) best = std::move(trial);
            useless = next.blocked_.open < least_open - least_open / 10 ? 0 : useless + 1;
            if (is_over || round == most_partings || useless == most_useless_partings) break;
            least_open = std::min(least_open, next.blocked_.open);
            trial.reset();
            base = next.part_by_plan(start);
        }
        if (!best || base->cancelled()) return base;
        best->report.splits_by_shells = from_.report.splits_by_shells;
        return best;
    }

    /// The mesh to go on from, with what is left to do.
    TrialPointer part_by_plan(RefineStart& start) {
        std::vector<HalfedgeId> left;
        TrialPointer trial = carry_out_plan(from_, blocked_.plan, unlimited_splits, left);
        if (trial->done()) left = part_sheets(trial->marked, from_.options, trial->report, std::move(left));
        start.bad.clear();
        for (const HalfedgeId h : left)
            if (!trial->marked.is_planar(h)) start.bad.push_back(trial->mesh.edge(h));
        sort_unique(start.bad);
        start.queue = std::move(left);
        trial->marked.fix_vertices();
        return trial;
    }

    // --- where nothing has ended ---

    /// Follows explosions to their end, which may come in time; the plan that leaves least to them first. `last` is
    /// what is left of the last one.
    TrialPointer by_failed_plans(TrialPointer last) {
        std::sort(failed_.begin(), failed_.end(), [](const OpenPlan& a, const OpenPlan& b) { return a.open < b.open; });
        for (const OpenPlan& failed : failed_) {
            last.reset();
            last = try_plan(from_, failed.plan, most_splits_);
            if (last->done() || last->cancelled()) break;
        }
        return last;
    }

    /// Where neither shells nor any plan ended within what was allowed: the best plan with all that the user allows.
    TrialPointer by_closest_plan(TrialPointer shells) {
        if (failed_.empty()) return shells;
        shells.reset();
        return try_plan(from_, failed_.front().plan, unlimited_splits);
    }

    struct OpenPlan {
        std::size_t open = 0;  ///< edges that it leaves to shells
        std::vector<SplitPoint> plan;
    };

    const TrialStart from_;
    const bool has_other_way_;
    Mesh* const spare_;  ///< see preserve_with_fewest
    const bool may_part_;
    std::size_t most_splits_ = unlimited_splits;   ///< of a plan that is carried out
    std::size_t most_by_plan_ = unlimited_splits;  ///< the same, where the shells end
    bool has_sliced_ = false;
    std::size_t proved_bound_ = 0;
    std::vector<OpenPlan> failed_;
    OpenPlan blocked_{unlimited_splits,
                      {}};  ///< of the plans with sheets in the way of flips the one that leaves least
};

}  // namespace

void preserve_with_fewest(MarkedMesh& marked, const RemeshOptions& options, const Context* context,
                          RemeshReport& report, const RefineStart& start, bool has_other_way, Mesh* spare) {
    if (options.effort == 0) return preserve_quickly(marked, options, context, report, start);
    Contest contest({marked, options, context, start, report}, has_other_way, spare);
    const TrialPointer best = contest.run();
    report = std::move(best->report);
    if (report.lower_bound_strong)
        report.lower_bound_strong = std::max(*report.lower_bound_strong, contest.proved_bound());
    marked.take(std::move(best->marked));
}

}  // namespace delmesh
