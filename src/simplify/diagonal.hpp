#pragma once
// The other diagonal of the two faces at an edge: faces that do not lie in a plane often have two that are Delaunay.

#include "delmesh/mesh/mesh.hpp"
#include "simplify/star.hpp"

namespace delmesh {

/// Exact: the edge of h may be flipped, and then that edge and the four around it are Delaunay; no face turns over.
[[nodiscard]] bool can_flip_delaunay(const Mesh& mesh, double scale, HalfedgeId h);

/// True if a face would turn over by flipping h.
[[nodiscard]] bool turns_over(const Mesh& mesh, double scale, HalfedgeId h);

/// The star of the apex of h in the two faces as they will be once h is flipped.
void gather_flipped(const Mesh& mesh, HalfedgeId h, double scale, Star& star);

}  // namespace delmesh
