#include "delaunay/marked_mesh.hpp"

#include "base/let_go.hpp"
#include "exact/inline.hpp"

#include <algorithm>

namespace delmesh {

MarkedMesh::MarkedMesh(Mesh& mesh, std::vector<Mark> marks, std::vector<FaceId> facets)
    : mesh_(mesh),
      marks_(std::move(marks)),
      facets_(std::move(facets)),
      input_vertices_(mesh.vertex_count()),
      fixed_vertices_(input_vertices_) {}

bool MarkedMesh::is_flippable(HalfedgeId h) {
    const HalfedgeId t = mesh_.twin(h);
    if (!t.valid()) return false;
    const VertexId u = mesh_.apex(h);
    const VertexId v = mesh_.apex(t);
    return mesh_.point(u) != mesh_.point(v) && !hubs_.are_joined(mesh_, u, v);
}

MarkedMesh::MarkedMesh(Mesh& copy, const MarkedMesh& other)
    : mesh_(copy),
      marks_(other.marks_),
      facets_(other.facets_),
      splits_(other.splits_),
      input_vertices_(other.input_vertices_),
      fixed_vertices_(other.fixed_vertices_),
      flat_(other.flat_),
      merged_(other.merged_) {}

MarkedMesh::MarkedMesh(Mesh& empty, const MarkedMesh& other, std::size_t splits)
    : mesh_(empty),
      input_vertices_(other.input_vertices_),
      fixed_vertices_(other.fixed_vertices_),
      flat_(other.flat_),
      merged_(other.merged_) {
    // Room first: to copy once and to grow afterwards would copy twice.
    const std::size_t faces = other.mesh_.face_count() + 2 * splits;
    reserve(mesh_, other.mesh_.vertex_count() + splits, faces);
    marks_.reserve(3 * faces);
    if (!other.facets_.empty()) facets_.reserve(faces);
    splits_.reserve(other.splits_.size() + splits);
    mesh_ = other.mesh_;
    marks_ = other.marks_;
    facets_ = other.facets_;
    splits_ = other.splits_;
}

void MarkedMesh::take(MarkedMesh&& other) {
    mesh_ = std::move(other.mesh_);
    marks_ = std::move(other.marks_);
    facets_ = std::move(other.facets_);
    splits_ = std::move(other.splits_);
    input_vertices_ = other.input_vertices_;
    fixed_vertices_ = other.fixed_vertices_;
    flat_ = std::move(other.flat_);
    merged_ = std::move(other.merged_);
    hubs_.clear();
}

Sign side_along(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto flat = [axis](const Vec3& p) { return Vec3{p[(axis + 1) % 3], p[(axis + 2) % 3], 0}; };
    const Vec3 above = flat(a);
    // Any height above will do; one of the triangle's own size is the easiest to compute with.
    const double height = std::max({std::fabs(b.x - a.x), std::fabs(b.y - a.y), std::fabs(b.z - a.z)});
    return exact::orientation_inline(above, flat(b), flat(c), {above.x, above.y, height});
}

bool MarkedMesh::keeps_unfolded_in(std::uint32_t plane, HalfedgeId h) const {
    if (plane == 0) return true;
    const HalfedgeId t = mesh_.twin(h);
    const Vec3& u = mesh_.point(mesh_.apex(h));
    const Vec3& v = mesh_.point(mesh_.apex(t));
    const auto& [axis, side, thickness, flipped] = flat_.planes[plane - 1];
    return side_along(axis, u, v, mesh_.point(mesh_.target(h))) == side &&
           side_along(axis, v, u, mesh_.point(mesh_.origin(h))) == side;
}

double MarkedMesh::flattened() const {
    double most = 0;
    for (const FlatFacets::Plane& plane : flat_.planes)
        if (plane.flipped) most = std::max(most, plane.thickness);
    return most;
}

HalfedgeId MarkedMesh::flip_planar(HalfedgeId h) {
    const HalfedgeId t = mesh_.twin(h);
    hubs_.part(mesh_.origin(h), mesh_.target(h));
    hubs_.join(mesh_.apex(h), mesh_.apex(t));
    if (!flat_.plane_of.empty())
        if (const std::uint32_t plane = flat_.plane_of[facets_[Mesh::face(h).index()].index()]; plane != 0)
            flat_.planes[plane - 1].flipped = true;
    const HalfedgeId h_prev = Mesh::prev(h);
    const HalfedgeId t_prev = Mesh::prev(t);
    marks_[h.index()] = std::exchange(marks_[t_prev.index()], Mark::planar);
    marks_[t.index()] = std::exchange(marks_[h_prev.index()], Mark::planar);
    return flip(mesh_, h);
}

VertexId MarkedMesh::split(HalfedgeId h, const SplitPoint& where, const Vec3& point) {
    const HalfedgeId t = mesh_.twin(h);
    const VertexId p = mesh_.origin(h);
    const VertexId q = mesh_.target(h);
    const VertexId s = split_edge(mesh_, h, point);
    hubs_.part(p, q);
    for (const VertexId v : {p, q, mesh_.apex(h)}) hubs_.join(v, s);
    if (t.valid()) hubs_.join(mesh_.apex(t), s);
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

HalfedgeId MarkedMesh::flip_cap(HalfedgeId h) {
    const HalfedgeId t = mesh_.twin(h);
    const bool crease = !is_planar(h);
    if (!facets_.empty()) facets_[Mesh::face(h).index()] = facets_[Mesh::face(t).index()];
    const HalfedgeId made = flip_planar(h);
    if (crease)
        for (const HalfedgeId side : {t, Mesh::next(h)}) mark_physical(side);
    return made;
}

void MarkedMesh::mark_physical(HalfedgeId h) {
    marks_[h.index()] = Mark::physical;
    if (mesh_.twin(h).valid()) marks_[mesh_.twin(h).index()] = Mark::physical;
}

void MarkedMesh::merge(HalfedgeId h) {
    hubs_.clear();
    // In each face that dies, two sides become one edge: a crease if either was.
    for (const HalfedgeId side : {h, mesh_.twin(h)}) {
        if (!side.valid()) continue;
        const HalfedgeId left = mesh_.twin(Mesh::next(side));
        const HalfedgeId right = mesh_.twin(Mesh::prev(side));
        const bool crease = !is_planar(Mesh::next(side)) || !is_planar(Mesh::prev(side));
        for (const HalfedgeId outer : {left, right})
            if (outer.valid() && crease) marks_[outer.index()] = Mark::physical;
    }
    merged_.push_back({mesh_.target(h), mesh_.origin(h)});
    collapse(mesh_, h, mesh_.point(mesh_.origin(h)));
}

void MarkedMesh::drop(FaceId f) {
    hubs_.clear();
    for (HalfedgeId h : {Mesh::halfedge(f), Mesh::next(Mesh::halfedge(f)), Mesh::prev(Mesh::halfedge(f))})
        mark_physical(h);
    remove_face(mesh_, f);
}

void MarkedMesh::compact_all() {
    hubs_.clear();
    CompactMap map = compact(mesh_);
    std::size_t faces = 0;
    for (std::size_t f = 0; f < map.face.size(); ++f) {
        if (!map.face[f].valid()) continue;
        for (std::size_t k = 0; k < 3; ++k) marks_[3 * faces + k] = marks_[3 * f + k];
        if (!facets_.empty()) facets_[faces] = facets_[f];
        ++faces;
    }
    marks_.resize(3 * faces);
    if (!facets_.empty()) facets_.resize(faces);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < splits_.size(); ++i)
        if (map.vertex[input_vertices_ + i].valid()) splits_[kept++] = splits_[i];
    splits_.resize(kept);
    for (auto last = merged_.rbegin(); last != merged_.rend(); ++last)
        map.vertex[(*last)[0].index()] = map.vertex[(*last)[1].index()];
    merged_.clear();
    for (SplitPoint& split : splits_) {
        split.a = map.vertex[split.a.index()];
        split.b = map.vertex[split.b.index()];
    }
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

void MarkedMesh::forget_marks() {
    let_go(marks_);
    hubs_.clear();
}

void MarkedMesh::forget_all() {
    forget_marks();
    mesh_ = Mesh();
    let_go(facets_);
    let_go(splits_);
}

Provenance MarkedMesh::take_provenance() {
    Provenance result;
    result.input_vertices = input_vertices_;
    result.splits = std::move(splits_);
    result.facet_of_face = std::move(facets_);
    return result;
}

}  // namespace delmesh
