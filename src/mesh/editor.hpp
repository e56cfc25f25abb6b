#pragma once
// The private door to the arrays of a mesh: for the edits, and for nothing else.

#include "delmesh/mesh/mesh.hpp"

#include <vector>

namespace delmesh {

class MeshEditor {
public:
    explicit MeshEditor(Mesh& mesh) : origin(mesh.origin_), twin(mesh.twin_), out(mesh.out_), points(mesh.points_) {}

    void pair(HalfedgeId a, HalfedgeId b) {
        if (a.valid()) twin[a.index()] = b;
        if (b.valid()) twin[b.index()] = a;
    }

    std::vector<VertexId>& origin;
    std::vector<HalfedgeId>& twin;
    std::vector<HalfedgeId>& out;
    std::vector<Vec3>& points;
};

}  // namespace delmesh
