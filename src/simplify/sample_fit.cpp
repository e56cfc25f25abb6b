#include "simplify/sample_fit.hpp"

#include "simplify/triangle_point.hpp"

namespace delmesh {

bool fit_to_samples(const Star& star, const SurfaceSamples& samples, const Vec3& centre, double regular,
                    EdgeCost& cost) {
    cost = {};
    for (const SurfaceSamples::Member& m : samples.members()) {
        const Vec3& b = star.ring[m.face].point;
        const Vec3& c = star.ring[star.after(m.face)].point;
        const Vec3 normal = cross(b - centre, c - centre);
        const double n2 = squared_norm(normal);
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
