#pragma once
// Where to split which edges so that few points are needed: the search of docs/fewest.md.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/delaunay/provenance.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace delmesh {

struct SplitSearchOptions {
    int effort = 0;  ///< 0: construction only; each step more doubles the work
    std::uint64_t seed = 1;
};

/// Points on physical edges after which, in exact arithmetic, all of these would be Delaunay; ordered by edge and
/// parameter. `marked`: planar edges are Delaunay; `bad`: the physical edges that are not, in order. `baseline`:
/// another solution, that is taken region by region where it has fewer points or the search has found none; may be
/// empty, and then regions without a solution keep edges that are not Delaunay. Deterministic. Memory: linear in the
/// faces around the points. Returns nothing when cancelled.
[[nodiscard]] std::vector<SplitPoint> choose_splits(const MarkedMesh& marked, std::span<const EdgeId> bad,
                                                    std::span<const SplitPoint> baseline,
                                                    const SplitSearchOptions& options, const Context* context);

}  // namespace delmesh
