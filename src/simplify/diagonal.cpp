#include "simplify/diagonal.hpp"

#include "delmesh/mesh/edits.hpp"
#include "exact/inline.hpp"

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

bool can_flip_delaunay(const Mesh& mesh, double scale, HalfedgeId h) {
    const HalfedgeId t = mesh.twin(h);
    if (!t.valid()) return false;
    const Quad quad{h, t, mesh.origin(h), mesh.target(h), mesh.apex(h), mesh.apex(t)};
    // Around vertices with many faces, whether the others are joined takes longest.
    return !turns_over(mesh, scale, quad) && keeps_delaunay(mesh, quad) && can_flip(mesh, h);
}

bool turns_over(const Mesh& mesh, double scale, HalfedgeId h) {
    const HalfedgeId t = mesh.twin(h);
    return turns_over(mesh, scale, Quad{h, t, mesh.origin(h), mesh.target(h), mesh.apex(h), mesh.apex(t)});
}

void gather_flipped(const Mesh& mesh, HalfedgeId h, double scale, Star& star) {
    const HalfedgeId t = mesh.twin(h);
    star.u = star.v = mesh.apex(h);
    star.frame = {scale, 1 / scale, mesh.point(star.u)};
    star.closed = false;
    star.dying_count = 0;
    star.ring.clear();
    const std::array<VertexId, 3> ring{mesh.origin(h), mesh.apex(t), mesh.target(h)};
    const std::array<FaceId, 3> faces{Mesh::face(t), Mesh::face(h), FaceId()};
    for (std::size_t i = 0; i < ring.size(); ++i) {
        Star::Corner& corner = star.ring.emplace_back();
        corner.vertex = ring[i];
        corner.face = faces[i];
        corner.point = star.frame.to_local(mesh.point(ring[i]));
    }
}

}  // namespace delmesh
