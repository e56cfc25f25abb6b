#include "delaunay/fewest.hpp"

#include "base/sort_unique.hpp"
#include "delaunay/choose_splits.hpp"
#include "delaunay/probe_splits.hpp"
#include "delaunay/sheets.hpp"
#include "delaunay/split_planner.hpp"
#include "delaunay/split_point.hpp"
#include "delaunay/vertex_limit.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>

namespace delmesh {
namespace {

/// Rounds of mending, in the model, what rounding breaks.
constexpr int most_mendings = 3;
/// Where construction and shells together need more splits than these, shells alone are tried instead.
constexpr std::size_t most_splits_per_edge = 40;
constexpr std::size_t least_most_splits = 500;

/// Rounds of parting sheets that want the same edges; points in a plan for the next sheets may bring new ones.
constexpr int most_partings = 12;
/// Rounds in a row that leave hardly less.
constexpr int most_useless_partings = 2;

/// What planes keep from what rounding may do, in half units in the last place: one way after the other until shells
/// can finish what that leaves.
constexpr std::array<SliceOptions, 6> slice_ways{{
    {.rounding = 0},
    {.rounding = 4},
    {.rounding = 1, .everywhere = true},
    {.rounding = 1, .everywhere = true, .dents_fans = true},
    {.rounding = 2, .everywhere = true, .dents_fans = true},
    {.rounding = 4, .everywhere = true, .dents_fans = true},
}};

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
    std::size_t planned = 0;  ///< splits
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
            const RemeshReport& report, bool has_other_way, Mesh* spare, bool may_part = true)
        : marked_(marked),
          options_(options),
          context_(context),
          start_(start),
          report_(report),
          has_other_way_(has_other_way),
          spare_(spare),
          may_part_(may_part) {}

