#include "delmesh/base/error.hpp"
#include "delmesh/mesh/edits.hpp"
#include "mesh/editor.hpp"

#include <limits>
#include <vector>

namespace delmesh {
namespace {

/// The half-edges of the edge from v to a neighbour, either of which may be missing at the boundary.
struct Spoke {
    HalfedgeId out;  ///< v -> neighbour
    HalfedgeId in;   ///< neighbour -> v
    [[nodiscard]] bool exists() const { return out.valid() || in.valid(); }
};

Spoke find_spoke(const Mesh& mesh, VertexId v, VertexId neighbour) {
    Spoke spoke;
    const HalfedgeId start = mesh.halfedge(v);
    for (HalfedgeId at = start; at.valid();) {
        if (mesh.target(at) == neighbour) spoke.out = at;
        if (mesh.apex(at) == neighbour) spoke.in = Mesh::prev(at);
        at = mesh.next_around(at);
        if (at == start) break;
    }
    return spoke;
}

/// The half-edges that leave v on the faces from `right` counter-clockwise to `left`.
std::vector<HalfedgeId> find_part(const Mesh& mesh, VertexId v, const Spoke& left, const Spoke& right) {
    std::vector<HalfedgeId> part;
    const HalfedgeId start = mesh.halfedge(v);
    const bool is_open = mesh.is_boundary(start);
    HalfedgeId at = right.out;
    // Past the end of an open fan (or without `right`) it goes on at the start, unless `left` is the start.
    if (!at.valid()) at = left.in.valid() ? start : HalfedgeId();
    while (at.valid()) {
        part.push_back(at);
        if (Mesh::prev(at) == left.in) break;
        at = mesh.next_around(at);
        if (!at.valid() && is_open && left.in.valid()) at = start;
    }
    return part;
}

HalfedgeId add_face(MeshEditor& edit, VertexId a, VertexId b, VertexId c) {
    const HalfedgeId first(edit.origin.size());
    edit.origin.insert(edit.origin.end(), {a, b, c});
    edit.twin.resize(edit.twin.size() + 3);
    return first;
}

}  // namespace

bool can_split_vertex(const Mesh& mesh, VertexId v, VertexId left, VertexId right) {
    if (!mesh.halfedge(v).valid() || left == right || !left.valid()) return false;
    if (!find_spoke(mesh, v, left).exists()) return false;
    if (right.valid()) return find_spoke(mesh, v, right).exists();
    return mesh.is_boundary(v);
}

VertexId split_vertex(Mesh& mesh, VertexId v, VertexId left, VertexId right, const Vec3& point) {
    constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max() - 1;
    if (mesh.halfedge_count() + 6 > limit || mesh.vertex_count() + 1 > limit)
        throw Error(ErrorCode::too_large, "the mesh has as many elements as 32-bit ids can name and can not grow");
    const Spoke l = find_spoke(mesh, v, left);
    const Spoke r = right.valid() ? find_spoke(mesh, v, right) : Spoke{};
    const std::vector<HalfedgeId> part = find_part(mesh, v, l, r);

    MeshEditor edit(mesh);
    const VertexId n(edit.points.size());
    const Vec3 own_point = point;  // which may stand in the mesh
    edit.make_room();
    edit.points.push_back(own_point);
    edit.out.emplace_back();
    for (const HalfedgeId h : part) edit.origin[h.index()] = n;

    const HalfedgeId vn = add_face(edit, v, n, left);  // v->n, n->left, left->v
    edit.pair(Mesh::next(vn), l.in);
    edit.pair(Mesh::prev(vn), l.out);
    HalfedgeId of_n = Mesh::next(vn);
    HalfedgeId of_right;
    if (right.valid()) {
        const HalfedgeId nv = add_face(edit, n, v, right);  // n->v, v->right, right->n
        edit.pair(nv, vn);
        edit.pair(Mesh::next(nv), r.in);
        edit.pair(Mesh::prev(nv), r.out);
        of_n = nv;
        of_right = Mesh::prev(nv);
    }
    edit.out[v.index()] = first_of_fan(mesh, vn);
    edit.out[n.index()] = first_of_fan(mesh, of_n);
    edit.out[left.index()] = first_of_fan(mesh, Mesh::prev(vn));
    if (of_right.valid()) edit.out[right.index()] = first_of_fan(mesh, of_right);
    return n;
}

}  // namespace delmesh
