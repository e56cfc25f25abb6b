#pragma once
// Places for very few points, tried on the mesh itself in exact arithmetic.

#include "delaunay/refine.hpp"

#include <cstddef>
#include <vector>

namespace delmesh {

/// A plan with fewer than `below` points after which every edge is Delaunay, or an empty one if none was found.
///
/// Needles may have no other solution than one that a model in doubles can not see: a point some ulps from an end, or
/// just below another one. Here a point is tried at the feet of what sees an edge, at equal distances from its ends,
/// and at distances 2^-k from these and from the ends; then the same for an edge that is not Delaunay now, and so on,
/// with one point first, then two, then three. That is complete but for the places: an edge that is not Delaunay must
/// be split, whatever else is. Among plans with as few points the one with the largest smallest angle is taken.
/// For few bad edges only. Bounded work: some million faces looked at, whatever the mesh. Deterministic.
[[nodiscard]] std::vector<SplitPoint> probe_splits(const MarkedMesh& marked, const RemeshOptions& options,
                                                   const RefineStart& start, std::size_t below, const Context* context);

}  // namespace delmesh
