#include "delaunay/splitter.hpp"

#include "delaunay/split_point.hpp"

#include <algorithm>

namespace delmesh {
namespace {

/// In the box of p and q but neither of them: rounding has not moved the point past an end.
bool lies_between(const Vec3& s, const Vec3& p, const Vec3& q) {
    if (s == p || s == q) return false;
    for (const int axis : {0, 1, 2})
        if (s[axis] < std::min(p[axis], q[axis]) || s[axis] > std::max(p[axis], q[axis])) return false;
    return true;
}

}  // namespace

void Splitter::stop(StopReason reason, HalfedgeId at) {
    stopped_ = true;
    report_.stop = reason;
    if (at.valid()) report_.witness = mesh_.edge(at);
}

void Splitter::split_at_shell(HalfedgeId h) {
    if (!can_split(mesh_, h)) return part_doubled_faces(h);
    const EdgePart part = part_of_input_edge(marked_, h);
    const Vec3& a = mesh_.point(part.a);
    const Vec3& b = mesh_.point(part.b);
    const double t = shell_parameter(part, norm(b - a), options_.shell_unit_abs);
    if (!(std::min(part.from, part.to) < t && t < std::max(part.from, part.to))) return stop(StopReason::unresolved, h);
    split(h, {part.a, part.b, t}, point_between(a, b, t, options_.precision));
}

void Splitter::halve(HalfedgeId h) {
    if (!can_split(mesh_, h)) return part_doubled_faces(h);
    const VertexId a = std::min(mesh_.origin(h), mesh_.target(h));
    const VertexId b = std::max(mesh_.origin(h), mesh_.target(h));
    split(h, {a, b, 0.5}, point_between(mesh_.point(a), mesh_.point(b), 0.5, options_.precision));
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
    if (!lies_between(point, mesh_.point(mesh_.origin(h)), mesh_.point(mesh_.target(h))))
        return stop(StopReason::unresolved, h);
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
