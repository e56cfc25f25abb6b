// Levels by planes, and by spheres about corners where planes can not work.

#include "delaunay/slice_levels.hpp"

#include "delaunay/prepared_model.hpp"
#include "delmesh/mesh/polygon_soup.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace delmesh {
namespace {

constexpr std::uint32_t sides = 4;

/// A pyramid, thin as a needle: from its tip four edges of different lengths go along x, and `lean` along y.
void add_pyramid(PolygonSoup& soup, double z, double lean) {
    const auto tip = static_cast<std::uint32_t>(soup.points.size());
    const std::array<double, sides> y{1e-2, 0, -1e-2, 0};
    soup.points.push_back({0, 0, z});
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double x = 1000 + 200 * (i % 2);
        soup.points.push_back({x, x * (lean + y[i]), z + x * y[(i + 3) % sides]});
    }
    for (std::uint32_t i = 0; i < sides; ++i)
        for (const std::uint32_t v : {0u, 1 + i, 1 + (i + 1) % sides}) soup.corners.push_back(tip + v);
    for (const std::uint32_t v : {1u, 3u, 2u, 1u, 4u, 3u}) soup.corners.push_back(tip + v);
}

/// Where the edges at the tip of such a pyramid are cut at the level 10, by planes at right angles to x if by planes.
std::vector<Vec3> cuts(double lean) {
    PolygonSoup soup;
    add_pyramid(soup, 0, lean);
    add_pyramid(soup, 5000, 0);
    test::PreparedModel pyramids{Mesh(std::move(soup))};
    const auto edge = [&](std::uint32_t from, std::uint32_t to) {
        return pyramids.model.edge_of(pyramids.mesh.find_halfedge(VertexId(from), VertexId(to)));
    };
    SliceLevels levels(pyramids.model, 0, false);
    std::vector<std::uint32_t> straight;
    for (std::uint32_t i = 1; i <= sides; ++i) straight.push_back(edge(sides + 1, sides + 1 + i));
    levels.find_axis(straight);
    // In the unit of the levels, which is a power of two.
    std::vector<Vec3> points;
    for (std::uint32_t i = 1; i <= sides; ++i) {
        double t = levels.place_of(edge(0, i), 10.0 / 2048);
        if (t < 0) t = levels.place_of(edge(0, i), -10.0 / 2048);  // the axis may point either way
        points.push_back(t * pyramids.mesh.point(VertexId(i)));
    }
    return points;
}

TEST(SliceLevels, ArePlanesWherePlanesWork) {
    const std::vector<Vec3> points = cuts(2e-3);
    for (const Vec3& p : points) EXPECT_NEAR(p.x, 10, 1e-9);
    EXPECT_GT(norm(points[0]), norm(points[2]) + 1e-4);
}

/// All edges lean to one side by ten times the angles between them: where one is at right angles to the plane, the
/// plane is too far from that for its neighbours.
TEST(SliceLevels, AreSpheresWherePlanesFail) {
    const std::vector<Vec3> points = cuts(0.1);
    for (const Vec3& p : points) EXPECT_NEAR(norm(p), norm(points[0]), 1e-9);
    EXPECT_NEAR(norm(points[0]), 10, 0.1);
    EXPECT_LT(points[0].x, points[2].x - 1e-2);
}

}  // namespace
}  // namespace delmesh
