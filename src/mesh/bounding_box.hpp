#pragma once
// Where a mesh lies.

#include "base/box.hpp"
#include "delmesh/mesh/mesh.hpp"

namespace delmesh {

/// The box of all vertices that have a face. Cost: O(vertices).
[[nodiscard]] inline Box bounding_box(const Mesh& mesh) {
    Box box;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.halfedge(VertexId(v)).valid()) box.add(mesh.point(VertexId(v)));
    return box;
}

}  // namespace delmesh
