#include "simplify/least_vertices.hpp"

#include "delmesh/mesh/shapes.hpp"
#include "support/families.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

std::size_t least(std::string_view name) {
    return least_vertices(Mesh(make_sample(name, 400)));
}

TEST(LeastVertices, KnownSurfaces) {
    EXPECT_EQ(least("icosphere"), 4u);  // the tetrahedron
    EXPECT_EQ(least("torus"), 7u);      // Moebius's, which Csaszar made of flat faces
    EXPECT_EQ(least("grid"), 3u);
}

/// An annulus needs a triangle within a triangle.
TEST(LeastVertices, EachBoundaryLoopNeedsThree) {
    PolygonSoup soup;
    for (int i = 0; i < 4; ++i) soup.points.push_back({static_cast<double>(i % 2), static_cast<double>(i / 2), 0});
    for (int i = 0; i < 4; ++i) soup.points.push_back(soup.points[static_cast<std::size_t>(i)] * 3 - Vec3{1, 1, 0});
    const std::uint32_t around[] = {0, 1, 3, 2, 0};
    for (int i = 0; i < 4; ++i) {
        const std::uint32_t a = around[i], b = around[i + 1];
        soup.corners.insert(soup.corners.end(), {a, b + 4, b, a, a + 4, b + 4});
    }
    EXPECT_EQ(least_vertices(Mesh(soup)), 6u);
}

TEST(LeastVertices, ComponentsAddUp) {
    PolygonSoup soup = make_sample("icosphere", 100);
    const PolygonSoup torus = make_sample("torus", 100);
    const auto offset = static_cast<std::uint32_t>(soup.points.size());
    soup.points.insert(soup.points.end(), torus.points.begin(), torus.points.end());
    for (const std::uint32_t corner : torus.corners) soup.corners.push_back(corner + offset);
    EXPECT_EQ(least_vertices(Mesh(soup)), 11u);
}

/// Fewer do not occur, but for two triangles back to back, which decimation never makes.
TEST(LeastVertices, NoMeshHasFewer) {
    for (const test::NamedSoup& named : test::families(200)) {
        const std::size_t vertices = test::examine(named.soup).used_vertices;
        if (named.has_zero_area || vertices == 3) continue;
        EXPECT_LE(least_vertices(Mesh(named.soup)), vertices) << named.name;
    }
}

}  // namespace
}  // namespace delmesh
