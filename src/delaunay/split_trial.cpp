#include "delaunay/split_trial.hpp"

#include "base/sort_unique.hpp"
#include "delaunay/split_point.hpp"
#include "delaunay/vertex_limit.hpp"

#include <utility>

namespace delmesh {

RemeshOptions with_at_most_splits(const RemeshOptions& options, const Mesh& mesh, std::size_t splits) {
    return splits == unlimited_splits ? options : with_at_most(options, mesh.vertex_count() + splits);
}

TrialPointer try_shells(const TrialStart& from, std::size_t most_splits) {
    const RemeshOptions options = with_at_most_splits(from.options, from.marked.mesh(), most_splits);
    // Explosions would make the mesh grow step by step, which takes it twice.
    const std::size_t room = most_splits == unlimited_splits ? 6 * from.start.bad.size() : most_splits;
    auto trial = std::make_unique<SplitTrial>(from.marked, from.report, room);
    refine_and_clean(trial->marked, options, from.context, trial->report, from.start.queue);
    return trial;
}

TrialPointer carry_out_plan(const TrialStart& from, std::span<const SplitPoint> plan, std::size_t most_splits,
                            std::vector<HalfedgeId>& left) {
    // With room for explosions, up to where they are stopped: growing takes the mesh twice.
    auto trial = std::make_unique<SplitTrial>(from.marked, from.report, some_more_than(plan.size()));
    trial->planned = from.marked.split_count() + plan.size();
    if (is_cancelled(from.context)) {
        trial->report.stop = StopReason::cancelled;
        return trial;
    }
    const RemeshOptions options = with_at_most_splits(from.options, from.marked.mesh(), most_splits);
    left = carry_out(trial->marked, options, from.context, trial->report, from.start, plan);
    return trial;
}

void finish_by_shells(const TrialStart& from, SplitTrial& trial, std::size_t most_splits,
                      std::vector<HalfedgeId> left) {
    const RemeshOptions options = with_at_most_splits(from.options, from.marked.mesh(), most_splits);
    if (trial.done()) refine_and_clean(trial.marked, options, from.context, trial.report, std::move(left));
    trial.report.splits = trial.marked.split_count();
}

TrialPointer try_plan(const TrialStart& from, std::span<const SplitPoint> plan, std::size_t most_splits) {
    std::vector<HalfedgeId> left;
    TrialPointer trial = carry_out_plan(from, plan, most_splits, left);
    finish_by_shells(from, *trial, most_splits, std::move(left));
    return trial;
}

std::vector<std::array<VertexId, 2>> input_edges(const SplitTrial& trial, std::span<const HalfedgeId> parts) {
    std::vector<std::array<VertexId, 2>> edges;
    for (const HalfedgeId h : parts) {
        if (trial.marked.is_planar(h)) continue;
        const EdgePart part = part_of_input_edge(trial.marked, h);
        edges.push_back({part.a, part.b});
    }
    sort_unique(edges);
    return edges;
}

}  // namespace delmesh
