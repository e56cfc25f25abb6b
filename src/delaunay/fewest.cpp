#include "delaunay/fewest.hpp"

#include "base/sort_unique.hpp"
#include "delaunay/choose_splits.hpp"
#include "delaunay/probe_splits.hpp"
#include "delaunay/split_point.hpp"
#include "delaunay/vertex_limit.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace delmesh {
namespace {

/// Rounds of putting the points in and mending, in the model, what rounding breaks.
constexpr int most_trials = 4;
/// Where construction and shells together need more splits than these, shells alone are tried instead.
constexpr std::size_t most_splits_per_edge = 12;
constexpr std::size_t least_most_splits = 500;

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

RemeshOptions with_at_most_splits(const RemeshOptions& options, const Mesh& mesh, std::size_t splits) {
    return splits == unlimited ? options : with_at_most(options, mesh.vertex_count() + splits);
}

/// A copy of the mesh to try something on.
struct Trial {
    /// With room for so many splits.
    Trial(const MarkedMesh& from, const RemeshReport& so_far, std::size_t splits)
        : marked(mesh, from, splits),
          report(so_far) {}
    ~Trial() = default;
    Trial(const Trial&) = delete;
    Trial(Trial&&) = delete;
    Trial& operator=(const Trial&) = delete;
    Trial& operator=(Trial&&) = delete;

    [[nodiscard]] bool done() const { return report.stop == StopReason::done; }
    [[nodiscard]] bool cancelled() const { return report.stop == StopReason::cancelled; }
    [[nodiscard]] bool beats(const RemeshReport& other) const {
        return done() && (other.stop != StopReason::done || report.splits < other.splits);
    }

    Mesh mesh;
    MarkedMesh marked;
    RemeshReport report;
};

/// What the shells have come to.
struct Baseline {
    RemeshReport report;
    std::vector<SplitPoint> splits;

    [[nodiscard]] bool done() const { return report.stop == StopReason::done; }
};

using TrialPointer = std::unique_ptr<Trial>;

std::vector<std::array<VertexId, 2>> input_edges(const Trial& trial, const std::vector<HalfedgeId>& parts) {
    std::vector<std::array<VertexId, 2>> edges;
    for (const HalfedgeId h : parts) {
        if (trial.marked.is_planar(h)) continue;
        const EdgePart part = part_of_input_edge(trial.marked, h);
        edges.push_back({part.a, part.b});
    }
    sort_unique(edges);
    return edges;
}

class Contest {
public:
    Contest(const MarkedMesh& marked, const RemeshOptions& options, const Context* context, const RefineStart& start,
            const RemeshReport& report)
        : marked_(marked),
          options_(options),
          context_(context),
          start_(start),
          report_(report) {}

    TrialPointer run() {
        // Needles make shells explode; then what is found without them is all that is needed.
        const std::size_t few = 100'000 + 20 * start_.bad.size();
        TrialPointer best = by_shells(few);
        if (best->report.stop == StopReason::max_vertices && best->report.splits >= few) {
            most_splits_ = few;
            TrialPointer without = better_of(std::move(best), few);
            most_splits_ = unlimited;
            if (without->done() || without->cancelled()) return without;
            without.reset();
            best = by_shells(unlimited);
            if (!best->done() && !best->cancelled()) return by_closest_plan(std::move(best));
        }
        const std::size_t splits_by_shells = best->done() ? best->report.splits : 0;
        if (!best->cancelled() && splits_by_shells != start_.bad.size()) best = better_of(std::move(best), unlimited);
        best->report.splits_by_shells = splits_by_shells;
        return best;
    }

private:
    /// Stops with `max_vertices` where more splits than these would be needed.
    TrialPointer by_shells(std::size_t most_splits) {
        const RemeshOptions options = with_at_most_splits(options_, marked_.mesh(), most_splits);
        auto trial = std::make_unique<Trial>(marked_, report_, 6 * start_.bad.size());
        refine_and_clean(trial->marked, options, context_, trial->report, start_.queue);
        return trial;
    }

