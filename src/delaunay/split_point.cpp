#include "delaunay/split_point.hpp"

#include "delmesh/mesh/rounding.hpp"

#include <algorithm>
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

namespace {

/// The parameter of v on the edge ab, or NaN if v does not lie on it.
double parameter_on(const MarkedMesh& marked, VertexId v, VertexId a, VertexId b) {
    if (v == a) return 0;
    if (v == b) return 1;
    if (!marked.is_input(v) && marked.split_point(v).a == a && marked.split_point(v).b == b)
        return marked.split_point(v).t;
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

EdgePart part_of_input_edge(const MarkedMesh& marked, HalfedgeId h) {
    const VertexId p = marked.mesh().origin(h);
    const VertexId q = marked.mesh().target(h);
    for (const VertexId v : {p, q}) {
        if (marked.is_input(v)) continue;
        const SplitPoint& on = marked.split_point(v);
        const EdgePart part{on.a, on.b, parameter_on(marked, p, on.a, on.b), parameter_on(marked, q, on.a, on.b)};
        if (!std::isnan(part.from) && !std::isnan(part.to)) return part;
    }
    return p < q ? EdgePart{p, q, 0, 1} : EdgePart{q, p, 1, 0};
}

double shell_parameter(const EdgePart& part, double length, double unit) {
    const double low = std::min(part.from, part.to);
    const double high = std::max(part.from, part.to);
    const bool from_low = low == 0 || high != 1;
    const double half = 0.5 * (high - low) * length / unit;
    if (!(half > 0) || std::isinf(half)) return std::numeric_limits<double>::quiet_NaN();
    // half = m * 2^k with m in [1/2, 1): the shells around it have the radii 2^(k-1) and 2^k, and their mean is 3/4 *
    // 2^k.
    int k = 0;
    const double m = std::frexp(half, &k);
    const double step = std::ldexp(unit, m > 0.75 ? k : k - 1) / length;
    return from_low ? low + step : high - step;
}

}  // namespace delmesh
