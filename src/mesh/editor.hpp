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

    /// Room for one more vertex and two more faces: an edit that begins with this can not fail half-way.
    void make_room() {
        reserve_more(points, 1);
        reserve_more(out, 1);
        reserve_more(origin, 6);
        reserve_more(twin, 6);
    }

    std::vector<VertexId>& origin;
    std::vector<HalfedgeId>& twin;
    std::vector<HalfedgeId>& out;
    std::vector<Vec3>& points;

private:
    template <class T>
    static void reserve_more(std::vector<T>& items, std::size_t more) {
        if (items.capacity() - items.size() < more) items.reserve(2 * items.size() + more);
    }
};

/// The outgoing half-edge that `Mesh::halfedge(v)` promises, starting from any one.
inline HalfedgeId first_of_fan(const Mesh& mesh, HalfedgeId start) {
    HalfedgeId at = start;
    while (mesh.twin(at).valid()) {
        at = Mesh::next(mesh.twin(at));
        if (at == start) break;
    }
    return at;
}

}  // namespace delmesh
