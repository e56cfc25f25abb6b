#pragma once
// Sheets of a surface that lie on each other: a mesh joins two vertices by one edge only, and two sheets may want it.

#include "delaunay/marked_mesh.hpp"

namespace delmesh {

/// The edge of another sheet that joins the two vertices that a flip of the planar edge of h would join. None if there
/// is none.
[[nodiscard]] HalfedgeId edge_in_the_way(const MarkedMesh& marked, HalfedgeId h);

/// Where to split an edge that is in the way. A planar one such that the physical edges around it stay Delaunay, as far
/// from ties as may be.
[[nodiscard]] SplitPoint place_of_parting(const MarkedMesh& marked, HalfedgeId h);

}  // namespace delmesh
