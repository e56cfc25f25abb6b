#pragma once
// A proved lower bound for the number of split points, better than the number of edges that are not Delaunay.

#include "delaunay/cluster_cores.hpp"
#include "delaunay/marked_mesh.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/delaunay/remesh.hpp"

#include <span>
#include <vector>

namespace delmesh {

struct SplitBoundOptions {
    bool exact_facets = true;  ///< facets are plane exactly, not only within a tolerance
    /// How far the output's split points may lie off their edges, as a part of the largest coordinate.
    double rounding = 0x1p-50;
};

/// With a flat tolerance that is given.
[[nodiscard]] SplitBoundOptions bound_options(const RemeshOptions& options);

/// So many points at least must be put on physical edges, whoever does it and wherever, until all edges are Delaunay.
/// `bad`: the physical edges that are not Delaunay while planar ones are. Proved by interval arithmetic; docs/fewest.md
/// has the argument. Deterministic. At least bad.size(). Cost: linear in `bad` where facets are small.
class SplitBound {
public:
    SplitBound(const MarkedMesh& marked, std::span<const EdgeId> bad, const SplitBoundOptions& options,
               const Context* context);

    [[nodiscard]] std::size_t points() const { return points_; }
    /// See ClusterCores.
    void close_gaps(GapTask& task, const Context* context) { points_ += clusters_.close_gaps(task, context); }
    [[nodiscard]] std::size_t gap_work() const { return clusters_.gap_work(); }

private:
    std::size_t points_ = 0;
    std::vector<bool> is_open_;
    BoundView view_;
    CorePacking packing_;
    ClusterCores clusters_;
};

/// The same as a number.
[[nodiscard]] std::size_t strong_lower_bound(const MarkedMesh& marked, std::span<const EdgeId> bad,
                                             const SplitBoundOptions& options, const Context* context);

}  // namespace delmesh
