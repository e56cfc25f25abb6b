#include "simplify/sample_fit.hpp"

#include "simplify/triangle_point.hpp"

#include <vector>

namespace delmesh {

bool fit_to_samples(const Star& star, const SurfaceSamples& samples, const Vec3& centre, double regular,
                    EdgeCost& cost) {
    cost = {};
    struct Plane {
        Vec3 normal;
        double length2 = 0;
    };
    thread_local std::vector<Plane> planes;
    planes.resize(star.face_count());
    for (std::size_t i = 0; i < planes.size(); ++i) {
        planes[i].normal = cross(star.ring[i].point - centre, star.ring[star.after(i)].point - centre);
        planes[i].length2 = squared_norm(planes[i].normal);
    }
    for (const SurfaceSamples::Member& m : samples.members()) {
        const Vec3& b = star.ring[m.face].point;
        const Vec3& c = star.ring[star.after(m.face)].point;
        const auto& [normal, n2] = planes[m.face];
        if (!(n2 > 0)) continue;
        const TrianglePoint p = nearest_on_triangle(m.point, centre, b, c);
        const Vec3 beside = b * p.weights[1] + c * p.weights[2];
        const double own = p.weights[0];
        if (!(own > 0)) continue;
        // The plane own * n.(x) = n.(point - beside) for a unit n.
        cost.steered.add_plane(normal, dot(normal, m.point - beside) / own, samples.weight(m) * own * own / n2);
    }
    cost.trace = cost.steered.trace();
    if (!(cost.trace > 0)) return false;
    cost.steered.add_point(centre, regular * cost.trace);
    return true;
}

}  // namespace delmesh
