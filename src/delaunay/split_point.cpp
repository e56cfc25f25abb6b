#include "delaunay/split_point.hpp"

#include "delmesh/mesh/rounding.hpp"

#include <cmath>
#include <limits>

namespace delmesh {
namespace {

double between(double a, double b, double t) {
    // Halved differences can not overflow; halving is exact but for the last bit of denormals.
    const double half = 0.5 * b - 0.5 * a;
    return t <= 0.5 ? a + 2 * t * half : b - 2 * (1 - t) * half;
}

}  // namespace

Vec3 point_between(const Vec3& a, const Vec3& b, double t, Precision precision) {
    const Vec3 p{between(a.x, b.x, t), between(a.y, b.y, t), between(a.z, b.z, t)};
    return precision == Precision::float32 ? round_to_float(p) : p;
}

EdgePart part_of_input_edge(const MarkedMesh& marked, HalfedgeId h) {
    const VertexId p = marked.mesh().origin(h);
    const VertexId q = marked.mesh().target(h);
    if (marked.is_input(p) && marked.is_input(q)) return p < q ? EdgePart{p, q, 0, 1} : EdgePart{q, p, 1, 0};
    const SplitPoint& known = marked.split_point(marked.is_input(p) ? q : p);
    const auto parameter = [&](VertexId v) {
        if (!marked.is_input(v)) return marked.split_point(v).t;
        return v == known.a ? 0.0 : 1.0;
    };
    return {known.a, known.b, parameter(p), parameter(q)};
}

double shell_parameter(const MarkedMesh& marked, HalfedgeId h, const EdgePart& part, double unit) {
    const VertexId p = marked.mesh().origin(h);
    const VertexId q = marked.mesh().target(h);
    const bool from_origin = marked.is_input(p) && (!marked.is_input(q) || p < q);
    const double start = from_origin ? part.from : part.to;
    const double end = from_origin ? part.to : part.from;

    const double length = norm(marked.mesh().point(part.b) - marked.mesh().point(part.a));
    const double half = 0.5 * std::fabs(part.to - part.from) * length / unit;
    if (!(half > 0) || std::isinf(half)) return std::numeric_limits<double>::quiet_NaN();
    // half = m * 2^k with m in [1/2, 1): the shells around it have the radii 2^(k-1) and 2^k, and their mean is 3/4 *
    // 2^k.
    int k = 0;
    const double m = std::frexp(half, &k);
    const double radius = std::ldexp(unit, m > 0.75 ? k : k - 1);
    const double step = radius / length;
    return start < end ? start + step : start - step;
}

}  // namespace delmesh
