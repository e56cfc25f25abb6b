#pragma once
// A proved lower bound for the number of split points, better than the number of edges that are not Delaunay.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/base/context.hpp"

#include <span>

namespace delmesh {

struct SplitBoundOptions {
    bool exact_facets = true;  ///< facets are plane exactly, not only within a tolerance
    /// How far the output's split points may lie off their edges, as a part of the largest coordinate.
    double rounding = 0x1p-50;
};

/// So many points at least must be put on physical edges, whoever does it and wherever, until all edges are Delaunay.
/// `bad`: the physical edges that are not Delaunay while planar ones are. Proved by interval arithmetic; docs/fewest.md
/// has the argument. Deterministic. At least bad.size(). Cost: linear in `bad` where facets are small.
[[nodiscard]] std::size_t strong_lower_bound(const MarkedMesh& marked, std::span<const EdgeId> bad,
                                             const SplitBoundOptions& options, const Context* context);

}  // namespace delmesh