    TrialPointer run() {
        // Needles make shells explode; then what is found without them is all that is needed.
        const std::size_t few = 100'000 + (has_other_way_ ? 10 : 20) * start_.bad.size();
        TrialPointer best = by_shells(few);
        if (best->report.stop == StopReason::max_vertices && best->report.splits >= few) {
            most_splits_ = few;
            TrialPointer without = better_of(std::move(best), few);
            most_splits_ = unlimited;
            if (without->done() || without->cancelled() || has_other_way_) return without;
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
        // Explosions would make the mesh grow step by step, which takes it twice.
        const std::size_t room = most_splits == unlimited ? 6 * start_.bad.size() : most_splits;
        auto trial = std::make_unique<Trial>(marked_, report_, room);
        refine_and_clean(trial->marked, options, context_, trial->report, start_.queue);
        return trial;
    }

    /// A handful of points that only exact arithmetic finds.
    TrialPointer by_probes(const Baseline& shells) {
        const std::size_t below = shells.done() ? shells.report.splits : unlimited;
        const std::vector<SplitPoint> plan = probe_splits(marked_, options_, start_, below, context_);
        if (plan.empty()) return nullptr;
        auto trial = std::make_unique<Trial>(marked_, report_, plan.size());
        trial->planned = marked_.split_count() + plan.size();
        std::vector<HalfedgeId> left = carry_out(trial->marked, options_, context_, trial->report, start_, plan);
        if (trial->done()) refine_and_clean(trial->marked, options_, context_, trial->report, std::move(left));
        return trial->beats(shells.report) ? std::move(trial) : nullptr;
    }

    /// The mesh of the shells is not kept meanwhile: to make it again takes less than its memory is worth.
    TrialPointer better_of(TrialPointer by_shells_first, std::size_t most_splits) {
        Baseline shells{by_shells_first->report, {}};
        if (shells.done()) shells.splits = by_shells_first->marked.take_provenance().splits;
        by_shells_first.reset();
        TrialPointer best = better_of(shells);
        return best ? std::move(best) : by_shells(most_splits);
    }

    /// None if that is the baseline.
    TrialPointer better_of(Baseline& shells) {
        if (TrialPointer trial = by_probes(shells)) return trial;
        most_by_plan_ = shells.done() ? 2 * shells.report.splits : unlimited;
        std::optional<SplitPlanner> planner(std::in_place, marked_, start_.bad,
                                            SplitSearchOptions{static_cast<int>(options_.effort), options_.seed},
                                            shells.splits);
        TrialPointer trial = by_search(*planner);
        const bool is_broken = misses_its_plan(*trial) && !planner->leaves_open();
        if (!shells.done()) planner.reset();  // has nothing to say about regions
        if (is_broken && may_part_ && !has_other_way_ && !blocked_.plan.empty() && !trial->cancelled()) {
            if (!trial->done()) trial.reset();
            TrialPointer parted = by_parting();
            if (parted->cancelled() || !trial || parted->beats(trial->report)) trial = std::move(parted);
            if (trial->cancelled()) return trial;
            if (!misses_its_plan(*trial) && trial->beats(shells.report)) return trial;
        }
        // Rounding broke what was found. It may leave alone what takes less searching.
        for (const bool quick : {false, true}) {
            if (!is_broken || trial->cancelled() || (quick && !shells.done())) break;
            if (!shells.done() && !trial->done()) trial.reset();
            SplitPlanner simple(marked_, start_.bad, {0, options_.seed, quick}, shells.splits);
            TrialPointer other = by_search(simple);
            if (!trial || other->cancelled() || other->beats(trial->report)) trial = std::move(other);
        }
        if (trial->cancelled()) return trial;
        if (!shells.done())
            return trial->done() || has_other_way_ ? std::move(trial) : by_failed_plans(std::move(trial));
        if (trial->done()) {
            trial->marked.forget_marks();
            if (spare_ != nullptr) *spare_ = Mesh();
        }
        // By now it is known what the points cost in truth: regions where the shells need fewer take these.
        TrialPointer second;
        if (auto plan = planner->take_better_regions(trial->marked.splits()))
            second = by_plan(*planner, std::move(*plan));
        if (second && second->cancelled()) return second;
        if (second && second->beats(trial->report)) trial = std::move(second);
        return trial->beats(shells.report) ? std::move(trial) : nullptr;
    }

    /// What the search leaves open is left to the shells: mostly they need far fewer points for that than in all of the
    /// region. Where they do not end, the region is taken from the baseline.
    TrialPointer by_search(SplitPlanner& planner) {
        TrialPointer trial = by_plan(planner, planner.search(context_));
        const bool explodes = most_by_plan_ == unlimited && !trial->done() && !trial->cancelled();
        if (explodes && may_part_ && !has_sliced_ && !has_other_way_) return by_slices(std::move(trial));
        if (!planner.leaves_open() || trial->done() || trial->cancelled()) return trial;
        trial.reset();
        return by_plan(planner, planner.close_by_baseline());
    }

    /// Where shells explode on what the search leaves open: a plan that has nothing of that. What rounding breaks of it
    /// is planned again, at a greater distance from what rounding may do.
    TrialPointer by_slices(TrialPointer trial) {
        has_sliced_ = true;
        const double ulp = options_.precision == Precision::float32 ? 0x1p-24 : 0x1p-53;
        std::vector<std::array<VertexId, 2>> broken;
        for (const SliceOptions& way : slice_ways) {
            std::vector<SplitPoint> none;
            SplitPlanner planner(marked_, start_.bad, {static_cast<int>(options_.effort), options_.seed}, none);
            auto plan = planner.lay_slices({way.rounding * ulp, way.everywhere, way.dents_fans}, broken, context_);
            if (!plan) break;
            std::vector<HalfedgeId> left;
            trial.reset();  // to make room for the next
            trial = carry_out_plan(*plan, unlimited, left);
            if (!trial->done()) break;
            const std::vector<std::array<VertexId, 2>> more = input_edges(*trial, left);
            broken.insert(broken.end(), more.begin(), more.end());
            sort_unique(broken);
            finish(*trial, plan->size() + plan->size() / 8, std::move(left));
            if (trial->done() || trial->cancelled()) break;
        }
        return trial;
    }

    void note_blocked(Trial& trial, const std::vector<SplitPoint>& plan, const std::vector<HalfedgeId>& left) {
        if (has_other_way_ && may_part_) return;
        const auto is_blocked = [&](HalfedgeId h) { return edge_in_the_way(trial.marked, h).valid(); };
        if (left.size() < blocked_.open && std::any_of(left.begin(), left.end(), is_blocked))
            blocked_ = {left.size(), plan};
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
            Contest next(base->marked, options_, context_, start, base->report, true, nullptr, false);
            TrialPointer trial = next.run();
            const bool is_over = trial->cancelled() || !misses_its_plan(*trial) || next.blocked_.plan.empty();
            if (!best || trial->cancelled() || trial->beats(best->report)) best = std::move(trial);
            useless = next.blocked_.open < least_open - least_open / 10 ? 0 : useless + 1;
            if (is_over || round == most_partings || useless == most_useless_partings) break;
            least_open = std::min(least_open, next.blocked_.open);
            trial.reset();
            base = next.part_by_plan(start);
        }
        if (!best || base->cancelled()) return base;
        best->report.splits_by_shells = report_.splits_by_shells;
        return best;
    }

