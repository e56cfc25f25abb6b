// A triangle and its own back, joined at all three edges, with an obtuse angle: a closed manifold, but no vertices on
// its edges make it Delaunay, for whichever way two triangles with points on their edges are cut, they share a
// diagonal.

#include "delmesh/exact/predicates.hpp"
#include "repair/complex.hpp"

namespace delmesh::repairing {
namespace {

bool is_obtuse(const Complex& complex, std::size_t f) {
    const auto point = [&](std::size_t i) { return complex.point(complex.corners[3 * f + i % 3]); };
    for (std::size_t i = 0; i < 3; ++i)
        if (right_angle_sign(point(i + 1), point(i + 2), point(i)) == Sign::negative) return true;
    return false;
}

/// The face that face `f` shares all its edges with, or none.
Index back_of(const Partners& partners, std::size_t f) {
    const Index other = partners[3 * f] == none ? none : partners[3 * f] / 3;
    for (std::size_t h = 3 * f; h < 3 * f + 3; ++h)
        if (partners[h] == none || partners[h] / 3 != other) return none;
    return other;
}

}  // namespace

bool open_pillows(Complex& complex, const Partners& partners, Log& log) {
    std::vector<char> gone(complex.face_count(), 0);
    bool found = false;
    for (std::size_t f = 0; f < gone.size(); ++f) {
        const Index back = back_of(partners, f);
        if (back == none || back < f || !is_obtuse(complex, f)) continue;
        gone[back] = 1;
        found = true;
        log.add(Defect::duplicate_face, complex.origin[back].index());
    }
    if (found) complex.drop_faces([&](std::size_t f) { return gone[f] != 0; });
    return found;
}

}  // namespace delmesh::repairing
