#pragma once

#include "delmesh/mesh/mesh.hpp"

#include <cstddef>

namespace delmesh {

/// How many vertices a mesh of the topology of this one needs at least: the same components, handles and boundary
/// loops. A lower bound (but for two
/// triangles back to back): as many as there must be for all edges to join different pairs, and 3 for each boundary
/// loop. For closed components it is attained by abstract meshes (Jungerman and Ringel 1980), though seldom by flat
/// faces in space. Cost: O(size).
[[nodiscard]] std::size_t least_vertices(const Mesh& mesh);

}  // namespace delmesh
