#include "delaunay/marked_mesh.hpp"

#include <utility>

namespace delmesh {

MarkedMesh::MarkedMesh(Mesh& mesh, std::vector<Mark> marks, std::vector<FaceId> facets)
    : mesh_(mesh),
      marks_(std::move(marks)),
      facets_(std::move(facets)),
      input_vertices_(mesh.vertex_count()) {}

HalfedgeId MarkedMesh::flip_planar(HalfedgeId h) {
    const HalfedgeId t = mesh_.twin(h);
    const HalfedgeId h_prev = Mesh::prev(h);
    const HalfedgeId t_prev = Mesh::prev(t);
    marks_[h.index()] = std::exchange(marks_[t_prev.index()], Mark::planar);
    marks_[t.index()] = std::exchange(marks_[h_prev.index()], Mark::planar);
    return flip(mesh_, h);
}

VertexId MarkedMesh::split(HalfedgeId h, const SplitPoint& where, const Vec3& point) {
    const HalfedgeId t = mesh_.twin(h);
    const VertexId s = split_edge(mesh_, h, point);
    splits_.push_back(where);
    const Mark mark = marks_[h.index()];
    const Mark beyond_next = std::exchange(marks_[Mesh::next(h).index()], Mark::planar);
    marks_.insert(marks_.end(), {mark, beyond_next, Mark::planar});
    copy_facet(h);
    if (!t.valid()) return s;
    const Mark beyond_prev = std::exchange(marks_[Mesh::prev(t).index()], Mark::planar);
    marks_.insert(marks_.end(), {mark, Mark::planar, beyond_prev});
    copy_facet(t);
    return s;
}

void MarkedMesh::copy_facet(HalfedgeId h) {
    if (!facets_.empty()) facets_.push_back(facets_[Mesh::face(h).index()]);
}

void MarkedMesh::reserve_splits(std::size_t count) {
    // Memory that is reserved but never touched costs nothing; growing a vector costs it twice.
    reserve(mesh_, mesh_.vertex_count() + count, mesh_.face_count() + 2 * count);
    marks_.reserve(marks_.size() + 6 * count);
    if (!facets_.empty()) facets_.reserve(facets_.size() + 2 * count);
    splits_.reserve(splits_.size() + count);
}

Provenance MarkedMesh::take_provenance() {
    Provenance result;
    result.input_vertices = input_vertices_;
    result.splits = std::move(splits_);
    result.facet_of_face = std::move(facets_);
    return result;
}

}  // namespace delmesh
