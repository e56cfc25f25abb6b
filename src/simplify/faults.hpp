#pragma once
// Edges that are not Delaunay: for meshes that are on the way to have none.

#include "delmesh/mesh/mesh.hpp"
#include "simplify/star.hpp"

#include <cstddef>

namespace delmesh {

/// A *fault* is an edge that is not Delaunay. Exact.
[[nodiscard]] std::size_t count_faults(const Mesh& mesh);

/// Of the edges at both ends of the star's edge, and of the ring around them.
[[nodiscard]] std::size_t count_faults(const Mesh& mesh, const Star& star);

/// Of the edges at w and of the ring, once the edge is merged to w (local). In floating point: a proposal.
[[nodiscard]] std::size_t count_faults(const Mesh& mesh, Star& star, const Vec3& w);

}  // namespace delmesh
