#pragma once
// Places on an edge where a thread of points over several edges would go on.

#include "delaunay/split_model.hpp"
#include "delaunay/stretch.hpp"

#include <cstdint>
#include <vector>

namespace delmesh {

/// For each point on another edge of the two facets: at the same distance from the corner where the two edges meet (so
/// that threads around a sharp corner close), and parallel to the third side of a triangle. Sorts `places`.
void add_aligned_places(const SplitModel& model, std::uint32_t e, const Stretch& within, std::vector<double>& places);

/// For what the stretch sees under the largest angle, on both sides: its foot, and where a straight thread arrives
/// that comes over it from beyond. Sorts `places`.
void add_thread_places(const SplitModel& model, std::uint32_t e, const Stretch& within, std::vector<double>& places);

}  // namespace delmesh