    /// The mesh to go on from, with what is left to do.
    TrialPointer part_by_plan(RefineStart& start) {
        std::vector<HalfedgeId> left;
        TrialPointer trial = carry_out_plan(blocked_.plan, unlimited, left);
        if (trial->done()) left = part_sheets(trial->marked, options_, trial->report, std::move(left));
        start.bad.clear();
        for (const HalfedgeId h : left)
            if (!trial->marked.is_planar(h)) start.bad.push_back(trial->mesh.edge(h));
        sort_unique(start.bad);
        start.queue = std::move(left);
        trial->marked.fix_vertices();
        return trial;
    }

    [[nodiscard]] static bool misses_its_plan(const Trial& trial) {
        return !trial.done() || trial.report.splits > trial.planned + trial.planned / 10 + 10;
    }

    /// Where the shells that finish a plan explode.
    [[nodiscard]] static std::size_t some_more_than(std::size_t planned) { return planned + planned / 4 + 10'000; }

    /// Stops early where the shells that finish it explode.
    TrialPointer by_plan(SplitPlanner& planner, std::vector<SplitPoint> plan) {
        for (int mendings = most_mendings;;) {
            const std::size_t most = most_by_plan_ != unlimited ? most_by_plan_ : some_more_than(plan.size());
            std::vector<HalfedgeId> left;
            TrialPointer trial = carry_out_plan(plan, std::min(most, most_splits_), left);
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
            finish(*trial, std::min(most, most_splits_), std::move(left));
            if (trial->report.stop == StopReason::max_vertices && !has_other_way_)
                failed_.push_back({still_open, std::move(plan)});
            return trial;
        }
    }

    TrialPointer carry_out_plan(const std::vector<SplitPoint>& plan, std::size_t most, std::vector<HalfedgeId>& left) {
        // With room for explosions, up to where they are stopped: growing takes the mesh twice.
        auto trial = std::make_unique<Trial>(marked_, report_, some_more_than(plan.size()));
        trial->planned = marked_.split_count() + plan.size();
        const RemeshOptions options = with_at_most_splits(options_, marked_.mesh(), most);
        if (is_cancelled(context_)) {
            trial->report.stop = StopReason::cancelled;
        } else {
            left = carry_out(trial->marked, options, context_, trial->report, start_, plan);
        }
        return trial;
    }

    void finish(Trial& trial, std::size_t most, std::vector<HalfedgeId> left) {
        const RemeshOptions options = with_at_most_splits(options_, marked_.mesh(), most);
        if (trial.done()) refine_and_clean(trial.marked, options, context_, trial.report, std::move(left));
        trial.report.splits = trial.marked.split_count();
    }

    /// Follows explosions to their end, which may come in time; the plan that leaves least to them first. `last` is
    /// what is left of the last one.
    TrialPointer by_failed_plans(TrialPointer last) {
        std::sort(failed_.begin(), failed_.end(),
                  [](const FailedPlan& a, const FailedPlan& b) { return a.open < b.open; });
        for (const FailedPlan& failed : failed_) {
            last.reset();
            std::vector<HalfedgeId> left;
            last = carry_out_plan(failed.plan, most_splits_, left);
            finish(*last, most_splits_, std::move(left));
            if (last->done() || last->cancelled()) break;
        }
        return last;
    }

    /// Where neither shells nor any plan ended within what was allowed: the best plan with all that the user allows.
    TrialPointer by_closest_plan(TrialPointer shells) {
        if (failed_.empty()) return shells;
        shells.reset();
        std::vector<HalfedgeId> left;
        TrialPointer trial = carry_out_plan(failed_.front().plan, unlimited, left);
        finish(*trial, unlimited, std::move(left));
        return trial;
    }

    struct FailedPlan {
        std::size_t open = 0;  ///< edges that it leaves to shells
        std::vector<SplitPoint> plan;
    };

    const MarkedMesh& marked_;
    const RemeshOptions& options_;
    const Context* context_;
    const RefineStart& start_;
    const RemeshReport& report_;
    const bool has_other_way_;
    Mesh* const spare_;  ///< see preserve_with_fewest
    const bool may_part_;
    std::size_t most_splits_ = unlimited;   ///< of a plan that is carried out
    std::size_t most_by_plan_ = unlimited;  ///< the same, where the shells end
    bool has_sliced_ = false;
    std::vector<FailedPlan> failed_;
    FailedPlan blocked_{unlimited, {}};  ///< of the plans with sheets in the way of flips the one that leaves least
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
                          RemeshReport& report, const RefineStart& start, bool has_other_way, Mesh* spare) {
    if (options.effort == 0) return QuickContest(marked, options, context, start).run(report);
    const TrialPointer best = Contest(marked, options, context, start, report, has_other_way, spare).run();
    report = std::move(best->report);
    marked.take(std::move(best->marked));
}

}  // namespace delmesh
