#pragma once
// Edges that no collapse can take as long as the neighbours of their ends are what they are.

#include "delmesh/mesh/mesh.hpp"

#include <vector>

namespace delmesh {

/// For each half-edge that names an edge: a vertex that is joined to both of its ends but lies in no face at the edge.
/// A collapse would pinch the mesh there. Not valid where there is none. Much cheaper than to ask for each edge alone.
[[nodiscard]] std::vector<VertexId> find_tangles(const Mesh& mesh);

}  // namespace delmesh
