#include "delaunay/sheets.hpp"

#include "delaunay/split_point.hpp"
#include "delaunay/unit_frame.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

constexpr int places = 64;
/// Near an end the room is what counts.
constexpr double least_share = 0.25;

struct Angle {
    double cosine = 1;
    double sine = 0;
};

/// Under which p sees a and b.
Angle angle_at(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 u = a - p;
    const Vec3 v = b - p;
    const double cosine = dot(u, v);
    const double sine = norm(cross(u, v));
    const double length = std::sqrt(cosine * cosine + sine * sine);
    return {cosine / length, sine / length};
}

/// Below zero from half a turn on.
double sine_of_sum(const Angle& a, const Angle& b) {
    return a.sine * b.cosine + a.cosine * b.sine;
}

/// How far a physical edge around h is from a tie, at least, if x sees all of them.
double least_room(const MarkedMesh& marked, const UnitFrame& frame, HalfedgeId h, const Vec3& x) {
    const Mesh& mesh = marked.mesh();
    double least = 1;
    for (const HalfedgeId across : {h, mesh.twin(h)}) {
        for (const HalfedgeId side : {Mesh::next(across), Mesh::prev(across)}) {
            if (marked.is_planar(side)) continue;
            const Vec3 p = frame(mesh.point(mesh.origin(side)));
            const Vec3 q = frame(mesh.point(mesh.target(side)));
            const Angle here = angle_at(x, p, q);
            const HalfedgeId beyond = mesh.twin(side);
            const double room =
                beyond.valid() ? sine_of_sum(here, angle_at(frame(mesh.point(mesh.apex(beyond))), p, q)) : here.cosine;
            least = std::min(least, room);
        }
    }
    return least;
}

/// Of the size of the two faces.
UnitFrame frame_around(const Mesh& mesh, HalfedgeId h) {
    double largest = 0;
    for (const VertexId v : {mesh.origin(h), mesh.target(h), mesh.apex(h), mesh.apex(mesh.twin(h))})
        for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::fabs(mesh.point(v)[axis]));
    UnitFrame frame;
    if (largest > 0) frame.exponent = -std::ilogb(largest) - 1;
    return frame;
}

}  // namespace

HalfedgeId edge_in_the_way(const MarkedMesh& marked, HalfedgeId h) {
    const Mesh& mesh = marked.mesh();
    if (!marked.is_planar(h) || !mesh.twin(h).valid()) return {};
    const VertexId u = mesh.apex(h);
    const VertexId v = mesh.apex(mesh.twin(h));
    const HalfedgeId there = mesh.find_halfedge(u, v);
    return there.valid() ? there : mesh.find_halfedge(v, u);
}

SplitPoint place_of_parting(const MarkedMesh& marked, HalfedgeId h) {
    const Mesh& mesh = marked.mesh();
    if (!marked.is_planar(h)) {
        const EdgePart part = part_of_input_edge(marked, h);
        return {part.a, part.b, 0.5 * (part.from + part.to)};
    }
    const UnitFrame frame = frame_around(mesh, h);
    SplitPoint best{std::min(mesh.origin(h), mesh.target(h)), std::max(mesh.origin(h), mesh.target(h)), 0.5};
    const Vec3 a = frame(mesh.point(best.a));
    const Vec3 along = frame(mesh.point(best.b)) - a;
    double most = -1;
    for (int i = 1; i < places; ++i) {
        const double t = static_cast<double>(i) / places;
        const double room = std::min(least_room(marked, frame, h, a + t * along), std::min(t, 1 - t) / least_share);
        if (!(room > most)) continue;
        most = room;
        best.t = t;
    }
    return best;
}

}  // namespace delmesh
