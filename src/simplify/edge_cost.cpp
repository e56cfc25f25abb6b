#include "simplify/edge_cost.hpp"

#include "delmesh/simplify/quadric_program.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {

EdgeCost edge_cost(const Mesh& mesh, const VertexWeights& weights, HalfedgeId h, double scale, const Tuning& tuning) {
    const VertexId u = mesh.origin(h);
    const VertexId v = mesh.target(h);
    const Vec3 to_v = (mesh.point(v) - mesh.point(u)) * scale;
    EdgeCost cost;
    cost.steered = weights.of_edge(u, v, to_v);
    cost.middle = to_v * 0.5;
    cost.trace = cost.steered.trace();
    cost.steered.add_point(cost.middle, tuning.regular * cost.trace);
    cost.steered.c += tuning.length_cost * cost.trace * squared_norm(to_v);
    return cost;
}

double lowest_cost(const EdgeCost& cost) {
    const auto factors = factorise(cost.steered);
    return std::max(0.0, cost.steered(factors ? factors->lowest : cost.middle));
}

void add_volume(const Star& star, const Tuning& tuning, EdgeCost& cost) {
    Vec3 normal;
    double offset = 0;
    double area = 0;
    const auto add = [&](const Vec3& n) {
        normal = normal + n;
        area += std::sqrt(squared_norm(n));
    };
    for (std::size_t i = 0; i < star.face_count(); ++i) {
        add(star.ring[i].old_normal);
        offset += dot(star.ring[i].old_normal, star.ring[i].point);
    }
    for (int i = 0; i < star.dying_count; ++i) add(star.dying[i]);  // through u, the origin
    if (area > 0) cost.steered.add_plane(normal, offset, tuning.volume * cost.trace / (area * area));
}

}  // namespace delmesh
