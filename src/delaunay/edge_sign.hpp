#pragma once

#include "delmesh/exact/predicates.hpp"
#include "delmesh/mesh/mesh.hpp"

namespace delmesh {

/// True if the edge of h is not Delaunay: opposite angles above pi, or above pi/2 at the boundary. Exact.
[[nodiscard]] inline bool is_non_delaunay(const Mesh& mesh, HalfedgeId h) {
    const HalfedgeId t = mesh.twin(h);
    const Vec3& p = mesh.point(mesh.origin(h));
    const Vec3& q = mesh.point(mesh.target(h));
    const Vec3& u = mesh.point(mesh.apex(h));
    const Sign sign = t.valid() ? delaunay_sign(p, q, u, mesh.point(mesh.apex(t))) : right_angle_sign(p, q, u);
    return sign == Sign::negative;
}

}  // namespace delmesh
