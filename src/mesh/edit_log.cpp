#include "mesh/edit_log.hpp"

#include "delmesh/mesh/edits.hpp"
#include "mesh/editor.hpp"

namespace delmesh {

void EditLog::keep() {
    vertices_ = mesh_.vertex_count();
    halfedges_ = mesh_.halfedge_count();
    faces_.clear();
    points_.clear();
    changed_.clear();
}

/// The face of h, and those beyond its sides, whose twins may change.
void EditLog::note_face(HalfedgeId h) {
    changed_.push_back(Mesh::face(h));
    const auto note = [this](FaceId f) {
        FaceState state{f, {}, {}};
        for (std::size_t i = 0; i < 3; ++i) {
            const HalfedgeId at(3 * f.index() + i);
            state.origin[i] = mesh_.origin(at);
            state.twin[i] = mesh_.twin(at);
        }
        faces_.push_back(state);
    };
    note(Mesh::face(h));
    for (const HalfedgeId side : {h, Mesh::next(h), Mesh::prev(h)})
        if (mesh_.twin(side).valid()) note(Mesh::face(mesh_.twin(side)));
    for (const HalfedgeId side : {h, Mesh::next(h), Mesh::prev(h)}) note_vertex(mesh_.origin(side));
}

void EditLog::note_vertex(VertexId v) {
    points_.push_back({v, mesh_.halfedge(v), mesh_.point(v)});
}

void EditLog::note_around(VertexId v) {
    const HalfedgeId start = mesh_.halfedge(v);
    for (HalfedgeId at = start; at.valid();) {
        note_face(at);
        at = mesh_.next_around(at);
        if (at == start) break;
    }
}

HalfedgeId EditLog::flip(HalfedgeId h) {
    note_face(h);
    note_face(mesh_.twin(h));
    return delmesh::flip(mesh_, h);
}

void EditLog::collapse(HalfedgeId h, const Vec3& point) {
    note_around(mesh_.origin(h));
    note_around(mesh_.target(h));
    delmesh::collapse(mesh_, h, point);
}

VertexId EditLog::split_edge(HalfedgeId h, const Vec3& point) {
    note_face(h);
    if (mesh_.twin(h).valid()) note_face(mesh_.twin(h));
    const std::size_t before = mesh_.face_count();
    const VertexId s = delmesh::split_edge(mesh_, h, point);
    for (std::size_t f = before; f < mesh_.face_count(); ++f) changed_.emplace_back(f);
    return s;
}

void EditLog::set_point(VertexId v, const Vec3& point) {
    note_vertex(v);
    mesh_.set_point(v, point);
}

void EditLog::undo() {
    MeshEditor edit(mesh_);
    for (auto state = faces_.rbegin(); state != faces_.rend(); ++state) {
        for (std::size_t i = 0; i < 3; ++i) {
            edit.origin[3 * state->face.index() + i] = state->origin[i];
            edit.twin[3 * state->face.index() + i] = state->twin[i];
        }
    }
    for (auto state = points_.rbegin(); state != points_.rend(); ++state) {
        edit.out[state->vertex.index()] = state->out;
        edit.points[state->vertex.index()] = state->point;
    }
    edit.origin.resize(halfedges_);
    edit.twin.resize(halfedges_);
    edit.out.resize(vertices_);
    edit.points.resize(vertices_);
    keep();
}

}  // namespace delmesh
