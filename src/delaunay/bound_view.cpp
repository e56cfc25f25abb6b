#include "delaunay/bound_view.hpp"

#include <cmath>

namespace delmesh {
namespace {

constexpr std::size_t most_corners = 40;
/// Of the mesh: about shorter edges nothing is said.
constexpr double smallest_square = 0x1p-200;

}  // namespace

BoundView::BoundView(const MarkedMesh& marked, bool exact_facets, double precision)
    : marked_(marked),
      mesh_(marked.mesh()),
      exact_facets_(exact_facets),
      precision_(precision) {
    double largest = 0;
    for (const Vec3& p : mesh_.points())
        for (int axis = 0; axis < 3; ++axis) largest = std::fmax(largest, std::fabs(p[axis]));
    if (!(largest > 0)) return;
    // A power of two, in two factors since one may overflow, brings all coordinates below 1.
    const int exponent = -std::ilogb(largest) - 1;
    scale_ = std::ldexp(1.0, exponent / 2);
    second_scale_ = std::ldexp(1.0, exponent - exponent / 2);
}

bool BoundView::is_single(FaceId f) const {
    const HalfedgeId h = Mesh::halfedge(f);
    return !marked_.is_planar(h) && !marked_.is_planar(Mesh::next(h)) && !marked_.is_planar(Mesh::prev(h));
}

// --- visibility ---

bool BoundView::turns_left(VertexId a, VertexId b, VertexId c) const {
    const Sign turn = side_along(axis_, mesh_.point(a), mesh_.point(b), mesh_.point(c));
    return turn == side_ || turn == Sign::zero;
}

void BoundView::look(HalfedgeId h, ConvexView& view) {
    view.corners.clear();
    view.sides.clear();
    if (!is_certain(h)) return;
    ring_ = {mesh_.origin(h), mesh_.target(h), mesh_.apex(h)};
    ring_sides_ = {h, Mesh::next(h), Mesh::prev(h)};
    if (!is_single(Mesh::face(h))) {
        const Vec3 normal =
            cross(mesh_.point(ring_[1]) - mesh_.point(ring_[0]), mesh_.point(ring_[2]) - mesh_.point(ring_[0]));
        axis_ = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (std::fabs(normal[axis]) > std::fabs(normal[axis_])) axis_ = axis;
        side_ = side_along(axis_, mesh_.point(ring_[0]), mesh_.point(ring_[1]), mesh_.point(ring_[2]));
        if (side_ != Sign::zero) grow();
    }
    for (const HalfedgeId side : ring_sides_)
        if (side != h && !marked_.is_planar(side)) view.sides.push_back(side);
    for (const VertexId v : ring_)
        if (v != mesh_.origin(h) && v != mesh_.target(h)) view.corners.push_back(v);
}

/// Adds triangles across planar sides for as long as the polygon stays convex. Each new corner lies beyond the line of
/// a side, so it is none of the old ones.
void BoundView::grow() {
    for (std::size_t i = 0; i < ring_.size() && ring_.size() < most_corners;) {
        const HalfedgeId side = ring_sides_[i];
        const std::size_t n = ring_.size();
        if (marked_.is_planar(side)) {
            const HalfedgeId beyond = mesh_.twin(side);
            const VertexId corner = mesh_.apex(beyond);
            const std::size_t next = (i + 1) % n;
            if (turns_left(ring_[(i + n - 1) % n], ring_[i], corner) &&
                turns_left(corner, ring_[next], ring_[(next + 1) % n])) {
                ring_sides_[i] = Mesh::next(beyond);
                ring_sides_.insert(ring_sides_.begin() + static_cast<std::ptrdiff_t>(i) + 1, Mesh::prev(beyond));
                ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(i) + 1, corner);
                i = 0;  // what did not fit before may fit now
                continue;
            }
        }
        ++i;
    }
}

// --- places ---

std::array<Interval, 3> BoundView::difference(VertexId a, VertexId b) const {
    const Vec3 p = second_scale_ * (scale_ * mesh_.point(a));
    const Vec3 q = second_scale_ * (scale_ * mesh_.point(b));
    return {exactly(p.x) - exactly(q.x), exactly(p.y) - exactly(q.y), exactly(p.z) - exactly(q.z)};
}

bool BoundView::make_frame(VertexId u, VertexId v, Frame& frame) const {
    frame.u = u;
    frame.v = v;
    frame.along = difference(v, u);
    frame.length2 = square(frame.along[0]) + square(frame.along[1]) + square(frame.along[2]);
    if (!(frame.length2.low > smallest_square)) return false;
    frame.slack = round_up(precision_ / std::sqrt(frame.length2.low) * (1 + 0x1p-50));
    return true;
}

FramePoint BoundView::locate(const Frame& frame, VertexId p) const {
    if (p == frame.u) return {exactly(0), exactly(0)};
    if (p == frame.v) return {exactly(1), exactly(0)};
    const auto& d = frame.along;
    const std::array<Interval, 3> r = difference(p, frame.u);
    const Interval dot = r[0] * d[0] + r[1] * d[1] + r[2] * d[2];
    const Interval cross2 =
        square(r[1] * d[2] - r[2] * d[1]) + square(r[2] * d[0] - r[0] * d[2]) + square(r[0] * d[1] - r[1] * d[0]);
    return {dot / frame.length2, square_root(cross2) / frame.length2};
}

}  // namespace delmesh
