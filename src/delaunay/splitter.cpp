#include "delaunay/splitter.hpp"

#include "delaunay/split_point.hpp"

#include <algorithm>

namespace delmesh {

void Splitter::stop(StopReason reason, HalfedgeId at) {
    stopped_ = true;
    report_.stop = reason;
    if (at.valid()) report_.witness = mesh_.edge(at);
}

/// In the box of the two ends but neither of them: rounding has not moved the point past an end.
bool Splitter::lies_inside(HalfedgeId h, const Vec3& s) const {
    const Vec3& p = mesh_.point(mesh_.origin(h));
    const Vec3& q = mesh_.point(mesh_.target(h));
    if (s == p || s == q) return false;
    for (const int axis : {0, 1, 2})
        if (s[axis] < std::min(p[axis], q[axis]) || s[axis] > std::max(p[axis], q[axis])) return false;
    return true;
}

void Splitter::split_at_shell(HalfedgeId h) {
    if (!can_split(mesh_, h)) return part_doubled_faces(h);
    const EdgePart part = part_of_input_edge(marked_, h);
    const Vec3& a = mesh_.point(part.a);
    const Vec3& b = mesh_.point(part.b);
    const double low = std::min(part.from, part.to);
    const double high = std::max(part.from, part.to);
    // Where rounding moves the point of the shell to an end, the middle may still be free.
    for (const double t : {shell_parameter(part, norm(b - a), options_.shell_unit_abs), 0.5 * (low + high)}) {
        const Vec3 point = point_between(a, b, t, options_.precision);
        if (!(low < t && t < high) || !lies_inside(h, point)) continue;
        return split(h, {part.a, part.b, t}, point);
    }
    stop(StopReason::unresolved, h);
}

void Splitter::halve(HalfedgeId h) {
    if (!can_split(mesh_, h)) return part_doubled_faces(h);
    const VertexId a = std::min(mesh_.origin(h), mesh_.target(h));
    const VertexId b = std::max(mesh_.origin(h), mesh_.target(h));
    const Vec3 point = point_between(mesh_.point(a), mesh_.point(b), 0.5, options_.precision);
    if (!lies_inside(h, point)) return stop(StopReason::unresolved, h);
    split(h, {a, b, 0.5}, point);
}

VertexId Splitter::split_between(VertexId u, VertexId v, const SplitPoint& where) {
    HalfedgeId h = mesh_.find_halfedge(u, v);
    if (!h.valid()) h = mesh_.find_halfedge(v, u);
    if (!h.valid() || !can_split(mesh_, h)) return {};
    const Vec3 point = point_between(mesh_.point(where.a), mesh_.point(where.b), where.t, options_.precision);
    if (!lies_inside(h, point)) return {};
    const std::size_t before = mesh_.vertex_count();
    split(h, where, point);
    return mesh_.vertex_count() > before ? VertexId(before) : VertexId();
}

/// Two faces over the same three vertices: a vertex on their edge would be joined to their common apex twice. A vertex
/// on another of their edges parts them first.
void Splitter::part_doubled_faces(HalfedgeId h) {
    for (const HalfedgeId side : {Mesh::next(h), Mesh::prev(h)}) {
        if (!can_split(mesh_, side)) continue;
        touched_.push_back(h);
        return marked_.is_planar(side) ? halve(side) : split_at_shell(side);
    }
    stop(StopReason::unresolved, h);
}

void Splitter::split(HalfedgeId h, const SplitPoint& where, const Vec3& point) {
    if (options_.max_vertices != 0 && mesh_.vertex_count() >= options_.max_vertices)
        return stop(StopReason::max_vertices, h);
    const HalfedgeId t = mesh_.twin(h);
    ++(!t.valid()             ? report_.splits_boundary
       : marked_.is_planar(h) ? report_.splits_unflippable
                              : report_.splits_feature);
    const HalfedgeId first(mesh_.halfedge_count());
    marked_.split(h, where, point);
    ++report_.splits;
    for (const HalfedgeId side : {h, Mesh::next(h), Mesh::prev(h), first, Mesh::next(first)}) touched_.push_back(side);
    if (!t.valid()) return;
    const HalfedgeId second(first.value() + 3);
    for (const HalfedgeId side : {Mesh::next(t), Mesh::prev(t), Mesh::prev(second)}) touched_.push_back(side);
}

}  // namespace delmesh
