#include "delmesh/mesh/edits.hpp"

#include "delmesh/base/error.hpp"
#include "mesh/editor.hpp"

#include <algorithm>
#include <limits>

namespace delmesh {

bool can_flip(const Mesh& mesh, HalfedgeId h) {
    const HalfedgeId t = mesh.twin(h);
    if (!t.valid()) return false;
    const VertexId u = mesh.apex(h);
    const VertexId v = mesh.apex(t);
    return u != v && !mesh.are_joined(u, v);
}

HalfedgeId flip(Mesh& mesh, HalfedgeId h) {
    MeshEditor edit(mesh);
    const HalfedgeId t = mesh.twin(h);
    const HalfedgeId h_prev = Mesh::prev(h);
    const HalfedgeId t_prev = Mesh::prev(t);
    const VertexId p = mesh.origin(h);
    const VertexId q = mesh.origin(t);
    const VertexId u = mesh.origin(h_prev);
    const VertexId v = mesh.origin(t_prev);

    edit.origin[h.index()] = v;
    edit.origin[t.index()] = u;
    const HalfedgeId outside_u = edit.twin[h_prev.index()];
    const HalfedgeId outside_v = edit.twin[t_prev.index()];
    edit.twin[h.index()] = outside_v;
    edit.twin[t.index()] = outside_u;
    if (outside_v.valid()) edit.twin[outside_v.index()] = h;
    if (outside_u.valid()) edit.twin[outside_u.index()] = t;
    edit.pair(h_prev, t_prev);

    if (edit.out[p.index()] == h) edit.out[p.index()] = Mesh::next(t);
    if (edit.out[q.index()] == t) edit.out[q.index()] = Mesh::next(h);
    if (edit.out[u.index()] == h_prev) edit.out[u.index()] = t;
    if (edit.out[v.index()] == t_prev) edit.out[v.index()] = h;
    return h_prev;
}

bool can_split(const Mesh& mesh, HalfedgeId h) {
    const HalfedgeId t = mesh.twin(h);
    return !t.valid() || mesh.apex(h) != mesh.apex(t);
}

namespace {

/// Adds a triangle whose half-edges have no twins yet; returns its first half-edge.
HalfedgeId add_face(MeshEditor& edit, VertexId a, VertexId b, VertexId c) {
    const HalfedgeId first(edit.origin.size());
    edit.origin.insert(edit.origin.end(), {a, b, c});
    edit.twin.resize(edit.twin.size() + 3);
    return first;
}

/// Moves the outer half-edge `from` (with its twin, and as an outgoing one) to the slot `to`.
void take_over(MeshEditor& edit, HalfedgeId to, HalfedgeId from, VertexId from_origin) {
    const HalfedgeId outside = edit.twin[from.index()];
    edit.twin[to.index()] = outside;
    if (outside.valid()) edit.twin[outside.index()] = to;
    HalfedgeId& out = edit.out[from_origin.index()];
    if (out == from) out = to;
}

}  // namespace

VertexId split_edge(Mesh& mesh, HalfedgeId h, const Vec3& point) {
    constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max() - 1;
    if (mesh.halfedge_count() + 6 > limit || mesh.vertex_count() + 1 > limit)
        throw Error(ErrorCode::too_large, "the mesh has as many elements as 32-bit ids can name and can not grow");
    MeshEditor edit(mesh);
    const HalfedgeId t = mesh.twin(h);
    const VertexId q = mesh.target(h);
    const VertexId u = mesh.apex(h);
    const VertexId s(mesh.vertex_count());
    const Vec3 own_point = point;  // which may stand in the mesh
    edit.make_room();
    edit.points.push_back(own_point);
    edit.out.emplace_back();

    const HalfedgeId sq = add_face(edit, s, q, u);
    const HalfedgeId h_next = Mesh::next(h);
    take_over(edit, Mesh::next(sq), h_next, q);
    edit.origin[h_next.index()] = s;
    edit.pair(h_next, Mesh::prev(sq));
    edit.out[s.index()] = sq;
    if (!t.valid()) return s;

    const HalfedgeId t_prev = Mesh::prev(t);
    const VertexId v = mesh.origin(t_prev);
    const HalfedgeId qs = add_face(edit, q, s, v);
    take_over(edit, Mesh::prev(qs), t_prev, v);
    edit.origin[t.index()] = s;
    if (edit.out[q.index()] == t) edit.out[q.index()] = qs;
    edit.pair(t_prev, Mesh::next(qs));
    edit.pair(sq, qs);
    return s;
}

namespace {

template <class Visit>
void each_neighbour(const Mesh& mesh, VertexId v, Visit&& visit) {
    const HalfedgeId start = mesh.halfedge(v);
    for (HalfedgeId at = start; at.valid();) {
        visit(mesh.target(at));
        if (mesh.is_boundary(Mesh::prev(at))) visit(mesh.apex(at));
        at = mesh.next_around(at);
        if (at == start) break;
    }
}

/// The apex of h loses a face: what is left must still be a fan, and no edge may stay without a face.
bool apex_survives(const Mesh& mesh, HalfedgeId h) {
    if (mesh.is_boundary(Mesh::next(h)) && mesh.is_boundary(Mesh::prev(h))) return false;
    const VertexId a = mesh.apex(h);
    if (mesh.is_boundary(a)) return true;
    int faces = 0;
    const HalfedgeId start = mesh.halfedge(a);
    HalfedgeId at = start;
    do {
        at = mesh.next_around(at);
    } while (++faces < 4 && at != start);
    return faces >= 4;
}

int count_common_neighbours(const Mesh& mesh, VertexId a, VertexId b) {
    std::vector<VertexId> ring;
    each_neighbour(mesh, a, [&](VertexId v) { ring.push_back(v); });
    std::sort(ring.begin(), ring.end());
    int common = 0;
    each_neighbour(mesh, b, [&](VertexId v) { common += std::binary_search(ring.begin(), ring.end(), v) ? 1 : 0; });
    return common;
}

void kill(MeshEditor& edit, HalfedgeId h) {
    edit.origin[h.index()] = VertexId();
    edit.twin[h.index()] = HalfedgeId();
}

/// The face of h dies and its two other edges become one. Returns a half-edge that leaves `kept` and lives on.
HalfedgeId close_face(MeshEditor& edit, HalfedgeId h) {
    const HalfedgeId left = edit.twin[Mesh::next(h).index()];   // apex -> kept, afterwards
    const HalfedgeId right = edit.twin[Mesh::prev(h).index()];  // kept -> apex
    const VertexId apex = edit.origin[Mesh::prev(h).index()];
    if (left.valid()) edit.twin[left.index()] = right;
    if (right.valid()) edit.twin[right.index()] = left;
    if (edit.out[apex.index()] == Mesh::prev(h)) edit.out[apex.index()] = left;
    kill(edit, Mesh::next(h));
    kill(edit, Mesh::prev(h));
    kill(edit, h);
    return right.valid() ? right : Mesh::next(left);
}

}  // namespace

bool can_collapse(const Mesh& mesh, HalfedgeId h) {
    const HalfedgeId t = mesh.twin(h);
    const VertexId a = mesh.origin(h);
    const VertexId b = mesh.target(h);
    if (t.valid() && mesh.is_boundary(a) && mesh.is_boundary(b)) return false;
    if (!apex_survives(mesh, h) || (t.valid() && !apex_survives(mesh, t))) return false;
    return count_common_neighbours(mesh, a, b) == (t.valid() ? 2 : 1);
}

void collapse(Mesh& mesh, HalfedgeId h, const Vec3& point) {
    MeshEditor edit(mesh);
    const VertexId kept = mesh.origin(h);
    const VertexId gone = mesh.target(h);
    const HalfedgeId t = mesh.twin(h);
    const HalfedgeId start = mesh.halfedge(gone);
    for (HalfedgeId at = start; at.valid();) {
        edit.origin[at.index()] = kept;
        at = mesh.next_around(at);
        if (at == start) break;
    }
    const HalfedgeId alive = close_face(edit, h);
    if (t.valid()) close_face(edit, t);
    edit.out[kept.index()] = first_of_fan(mesh, alive);
    edit.points[kept.index()] = point;
    edit.out[gone.index()] = HalfedgeId();
    edit.points[gone.index()].x = std::numeric_limits<double>::quiet_NaN();
}

bool can_remove_face(const Mesh& mesh, FaceId f) {
    HalfedgeId h = Mesh::halfedge(f);
    int boundary = 0;
    HalfedgeId open;
    for (int i = 0; i < 3; ++i, h = Mesh::next(h)) {
        if (!mesh.is_boundary(h)) continue;
        ++boundary;
        open = h;
    }
    return boundary == 1 && !mesh.is_boundary(mesh.apex(open));
}

void remove_face(Mesh& mesh, FaceId f) {
    MeshEditor edit(mesh);
    HalfedgeId h = Mesh::halfedge(f);
    while (!mesh.is_boundary(h)) h = Mesh::next(h);
    const HalfedgeId from_apex = mesh.twin(Mesh::next(h));
    const HalfedgeId to_apex = mesh.twin(Mesh::prev(h));
    edit.out[mesh.apex(h).index()] = from_apex;
    edit.out[mesh.origin(h).index()] = to_apex;
    edit.twin[from_apex.index()] = HalfedgeId();
    edit.twin[to_apex.index()] = HalfedgeId();
    kill(edit, Mesh::next(h));
    kill(edit, Mesh::prev(h));
    kill(edit, h);
}

void remove_isolated(Mesh& mesh, VertexId v) {
    MeshEditor(mesh).points[v.index()].x = std::numeric_limits<double>::quiet_NaN();
}

std::vector<VertexId> compact_vertices(Mesh& mesh) {
    MeshEditor edit(mesh);
    std::vector<VertexId> map(mesh.vertex_count());
    std::size_t count = 0;
    for (std::size_t v = 0; v < map.size(); ++v) {
        if (!mesh.is_live(VertexId(v))) continue;
        edit.out[count] = edit.out[v];
        edit.points[count] = edit.points[v];
        map[v] = VertexId(count++);
    }
    for (VertexId& v : edit.origin)
        if (v.valid()) v = map[v.index()];
    edit.out.resize(count);
    edit.points.resize(count);
    return map;
}

std::vector<FaceId> compact_faces(Mesh& mesh) {
    MeshEditor edit(mesh);
    std::vector<FaceId> map(mesh.face_count());
    std::size_t count = 0;
    for (std::size_t f = 0; f < map.size(); ++f)
        if (mesh.is_live(FaceId(f))) map[f] = FaceId(count++);
    const auto moved = [&map](HalfedgeId h) {
        if (!h.valid()) return h;
        return HalfedgeId(map[Mesh::face(h).index()].value() * 3 + h.value() % 3);
    };
    for (std::size_t h = 0; h < mesh.halfedge_count(); ++h) {
        if (!edit.origin[h].valid()) continue;
        const std::size_t to = moved(HalfedgeId(h)).index();
        edit.origin[to] = edit.origin[h];
        edit.twin[to] = moved(edit.twin[h]);
    }
    for (HalfedgeId& out : edit.out) out = moved(out);
    edit.origin.resize(3 * count);
    edit.twin.resize(3 * count);
    return map;
}

CompactMap compact(Mesh& mesh) {
    CompactMap map;
    map.vertex = compact_vertices(mesh);
    map.face = compact_faces(mesh);
    return map;
}

void renumber(Mesh& mesh, const CompactMap& map) {
    MeshEditor edit(mesh);
    const auto living = [](const auto& ids) {
        return static_cast<std::size_t>(std::count_if(ids.begin(), ids.end(), [](auto id) { return id.valid(); }));
    };
    const auto moved = [&map](HalfedgeId h) {
        if (!h.valid()) return h;
        return HalfedgeId(map.face[Mesh::face(h).index()].value() * 3 + h.value() % 3);
    };
    const std::size_t vertices = living(map.vertex);
    const std::size_t halfedges = 3 * living(map.face);
    std::vector<VertexId> origin(halfedges);
    std::vector<HalfedgeId> twin(halfedges);
    for (std::size_t h = 0; h < edit.origin.size(); ++h) {
        if (!edit.origin[h].valid()) continue;
        const std::size_t to = moved(HalfedgeId(h)).index();
        origin[to] = map.vertex[edit.origin[h].index()];
        twin[to] = moved(edit.twin[h]);
    }
    std::vector<HalfedgeId> out(vertices);
    std::vector<Vec3> points(vertices);
    for (std::size_t v = 0; v < map.vertex.size(); ++v) {
        if (!map.vertex[v].valid()) continue;
        out[map.vertex[v].index()] = moved(edit.out[v]);
        points[map.vertex[v].index()] = edit.points[v];
    }
    edit.origin.swap(origin);
    edit.twin.swap(twin);
    edit.out.swap(out);
    edit.points.swap(points);
}

void shrink(Mesh& mesh) {
    MeshEditor edit(mesh);
    edit.out.shrink_to_fit();
    edit.points.shrink_to_fit();
    edit.origin.shrink_to_fit();
    edit.twin.shrink_to_fit();
}

void reserve(Mesh& mesh, std::size_t vertices, std::size_t faces) {
    MeshEditor edit(mesh);
    edit.origin.reserve(3 * faces);
    edit.twin.reserve(3 * faces);
    edit.out.reserve(vertices);
    edit.points.reserve(vertices);
}

}  // namespace delmesh
