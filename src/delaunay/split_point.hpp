#pragma once
// Where to split an edge: the concentric shells of the paper, section 3.1, and points at a parameter of an input edge.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/mesh/polygon_soup.hpp"

namespace delmesh {

/// (1 - t) * a + t * b, within two ulps of the larger coordinate; never overflows. Rounded to `precision`.
[[nodiscard]] Vec3 point_between(const Vec3& a, const Vec3& b, double t, Precision precision);

/// A part pq of an input edge ab, as parameters on ab: a < b, p at `from`, q at `to`.
struct EdgePart {
    VertexId a;
    VertexId b;
    double from = 0;
    double to = 1;
};

/// The input edge that the physical edge of h is a part of; `from` belongs to origin(h).
[[nodiscard]] EdgePart part_of_input_edge(const MarkedMesh& marked, HalfedgeId h);

/// The parameter on ab of the split vertex SV(e): the point of e nearest to its middle whose distance from an end is
/// 2^k * unit. The end is an input vertex if there is one (the smaller of two); of two equally near points the one with
/// the shorter distance is taken. Returns NaN where doubles can not express it.
[[nodiscard]] double shell_parameter(const MarkedMesh& marked, HalfedgeId h, const EdgePart& part, double unit);

}  // namespace delmesh
