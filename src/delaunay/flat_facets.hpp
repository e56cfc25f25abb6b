#pragma once
// Facets that are plane but for a small tolerance.

#include "delaunay/marked_mesh.hpp"
#include "delaunay/unit_frame.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <vector>

namespace delmesh {

/// Joins facets across physical edges, greedily from the largest one on, as long as all vertices of what they form lie
/// between two parallel planes and all its faces look the same way along one of the axes, both proved. Along that axis
/// the planes are at most `width` (in the frame) apart. So however such a facet is cut into triangles that look that
/// way, no point of it is farther than `width` from the surface before. Edges inside become planar. `marks` and
/// `facets` as from classify.hpp. Sequential but for a first look at every edge; O(faces log faces).
[[nodiscard]] FlatFacets join_flat_facets(const Mesh& mesh, const UnitFrame& frame, double width,
                                          std::vector<Mark>& marks, std::vector<FaceId>& facets,
                                          const Context* context);

}  // namespace delmesh
