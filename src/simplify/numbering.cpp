#include "simplify/numbering.hpp"

#include "delmesh/mesh/edits.hpp"
#include "mesh/bounding_box.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace delmesh {
namespace {

/// Ids for the living elements in the order of `place`, which gives each element its own number below `places`.
template <class Id, class Place>
std::vector<Id> rank(const Mesh& mesh, std::size_t count, std::size_t places, Place&& place) {
    std::vector<Id> at(places);
    for (std::size_t i = 0; i < count; ++i)
        if (mesh.is_live(Id(i))) at[place(Id(i))] = Id(i);
    std::vector<Id> ids(count);
    std::size_t next = 0;
    for (const Id id : at)
        if (id.valid()) ids[id.index()] = Id(next++);
    return ids;
}

/// Puts two zero bits before each of the lowest 21 bits.
std::uint64_t spread(std::uint64_t x) {
    x &= 0x1fffff;
    x = (x | x << 32) & 0x1f00000000ffff;
    x = (x | x << 16) & 0x1f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
}

/// Faces in the order of the first of their vertices, then as they were.
std::vector<FaceId> rank_faces(const Mesh& mesh, const std::vector<VertexId>& vertex) {
    const auto first_vertex = [&](std::size_t f) {
        const auto corners = mesh.corners().subspan(3 * f, 3);
        return std::min({vertex[corners[0].index()], vertex[corners[1].index()], vertex[corners[2].index()]}).index();
    };
    std::vector<std::uint32_t> first(mesh.vertex_count() + 1);
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.is_live(FaceId(f))) ++first[first_vertex(f) + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::vector<FaceId> ids(mesh.face_count());
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.is_live(FaceId(f))) ids[f] = FaceId(first[first_vertex(f)]++);
    return ids;
}

}  // namespace

Numbering::Numbering(const Mesh& mesh)
    : vertex_(mesh.vertex_count()),
      face_(mesh.face_count()),
      vertex_names_(mesh.vertex_count()),
      face_names_(mesh.face_count()) {
    for (std::size_t v = 0; v < vertex_.size(); ++v) vertex_[v] = VertexId(v);
    for (std::size_t f = 0; f < face_.size(); ++f) face_[f] = FaceId(f);
}

std::vector<VertexId> Numbering::ids() const {
    std::vector<VertexId> ids(vertex_names_);
    for (std::size_t v = 0; v < vertex_.size(); ++v) ids[vertex_[v].index()] = VertexId(v);
    return ids;
}

void Numbering::renumber(Mesh& mesh, const CompactMap& map) {
    delmesh::renumber(mesh, map);
    std::vector<VertexId> vertex(mesh.vertex_count());
    std::vector<FaceId> face(mesh.face_count());
    for (std::size_t v = 0; v < vertex_.size(); ++v)
        if (map.vertex[v].valid()) vertex[map.vertex[v].index()] = vertex_[v];
    for (std::size_t f = 0; f < face_.size(); ++f)
        if (map.face[f].valid()) face[map.face[f].index()] = face_[f];
    vertex_.swap(vertex);
    face_.swap(face);
}

CompactMap Numbering::close_gaps(Mesh& mesh) {
    CompactMap map;
    map.vertex = close_vertex_gaps(mesh);
    map.face = close_face_gaps(mesh);
    shrink(mesh);
    return map;
}

std::vector<VertexId> Numbering::close_vertex_gaps(Mesh& mesh) {
    std::vector<VertexId> map = compact_vertices(mesh);
    move_down(vertex_, map);
    return map;
}

std::vector<FaceId> Numbering::close_face_gaps(Mesh& mesh) {
    std::vector<FaceId> map = compact_faces(mesh);
    move_down(face_, map);
    return map;
}

CompactMap Numbering::in_order_of_names(const Mesh& mesh) const {
    return {rank<VertexId>(mesh, mesh.vertex_count(), vertex_names_,
                           [&](VertexId v) { return vertex_[v.index()].index(); }),
            rank<FaceId>(mesh, mesh.face_count(), face_names_, [&](FaceId f) { return face_[f.index()].index(); })};
}

CompactMap in_order_of_place(const Mesh& mesh, double scale) {
    const Vec3 low = bounding_box(mesh).low;
    // Local coordinates reach 4 at most.
    constexpr double cells = 1 << 18;
    std::vector<std::pair<std::uint64_t, VertexId>> order;
    order.reserve(mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.is_live(VertexId(v))) continue;
        const Vec3 x = (mesh.points()[v] - low) * scale * cells;
        const auto cell = [](double value) {
            return spread(static_cast<std::uint64_t>(std::clamp(value, 0.0, 2097151.0)));
        };
        order.emplace_back(cell(x.x) << 2 | cell(x.y) << 1 | cell(x.z), VertexId(v));
    }
    std::sort(order.begin(), order.end());
    CompactMap map{std::vector<VertexId>(mesh.vertex_count()), {}};
    for (std::size_t i = 0; i < order.size(); ++i) map.vertex[order[i].second.index()] = VertexId(i);
    map.face = rank_faces(mesh, map.vertex);
    return map;
}

void drop_isolated(Mesh& mesh) {
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.is_live(VertexId(v)) && !mesh.halfedge(VertexId(v)).valid()) remove_isolated(mesh, VertexId(v));
}

}  // namespace delmesh
