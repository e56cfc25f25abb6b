#pragma once
// Placement fewest: searches for few split points, and keeps the shells where these are not fewer.

#include "delaunay/refine.hpp"

#include <cstddef>

namespace delmesh {

/// As `refine_and_clean` after `start`, but never with more splits. Fills the same of the report, and
/// `splits_by_shells`. With another way to fall back on it stops, with `max_vertices`, as soon as the number of splits
/// explodes whatever is tried. `spare` becomes empty as soon as it is clear that this ends: what is kept for the case
/// that it does not would take memory beside the largest models.
void preserve_with_fewest(MarkedMesh& marked, const RemeshOptions& options, const Context* context,
                          RemeshReport& report, const RefineStart& start, bool has_other_way = false,
                          Mesh* spare = nullptr);

/// Explosions stop here first, with so many edges that must be split.
[[nodiscard]] constexpr std::size_t few_splits(std::size_t bad, bool has_other_way) {
    return 100'000 + (has_other_way ? 10 : 20) * bad;
}

}  // namespace delmesh
