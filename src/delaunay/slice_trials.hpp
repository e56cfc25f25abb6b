#pragma once
// Planes across needles, where all other plans explode: see docs/fewest.md, Planes.

#include "delaunay/split_trial.hpp"

namespace delmesh {

/// A plan that has nothing of those that exploded. What rounding breaks of it is planned again, at a greater distance
/// from what rounding may do. Returns `exploded` where planes can not be laid; without a mesh if it is
/// `is_spare`: where these do not end, nobody asks for what they have made.
[[nodiscard]] TrialPointer try_slices(const TrialStart& from, TrialPointer exploded, bool is_spare);

}  // namespace delmesh
