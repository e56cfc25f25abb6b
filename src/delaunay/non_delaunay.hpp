#pragma once

#include "delmesh/base/context.hpp"
#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "exact/inline.hpp"

#include <vector>

namespace delmesh {

/// True if the edge of h is not Delaunay: opposite angles above pi, or above pi/2 at the boundary. Exact.
[[nodiscard]] inline bool is_non_delaunay(const Mesh& mesh, HalfedgeId h) {
    const HalfedgeId t = mesh.twin(h);
    const Vec3& p = mesh.point(mesh.origin(h));
    const Vec3& q = mesh.point(mesh.target(h));
    const Vec3& u = mesh.point(mesh.apex(h));
    const Sign sign = t.valid() ? exact::delaunay_sign_inline(p, q, u, mesh.point(mesh.apex(t)))
                                : exact::right_angle_sign_inline(p, q, u);
    return sign == Sign::negative;
}

/// All edges that are not Delaunay, in the order of their ids. Parallel.
[[nodiscard]] std::vector<HalfedgeId> find_non_delaunay(const Mesh& mesh, const Context* context);

}  // namespace delmesh