    /// A handful of points that only exact arithmetic finds.
    TrialPointer by_probes(const Baseline& shells) {
        const std::size_t below = shells.done() ? shells.report.splits : unlimited;
        const std::vector<SplitPoint> plan = probe_splits(marked_, options_, start_, below, context_);
        if (plan.empty()) return nullptr;
        auto trial = std::make_unique<Trial>(marked_, report_, plan.size());
        std::vector<HalfedgeId> left = carry_out(trial->marked, options_, context_, trial->report, start_, plan);
        if (trial->done()) refine_and_clean(trial->marked, options_, context_, trial->report, std::move(left));
        return trial->beats(shells.report) ? std::move(trial) : nullptr;
    }

    /// The mesh of the shells is not kept meanwhile: to make it again takes less than its memory is worth.
    TrialPointer better_of(TrialPointer by_shells_first, std::size_t most_splits) {
        const Baseline shells{by_shells_first->report, by_shells_first->marked.take_provenance().splits};
        by_shells_first.reset();
        TrialPointer best = better_of(shells);
        return best ? std::move(best) : by_shells(most_splits);
    }

    /// None if that is the baseline.
    TrialPointer better_of(const Baseline& shells) {
        if (TrialPointer trial = by_probes(shells)) return trial;
        SplitChooser chooser(marked_, start_.bad, {static_cast<int>(options_.effort), options_.seed});
        TrialPointer trial = by_search(chooser, shells);
        if (misses_its_plan(*trial, chooser)) {
            // Rounding broke what was found. It may leave alone what takes less searching.
            for (const bool quick : {false, true}) {
                if (trial->cancelled()) break;
                SplitChooser simple(marked_, start_.bad, {0, options_.seed, quick});
                TrialPointer other = by_search(simple, shells);
                if (other->cancelled() || other->beats(trial->report)) trial = std::move(other);
            }
        }
        if (!shells.done() || trial->cancelled()) return trial;
        // By now it is known what the points cost in truth: regions where the shells need fewer take these.
        TrialPointer second;
        if (chooser.take_better_regions(trial->marked.splits())) second = by_plan(chooser);
        if (second && second->cancelled()) return second;
        if (second && second->beats(trial->report)) trial = std::move(second);
        return trial->beats(shells.report) ? std::move(trial) : nullptr;
    }

    TrialPointer by_search(SplitChooser& chooser, const Baseline& shells) {
        if (shells.done()) chooser.set_baseline(shells.splits);
        chooser.search(context_);
        return by_plan(chooser);
    }

    [[nodiscard]] static bool misses_its_plan(const Trial& trial, const SplitChooser& chooser) {
        const std::size_t planned = chooser.splits().size();
        return !trial.done() || trial.report.splits > planned + planned / 10 + 10;
    }

    TrialPointer by_plan(SplitChooser& chooser) {
        const RemeshOptions options = with_at_most_splits(options_, marked_.mesh(), most_splits_);
        for (int round = 1;; ++round) {
            const std::vector<SplitPoint> plan = chooser.splits();
            auto trial = std::make_unique<Trial>(marked_, report_, plan.size() + plan.size() / 8);
            if (is_cancelled(context_)) {
                trial->report.stop = StopReason::cancelled;
                return trial;
            }
            std::vector<HalfedgeId> left = carry_out(trial->marked, options, context_, trial->report, start_, plan);
            if (!left.empty() && trial->done() && round < most_trials && chooser.mend(input_edges(*trial, left)))
                continue;
            const std::size_t still_open = left.size();
            if (trial->done()) refine_and_clean(trial->marked, options, context_, trial->report, std::move(left));
            trial->report.splits = trial->marked.split_count();
            if (trial->report.stop == StopReason::max_vertices && still_open < least_open_) {
                least_open_ = still_open;
                closest_plan_ = plan;
            }
            return trial;
        }
    }

    /// Where neither shells nor any plan ended within what was allowed: the best plan with all that the user allows.
    TrialPointer by_closest_plan(TrialPointer shells) {
        if (closest_plan_.empty()) return shells;
        shells.reset();
        auto trial = std::make_unique<Trial>(marked_, report_, closest_plan_.size());
        std::vector<HalfedgeId> left =
            carry_out(trial->marked, options_, context_, trial->report, start_, closest_plan_);
        if (trial->done()) refine_and_clean(trial->marked, options_, context_, trial->report, std::move(left));
        trial->report.splits = trial->marked.split_count();
        return trial;
    }

