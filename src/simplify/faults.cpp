#include "simplify/faults.hpp"

#include "delaunay/non_delaunay.hpp"
#include "simplify/walk.hpp"

#include <cmath>
#include <vector>

namespace delmesh {
std::size_t count_faults(const Mesh& mesh) {
    std::size_t faults = 0;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        faults += mesh.origin(h).valid() && mesh.names_edge(h) && is_non_delaunay(mesh, h) ? 1 : 0;
    }
    return faults;
}

std::size_t count_faults(const Mesh& mesh, const Star& star) {
    std::size_t faults = 0;
    const auto at = [&](VertexId v, VertexId other) {
        each_edge(mesh, v, [&](HalfedgeId e) {
            const bool is_merged = mesh.origin(e) == other || mesh.target(e) == other;
            faults += !is_merged && is_non_delaunay(mesh, e) ? 1 : 0;
        });
    };
    at(star.u, VertexId());
    if (star.v != star.u) at(star.v, star.u);
    for (std::size_t i = 0; i < star.face_count(); ++i) faults += is_non_delaunay(mesh, star.ring[i].across) ? 1 : 0;
    return faults;
}

std::size_t count_faults(const Mesh& mesh, Star& star, const Vec3& w) {
    find_outers(mesh, star);
    struct Cots {
        double at_p = 0, at_q = 0;
    };
    thread_local std::vector<Cots> cots;
    const std::size_t faces = star.face_count();
    cots.assign(star.ring.size(), {});
    std::size_t faults = 0;
    const auto add = [&](double cot) { faults += cot >= 0 ? 0 : 1; };
    for (std::size_t i = 0; i < faces; ++i) {
        const Vec3 a = star.ring[i].point - w;
        const Vec3 b = star.ring[star.after(i)].point - w;
        const double inverse = 1 / std::sqrt(squared_norm(cross(a, b)));
        cots[i] = {-dot(a, b - a) * inverse, dot(b, b - a) * inverse};
        add(dot(a, b) * inverse + star.ring[i].outer_cot);
    }
    // Face i holds the angle at ring[i], opposite to the spoke to ring[i+1], and the other way round.
    for (std::size_t i = 0; i < star.ring.size(); ++i)
        add((star.closed || i > 0 ? cots[star.before(i)].at_p : 0) + (star.closed || i < faces ? cots[i].at_q : 0));
    return faults;
}

}  // namespace delmesh
