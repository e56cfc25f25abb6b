#include "delaunay/flat_rule.hpp"

#include "delaunay/non_delaunay.hpp"
#include "delmesh/mesh/stored_precision.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

/// Is one of the two faces at an edge no higher than this?
bool has_low_face(const Mesh& mesh, const UnitFrame& frame, HalfedgeId h, double height) {
    const Vec3 p = frame(mesh.point(mesh.origin(h)));
    const Vec3 q = frame(mesh.point(mesh.target(h))) - p;
    const auto is_low = [&](const Vec3& apex) {
        const double side = std::max({squared_norm(q), squared_norm(apex), squared_norm(apex - q)});
        return squared_norm(cross(q, apex)) <= height * height * side;
    };
    return is_low(frame(mesh.point(mesh.apex(h))) - p) || is_low(frame(mesh.point(mesh.apex(mesh.twin(h)))) - p);
}

}  // namespace

double stored_tolerance(const Mesh& mesh, const UnitFrame& frame) {
    return 16 * std::scalbn(stored_rounding(mesh.points()), frame.exponent);
}

bool is_nearly_planar(const Mesh& mesh, const UnitFrame& frame, double width, HalfedgeId h) {
    const Vec3 p = frame(mesh.point(mesh.origin(h)));
    const Vec3 q = frame(mesh.point(mesh.target(h))) - p;
    const Vec3 u = frame(mesh.point(mesh.apex(h))) - p;
    const Vec3 v = frame(mesh.point(mesh.apex(mesh.twin(h)))) - p;
    // The four points span a tetrahedron of at most a third of the width times the area that the two faces cover.
    const Vec3 normal = cross(q, u);
    return std::fabs(dot(normal, v)) <= (width + 0x1p-45) * 1.001 * (norm(normal) + norm(cross(v, q)));
}

bool is_mostly_rounding(const Mesh& mesh, const UnitFrame& frame, double tolerance, const Context* context) {
    std::size_t flat = 0;
    std::size_t sharp = 0;
    for (const HalfedgeId h : find_non_delaunay(mesh, context)) {
        const HalfedgeId t = mesh.twin(h);
        const bool near = t.valid() && is_nearly_planar(mesh, frame, tolerance / 2, h);
        if (near && exact::is_planar_edge_inline(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)),
                                                 mesh.point(mesh.apex(h)), mesh.point(mesh.apex(t))))
            continue;
        ++(near || (t.valid() && has_low_face(mesh, frame, h, tolerance / 2)) ? flat : sharp);
    }
    return flat > 0 && flat >= sharp;
}

}  // namespace delmesh
