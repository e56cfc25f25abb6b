#pragma once
// What comes of a plan of splits is tried on a copy of the mesh.

#include "delaunay/refine.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace delmesh {

/// All trials of a run begin from this, and leave it as it is. It must outlive them.
struct TrialStart {
    const MarkedMesh& marked;
    const RemeshOptions& options;
    const Context* context;
    const RefineStart& start;
    const RemeshReport& report;
};

/// A copy of the mesh to try something on.
struct SplitTrial {
    /// With room for so many splits.
    SplitTrial(const MarkedMesh& from, const RemeshReport& so_far, std::size_t splits)
        : marked(mesh, from, splits),
          report(so_far) {}
    ~SplitTrial() = default;
    SplitTrial(const SplitTrial&) = delete;
    SplitTrial(SplitTrial&&) = delete;
    SplitTrial& operator=(const SplitTrial&) = delete;
    SplitTrial& operator=(SplitTrial&&) = delete;

    [[nodiscard]] bool done() const { return report.stop == StopReason::done; }
    [[nodiscard]] bool cancelled() const { return report.stop == StopReason::cancelled; }
    [[nodiscard]] bool beats(const RemeshReport& other) const {
        return done() && (other.stop != StopReason::done || report.splits < other.splits);
    }
    /// By what shells had to add.
    [[nodiscard]] bool misses_its_plan() const { return !done() || report.splits > planned + planned / 10 + 10; }

    Mesh mesh;
    MarkedMesh marked;
    RemeshReport report;
    std::size_t planned = 0;  ///< splits
};

using TrialPointer = std::unique_ptr<SplitTrial>;

constexpr std::size_t unlimited_splits = std::numeric_limits<std::size_t>::max();

/// Stop with `max_vertices` where more splits than these would be needed.
[[nodiscard]] RemeshOptions with_at_most_splits(const RemeshOptions& options, const Mesh& mesh, std::size_t splits);

/// Shells alone. They stop with `max_vertices` where more splits than these would be needed.
[[nodiscard]] TrialPointer try_shells(const TrialStart& from, std::size_t most_splits);

/// Splits where the plan says, and flips. Edges that are not Delaunay after that are left.
[[nodiscard]] TrialPointer carry_out_plan(const TrialStart& from, std::span<const SplitPoint> plan,
                                          std::size_t most_splits, std::vector<HalfedgeId>& left);

/// Shells split what is left.
void finish_by_shells(const TrialStart& from, SplitTrial& trial, std::size_t most_splits, std::vector<HalfedgeId> left);

/// Both, one after the other.
[[nodiscard]] TrialPointer try_plan(const TrialStart& from, std::span<const SplitPoint> plan, std::size_t most_splits);

/// The ends of the input edges that these are parts of, sorted.
[[nodiscard]] std::vector<std::array<VertexId, 2>> input_edges(const SplitTrial& trial,
                                                               std::span<const HalfedgeId> parts);

/// Where the shells that finish a plan explode.
[[nodiscard]] constexpr std::size_t some_more_than(std::size_t planned) {
    return planned + planned / 4 + 10'000;
}

}  // namespace delmesh
