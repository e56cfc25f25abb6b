#include "delaunay/features.hpp"

#include "base/parallel.hpp"
#include "delmesh/exact/predicates.hpp"

namespace delmesh {
namespace {

/// Taylor series on [0, pi/4], where 12 terms reach the last bit.
double series(double first, double x2, int degree) {
    double term = first;
    double sum = first;
    for (int n = degree; n < degree + 24; n += 2) {
        term = -term * x2 / ((n + 1) * (n + 2));
        sum += term;
    }
    return sum;
}

constexpr double radians_per_degree = 3.14159265358979323846 / 180;

}  // namespace

double cosine_of_degrees(double degrees) {
    if (degrees > 90) return -cosine_of_degrees(180 - degrees);
    if (degrees == 60) return 0.5;
    if (degrees == 90) return 0;
    const bool small = degrees <= 45;
    const double x = (small ? degrees : 90 - degrees) * radians_per_degree;
    return small ? series(1, x * x, 0) : series(x, x * x, 1);
}

std::vector<Mark> mark_features(const Mesh& mesh, double angle_deg, std::span<const std::array<VertexId, 2>> listed,
                                const Context* context) {
    const double cosine = cosine_of_degrees(angle_deg);
    std::vector<Mark> marks(mesh.halfedge_count(), Mark::planar);
    parallel_blocks(mesh.halfedge_count(), context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const HalfedgeId h(i);
            const HalfedgeId t = mesh.twin(h);
            if (!t.valid()) {
                marks[i] = Mark::physical;
            } else if (h < t &&
                       dihedral_sign(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.apex(h)),
                                     mesh.point(mesh.apex(t)), cosine) == Sign::negative) {
                marks[i] = marks[t.index()] = Mark::physical;
            }
        }
    });
    for (const auto& [a, b] : listed) {
        HalfedgeId h = mesh.find_halfedge(a, b);
        if (!h.valid()) h = mesh.find_halfedge(b, a);
        if (!h.valid()) continue;
        marks[h.index()] = Mark::physical;
        if (mesh.twin(h).valid()) marks[mesh.twin(h).index()] = Mark::physical;
    }
    return marks;
}

}  // namespace delmesh
