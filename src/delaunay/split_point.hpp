#pragma once
// Where to split an edge: the concentric shells of the paper, section 3.1, and points at a parameter of an input edge.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/mesh/polygon_soup.hpp"

namespace delmesh {

/// (1 - t) * a + t * b, within two ulps of the larger coordinate; never overflows. Rounded to `precision`.
[[nodiscard]] Vec3 point_between(const Vec3& a, const Vec3& b, double t, Precision precision);

/// A part pq of an edge ab, as parameters on ab: a < b, p at `from`, q at `to`.
struct EdgePart {
    VertexId a;
    VertexId b;
    double from = 0;
    double to = 1;
};

/// The edge that the edge of h is a part of: the one that its ends, or the split vertices among them, have in common;
/// else the edge of h itself. `from` belongs to origin(h).
[[nodiscard]] EdgePart part_of_input_edge(const MarkedMesh& marked, HalfedgeId h);

/// The parameter on ab, which is `length` long, of the split vertex SV: the point of the part nearest to its middle
/// whose distance from an end of the part is 2^k * unit. The end is a or b where the part reaches it (a, if it reaches
/// both), else the one nearer to a. Of two equally near points the one nearer to that end is taken. NaN where doubles
/// can not express it.
[[nodiscard]] double shell_parameter(const EdgePart& part, double length, double unit);

}  // namespace delmesh