    const MarkedMesh& marked_;
    const RemeshOptions& options_;
    const Context* context_;
    const RefineStart& start_;
    const RemeshReport& report_;
    std::size_t most_splits_ = unlimited;  ///< of a plan that is carried out
    std::size_t least_open_ = unlimited;   ///< edges that the closest plan leaves to shells
    std::vector<SplitPoint> closest_plan_;
};

/// Effort 0: shells finish what a quick construction leaves open. Alone they are run only for as long as they need
/// fewer splits than that.
class QuickContest {
public:
    QuickContest(MarkedMesh& marked, const RemeshOptions& options, const Context* context, const RefineStart& start)
        : marked_(marked),
          options_(options),
          context_(context),
          start_(start) {}

    void run(RemeshReport& report) {
        const std::size_t least = start_.bad.size();
        TrialPointer ours = by_construction(report, most_splits_per_edge * least + least_most_splits);
        if (ours->cancelled() || (ours->done() && ours->report.splits == least)) return take(*ours, report);
        if (!ours->done()) return run_shells_first(report);
        RemeshReport by_shells = report;
        const std::size_t most = ours->report.splits - 1;
        marked_.reserve_splits(std::min(most, 6 * least));
        refine_and_clean(marked_, with_at_most_splits(options_, marked_.mesh(), most), context_, by_shells,
                         start_.queue);
        if (by_shells.stop != StopReason::cancelled && ours->beats(by_shells)) return take(*ours, report);
        by_shells.splits_by_shells = by_shells.splits;
        report = std::move(by_shells);
    }

private:
    /// Where construction and shells together need very many splits, or fail.
    void run_shells_first(RemeshReport& report) {
        Trial shells(marked_, report, 6 * start_.bad.size());
        refine_and_clean(shells.marked, options_, context_, shells.report, start_.queue);
        if (!shells.done() && !shells.cancelled()) {
            TrialPointer ours = by_construction(report, unlimited);
            if (ours->cancelled() || ours->done()) return take(*ours, report);
        }
        if (shells.done()) shells.report.splits_by_shells = shells.report.splits;
        take(shells, report);
    }

    /// Not `done` if nothing was constructed.
    [[nodiscard]] TrialPointer by_construction(const RemeshReport& report, std::size_t most_splits) {
        std::vector<SplitPoint> plan;
        {
            SplitChooser chooser(marked_, start_.bad, {.seed = options_.seed, .is_greedy = true});
            chooser.construct_quickly();
            plan = chooser.splits();
        }
        auto trial = std::make_unique<Trial>(marked_, report, plan.size() + plan.size() / 8);
        if (is_cancelled(context_)) {
            trial->report.stop = StopReason::cancelled;
            return trial;
        }
        if (plan.empty()) {
            trial->report.stop = StopReason::unresolved;
            return trial;
        }
        const RemeshOptions options = with_at_most_splits(options_, marked_.mesh(), most_splits);
        std::vector<HalfedgeId> left = carry_out(trial->marked, options, context_, trial->report, start_, plan);
        if (trial->done()) refine_and_clean(trial->marked, options, context_, trial->report, std::move(left));
        return trial;
    }

    void take(Trial& best, RemeshReport& report) {
        report = std::move(best.report);
        marked_.take(std::move(best.marked));
    }

    MarkedMesh& marked_;
    const RemeshOptions& options_;
    const Context* context_;
    const RefineStart& start_;
};

}  // namespace

void preserve_with_fewest(MarkedMesh& marked, const RemeshOptions& options, const Context* context,
                          RemeshReport& report, const RefineStart& start) {
    if (options.effort == 0) return QuickContest(marked, options, context, start).run(report);
    const TrialPointer best = Contest(marked, options, context, start, report).run();
    report = std::move(best->report);
    marked.take(std::move(best->marked));
}

}  // namespace delmesh
