#include "simplify/loosen.hpp"

#include "delmesh/mesh/edits.hpp"
#include "exact/inline.hpp"

#include <algorithm>
#include <array>

namespace delmesh {
namespace {

/// The least cosine between the normal of a new face and the mean normal of the two before.
constexpr double least_turn_cosine = 0.1;

/// The two faces (p,q,u), (q,p,v) at an edge that become (p,v,u), (q,u,v).
struct Quad {
    HalfedgeId h, t;
    VertexId p, q, u, v;
};

bool turns_over(const Mesh& mesh, double scale, const Quad& quad) {
    const Frame frame{scale, 1 / scale, mesh.point(quad.p)};
    const Vec3 q = frame.to_local(mesh.point(quad.q));
    const Vec3 u = frame.to_local(mesh.point(quad.u));
    const Vec3 v = frame.to_local(mesh.point(quad.v));
    const Vec3 before = cross(q, u) + cross(v, q);
    for (const Vec3& after : {cross(v, u), cross(u - q, v - q)}) {
        const double turn = dot(after, before);
        if (!(turn > 0 &&
              turn * turn > least_turn_cosine * least_turn_cosine * squared_norm(after) * squared_norm(before)))
            return true;
    }
    return false;
}

bool keeps_delaunay(const Mesh& mesh, const Quad& quad) {
    const Vec3& p = mesh.point(quad.p);
    const Vec3& q = mesh.point(quad.q);
    const Vec3& u = mesh.point(quad.u);
    const Vec3& v = mesh.point(quad.v);
    if (exact::are_collinear_inline(p, u, v) || exact::are_collinear_inline(q, u, v)) return false;
    if (exact::delaunay_sign_inline(u, v, p, q) == Sign::negative) return false;
    const auto fits = [&](HalfedgeId side, const Vec3& apex) {
        const Vec3& a = mesh.point(mesh.origin(side));
        const Vec3& b = mesh.point(mesh.target(side));
        const HalfedgeId beyond = mesh.twin(side);
        const Sign sign = beyond.valid() ? exact::delaunay_sign_inline(a, b, apex, mesh.point(mesh.apex(beyond)))
                                         : exact::right_angle_sign_inline(a, b, apex);
        return sign != Sign::negative;
    };
    return fits(Mesh::next(quad.h), v) && fits(Mesh::prev(quad.h), v) && fits(Mesh::next(quad.t), u) &&
           fits(Mesh::prev(quad.t), u);
}

}  // namespace

/// Splitmix64.
double Loosener::draw() {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    x ^= x >> 31;
    return static_cast<double>(x >> 11) * 0x1p-53;
}

/// The star of the apex of h in the two faces as they will be.
void Loosener::gather_flipped(HalfedgeId h) {
    const HalfedgeId t = mesh_.twin(h);
    star_.u = star_.v = mesh_.apex(h);
    star_.frame = {scale_, 1 / scale_, mesh_.point(star_.u)};
    star_.closed = false;
    star_.dying_count = 0;
    star_.ring.clear();
    const std::array<VertexId, 3> ring{mesh_.origin(h), mesh_.apex(t), mesh_.target(h)};
    const std::array<FaceId, 3> faces{Mesh::face(t), Mesh::face(h), FaceId()};
    for (std::size_t i = 0; i < ring.size(); ++i) {
        Star::Corner& corner = star_.ring.emplace_back();
        corner.vertex = ring[i];
        corner.face = faces[i];
        corner.point = star_.frame.to_local(mesh_.point(ring[i]));
    }
}

bool Loosener::flip_edge(HalfedgeId h, double allowed2) {
    const HalfedgeId t = mesh_.twin(h);
    const Quad quad{h, t, mesh_.origin(h), mesh_.target(h), mesh_.apex(h), mesh_.apex(t)};
    if (!can_flip(mesh_, h) || turns_over(mesh_, scale_, quad) || !keeps_delaunay(mesh_, quad)) return false;
    if (samples_ != nullptr) {
        gather_flipped(h);
        samples_->gather(star_);
        const double before = samples_->present().forward;
        if (samples_->measure(star_, {}).forward > std::max(before, allowed2)) return false;
    }
    flip(mesh_, h);
    if (samples_ != nullptr) samples_->commit(star_);
    return true;
}

/// Towards a neighbour and another one, mostly not far.
Vec3 Loosener::draw_place() {
    const auto neighbour = [this] {
        return star_.ring[static_cast<std::size_t>(draw() * static_cast<double>(star_.ring.size()))].point;
    };
    const double part = draw();
    const double far = 0.5 * part * part * part;
    const Vec3 first = neighbour();
    const Vec3 second = neighbour();
    return first * far + second * (far * draw());
}

bool Loosener::move_vertex(VertexId v, double allowed2) {
    gather(mesh_, v, scale_, star_);
    const Vec3 w = draw_place();
    std::size_t first = 0;
    if (find_blocker(mesh_, star_, w, first) != Blocker::none) return false;
    const Vec3 to = settle_(star_.frame.to_mesh(w));
    if (to == mesh_.point(v) || !delmesh::keeps_delaunay(mesh_, star_, to)) return false;
    if (samples_ != nullptr) {
        samples_->gather(star_);
        const double before = std::max(samples_->present().forward, samples_->measure_backward(star_, {}));
        if (samples_->measure(star_, star_.frame.to_local(to)).worst() > std::max(before, allowed2)) return false;
    }
    moved_(v, to);
    mesh_.set_point(v, to);
    if (samples_ != nullptr) samples_->commit(star_);
    return true;
}

std::size_t Loosener::run(const Pass& pass) {
    state_ = pass.seed;
    std::size_t changes = 0;
    for (std::size_t i = 0; i < mesh_.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (!mesh_.origin(h).valid() || !mesh_.names_edge(h) || mesh_.is_boundary(h) || draw() < 0.5) continue;
        changes += flip_edge(h, pass.allowed2) ? 1 : 0;
    }
    for (std::size_t i = 0; i < mesh_.vertex_count(); ++i) {
        const VertexId v(i);
        if (mesh_.halfedge(v).valid() && (pass.boundary || !mesh_.is_boundary(v)))
            changes += move_vertex(v, pass.allowed2) ? 1 : 0;
    }
    return changes;
}

}  // namespace delmesh
