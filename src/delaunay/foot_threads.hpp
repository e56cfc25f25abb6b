#pragma once
// Threads that cross narrow facets at right angles.

#include "delaunay/split_model.hpp"
#include "delaunay/split_repair.hpp"

#include <cstddef>

namespace delmesh {

/// Works off the model's suspects: a bad part is split at the foot of the point that it sees under the larger angle.
/// Where facets are narrow, the points that this calls for on the edges beyond lie on lines at right angles to all of
/// them, which end where facets are wide or at a border. False after `steps` steps, or with more than `max_points`.
[[nodiscard]] bool lay_foot_threads(SplitModel& model, const SplitRepair& limits, std::size_t max_points,
                                    std::size_t steps);

}  // namespace delmesh
