#pragma once
// What must hold for every repair, and small broken soups.

#include "delmesh/mesh/polygon_soup.hpp"
#include "delmesh/repair/repair.hpp"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace delmesh::test {

using Triangle = std::array<std::uint32_t, 3>;

PolygonSoup triangles(std::vector<Vec3> points, std::initializer_list<Triangle> faces);

/// Adds a soup of triangles with vertices of its own.
void append(PolygonSoup& soup, const PolygonSoup& other);
/// Closed, outward.
PolygonSoup make_cube(Vec3 low, double side = 1);
void turn_face(PolygonSoup& soup, std::size_t f);
void turn_all_faces(PolygonSoup& soup);
/// Gives every corner a vertex of its own, as STL files do.
PolygonSoup take_apart(const PolygonSoup& soup);
/// Makes one vertex of those at the same place, without regard to what comes of it.
PolygonSoup merge_places(const PolygonSoup& soup);
/// n by m quads over a rectangle whose short sides are glued: turned round (Moebius) or not.
PolygonSoup make_band(std::uint32_t n, std::uint32_t m, bool moebius);
/// The usual immersion in space, n by m.
PolygonSoup make_klein_bottle(std::uint32_t n, std::uint32_t m);

struct Repaired {
    PolygonSoup soup;
    RepairReport report;
};

/// Repairs and checks all that is promised whatever the input: a `Mesh` can be built, no vertex is isolated, no face
/// has zero area, every output face lies in the input face that it names, every input face with area is covered, and a
/// second repair changes nothing. Reports failures as those of the running test.
Repaired repair_and_check(const PolygonSoup& input, const RepairOptions& options = {});

/// The number of edges with one face, and of pieces that are connected by edges.
std::size_t count_boundary_edges(const PolygonSoup& soup);
std::size_t count_components(const PolygonSoup& soup);

bool same_bits(const PolygonSoup& a, const PolygonSoup& b);

}  // namespace delmesh::test
