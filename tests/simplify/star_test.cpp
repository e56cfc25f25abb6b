#include "simplify/star.hpp"

#include "delmesh/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace delmesh {
namespace {

/// A vertex 0 with four faces around it; the edge 2-3 of one of them has a further face on its outer side, so that it
/// joins two boundary vertices through the inside.
Mesh fan_with_chord() {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 3, 0}};
    soup.corners = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 2, 5, 3};
    return Mesh(std::move(soup));
}

TEST(Star, OfAChordIsEmptyWhateverWasGatheredBefore) {
    const Mesh mesh = fan_with_chord();
    Star star;
    ASSERT_TRUE(gather(mesh, mesh.find_halfedge(VertexId(0), VertexId(1)), 1, star));
    EXPECT_EQ(star.ring.size(), 3u);
    EXPECT_FALSE(gather(mesh, mesh.find_halfedge(VertexId(2), VertexId(3)), 1, star));
    EXPECT_TRUE(star.ring.empty());
}

/// Two faces back to back: each angle counts twice.
TEST(Star, OfTwoFacesBackToBackKeepsDelaunayUpToARightAngle) {
    PolygonSoup soup;
    soup.points = {{-1, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    soup.corners = {0, 1, 2, 1, 0, 2};
    const Mesh mesh(std::move(soup));
    Star star;
    gather(mesh, VertexId(2), 1, star);
    EXPECT_TRUE(keeps_delaunay(mesh, star, {0, 3, 0}));
    EXPECT_TRUE(keeps_delaunay(mesh, star, {0, 1, 0}));
    EXPECT_FALSE(keeps_delaunay(mesh, star, {0, 0.75, 0}));
}

}  // namespace
}  // namespace delmesh
