#include "delmesh/measure/statistics.hpp"

#include "measure/meshes.hpp"
#include "support/families.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

namespace delmesh {
namespace {

using namespace delmesh::testing;

AngleStatistics of_triangle(Vec3 a, Vec3 b, Vec3 c) {
    return measure_angles(mesh_of({a, b, c}, {0, 1, 2}));
}

/// The percentage that is `count` of three angles.
double third(int count) {
    return 100.0 * count / 3;
}

/// The statistics in long doubles with one arc tangent for each angle; `margin` degrees are added to the thresholds.
AngleStatistics by_definition(const Mesh& mesh, long double margin = 0) {
    long double low = 180, high = 0;
    std::size_t small = 0, large = 0;
    for (std::size_t h = 0; h < mesh.halfedge_count(); ++h) {
        const Vec3 u = mesh.point(mesh.origin(HalfedgeId(h))), p = mesh.point(mesh.target(HalfedgeId(h))),
                   q = mesh.point(mesh.apex(HalfedgeId(h)));
        std::array<long double, 3> a{}, b{};
        for (int i = 0; i < 3; ++i) {
            a[i] = static_cast<long double>(p[i]) - u[i];
            b[i] = static_cast<long double>(q[i]) - u[i];
        }
        const long double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
        const long double angle =
            std::atan2(std::sqrt(x * x + y * y + z * z), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 180 /
            std::numbers::pi_v<long double>;
        low = std::min(low, angle);
        high = std::max(high, angle);
        small += angle < 30 + margin;
        large += angle > 120 + margin;
    }
    const auto n = static_cast<double>(mesh.halfedge_count());
    return {static_cast<double>(low), static_cast<double>(high), 100 * static_cast<double>(small) / n,
            100 * static_cast<double>(large) / n};
}

TEST(Statistics, AnglesAgreeWithTheDefinitionOnNoisyTori) {
    for (const double noise : {0.001, 0.05, 0.3}) {
        const Mesh mesh(torus_soup(60, 31, noise));
        const AngleStatistics a = measure_angles(mesh), b = by_definition(mesh);
        EXPECT_NEAR(a.min_angle_deg, b.min_angle_deg, 1e-12);
        EXPECT_NEAR(a.max_angle_deg, b.max_angle_deg, 1e-12);
        EXPECT_DOUBLE_EQ(a.small_angles_percent, b.small_angles_percent);
        EXPECT_DOUBLE_EQ(a.large_angles_percent, b.large_angles_percent);
    }
}

TEST(Statistics, ThresholdsThemselvesAreNotCounted) {
    // On the lattice: 30 degrees between (1,1,0) and (2,1,1), 120 between (1,-1,0) and (0,1,-1).
    const AngleStatistics thirty = of_triangle({0, 0, 0}, {1, 1, 0}, {2, 1, 1});
    EXPECT_NEAR(thirty.min_angle_deg, 30, 1e-13);
    EXPECT_EQ(thirty.small_angles_percent, 0);
    // (30, 30, 120): one at the upper threshold, two at the lower.
    const AngleStatistics iso = of_triangle({0, 0, 0}, {1, -1, 0}, {0, 1, -1});
    EXPECT_NEAR(iso.max_angle_deg, 120, 1e-13);
    EXPECT_EQ(iso.small_angles_percent, 0);
    EXPECT_EQ(iso.large_angles_percent, 0);
}

TEST(Statistics, OneUlpBeyondAThresholdCounts) {
    const double eps = std::numeric_limits<double>::epsilon();
    // At 2^500 the squares leave the range of doubles.
    for (const int e : {0, -500, 500}) {
        const auto at = [e](double x, double y, double z) {
            return Vec3{std::scalbn(x, e), std::scalbn(y, e), std::scalbn(z, e)};
        };
        // Turning (1,-1,0) towards -(0,1,-1) opens the angle of 120 degrees.
        EXPECT_EQ(of_triangle({}, at(1, -1 - eps, 0), at(0, 1, -1)).large_angles_percent, third(1)) << e;
        EXPECT_EQ(of_triangle({}, at(1, -1 + eps, 0), at(0, 1, -1)).large_angles_percent, 0) << e;
        // Turning (2,1,1) towards (2,2,0) closes the angle of 30 degrees.
        EXPECT_EQ(of_triangle({}, at(2, 2, 0), at(2, 1, 1 - eps)).small_angles_percent, third(1)) << e;
        EXPECT_EQ(of_triangle({}, at(2, 2, 0), at(2, 1, 1 + eps)).small_angles_percent, 0) << e;
    }
}

TEST(Statistics, ZeroAreaFacesHaveTheAnglesOfTheirLimit) {
    const AngleStatistics cap = of_triangle({0, 0, 0}, {3, 3, 3}, {1, 1, 1});
    EXPECT_EQ(cap.min_angle_deg, 0);
    EXPECT_EQ(cap.max_angle_deg, 180);
    EXPECT_EQ(cap.small_angles_percent, third(2));
    EXPECT_EQ(cap.large_angles_percent, third(1));
    const AngleStatistics needle = of_triangle({1, 2, 3}, {1, 2, 3}, {5, 5, 5});
    EXPECT_EQ(needle.min_angle_deg, 0);
    EXPECT_EQ(needle.max_angle_deg, 90);
    EXPECT_EQ(needle.small_angles_percent, third(1));
    EXPECT_EQ(needle.large_angles_percent, 0);
    const AngleStatistics point = of_triangle({1, 2, 3}, {1, 2, 3}, {1, 2, 3});
    EXPECT_EQ(point.min_angle_deg, 0);
    EXPECT_EQ(point.max_angle_deg, 180);
}

TEST(Statistics, TinyAnglesKeepTheirRelativePrecision) {
    for (const double height : {1e-9, 1e-17, 1e-30}) {
        const AngleStatistics s = of_triangle({0, 0, 0}, {1, 0, 0}, {1, height, 0});
        EXPECT_NEAR(s.min_angle_deg / (height * 180 / std::numbers::pi), 1, 1e-12);
    }
}

TEST(Statistics, AnyScaleOfCoordinates) {
    const PolygonSoup soup = torus_soup(20, 20, 0.1);
    const AngleStatistics unscaled = measure_angles(Mesh(soup));
    for (const int e : {-1000, -300, 300, 1022}) {
        const AngleStatistics s = measure_angles(Mesh(scaled(soup, e)));
        EXPECT_NEAR(s.min_angle_deg, unscaled.min_angle_deg, 1e-12);
        EXPECT_NEAR(s.max_angle_deg, unscaled.max_angle_deg, 1e-12);
        EXPECT_EQ(s.small_angles_percent, unscaled.small_angles_percent);
        EXPECT_EQ(s.large_angles_percent, unscaled.large_angles_percent);
    }
    const double d = std::numeric_limits<double>::denorm_min(), big = std::numeric_limits<double>::max();
    EXPECT_NEAR(of_triangle({0, 0, 0}, {d, 0, 0}, {0, d, 0}).max_angle_deg, 90, 1e-13);
    EXPECT_NEAR(of_triangle({-big, 0, 0}, {big, 0, 0}, {0, big, 0}).max_angle_deg, 90, 1e-13);
    const AngleStatistics mixed = of_triangle({0, 0, 0}, {d, 0, 0}, {0, big, 0});
    EXPECT_EQ(mixed.min_angle_deg, 0);
    EXPECT_NEAR(mixed.max_angle_deg, 90, 1e-13);
}

TEST(Statistics, AnglesDoNotDependOnTheNumberOfThreads) {
    const Mesh mesh(torus_soup(300, 130, 0.02));
    Context one({}, 1), three({}, 3);
    const AngleStatistics a = measure_angles(mesh, &one), b = measure_angles(mesh, &three);
    EXPECT_EQ(a.min_angle_deg, b.min_angle_deg);
    EXPECT_EQ(a.max_angle_deg, b.max_angle_deg);
    EXPECT_EQ(a.small_angles_percent, b.small_angles_percent);
    EXPECT_EQ(a.large_angles_percent, b.large_angles_percent);
}

TEST(Statistics, SizeOfAGridAndATorus) {
    const MeshSize grid = measure_size(Mesh(grid_soup(10)));
    EXPECT_EQ(grid.vertices, 121U);
    EXPECT_EQ(grid.edges, 320U);
    EXPECT_EQ(grid.faces, 200U);
    EXPECT_EQ(grid.boundary_edges, 40U);
    EXPECT_EQ(grid.components, 1U);
    EXPECT_EQ(grid.euler, 1);
    const MeshSize torus = measure_size(Mesh(torus_soup(12, 7, 0)));
    EXPECT_EQ(torus.edges, 3U * 84);
    EXPECT_EQ(torus.boundary_edges, 0U);
    EXPECT_EQ(torus.euler, 0);
}

TEST(Statistics, SizesOfAllFamiliesAgreeWithAnEdgeMap) {
    for (const test::NamedSoup& family : test::families()) {
        SCOPED_TRACE(family.name);
        const MeshSize size = measure_size(Mesh(family.soup));
        const test::SurfaceFacts facts = test::examine(family.soup);
        EXPECT_EQ(size.edges, facts.edges);
        EXPECT_EQ(size.faces, facts.faces);
        EXPECT_EQ(size.boundary_edges, facts.boundary_edges);
        EXPECT_EQ(size.components, facts.components);
        EXPECT_EQ(size.euler, facts.euler);
    }
}

TEST(Statistics, AnglesOfAllFamiliesAgreeWithTheDefinition) {
    for (const test::NamedSoup& family : test::families()) {
        if (family.has_zero_area) continue;  // the long double has no angle there
        SCOPED_TRACE(family.name);
        const Mesh mesh(family.soup);
        // The lattice families hold angles of exactly 30 and 120 degrees, which long doubles can not tell.
        const AngleStatistics a = measure_angles(mesh), b = by_definition(mesh, -1e-9L), c = by_definition(mesh, 1e-9L);
        EXPECT_NEAR(a.min_angle_deg, b.min_angle_deg, 1e-12);
        EXPECT_NEAR(a.max_angle_deg, b.max_angle_deg, 1e-12);
        EXPECT_GE(a.small_angles_percent, b.small_angles_percent - 1e-9);
        EXPECT_LE(a.small_angles_percent, c.small_angles_percent + 1e-9);
        EXPECT_LE(a.large_angles_percent, b.large_angles_percent + 1e-9);
        EXPECT_GE(a.large_angles_percent, c.large_angles_percent - 1e-9);
    }
}

TEST(Statistics, ComponentsAreCountedWithoutIsolatedVertices) {
    PolygonSoup soup = grid_soup(4);
    soup.points.push_back({9, 9, 9});  // isolated
    for (std::uint32_t k = 0; k < 3; ++k) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (const Vec3& p : {Vec3{0, 0, 5}, Vec3{1, 0, 5}, Vec3{0, 1, 5}}) soup.points.push_back(p);
        for (const std::uint32_t i : {first + 2, first, first + 1}) soup.corners.push_back(i);
    }
    const MeshSize size = measure_size(Mesh(soup));
    EXPECT_EQ(size.vertices, 25U + 1 + 9);
    EXPECT_EQ(size.components, 4U);
    EXPECT_EQ(size.euler, 4);
}

TEST(Statistics, BoundingDiagonalLeavesIsolatedVerticesOut) {
    PolygonSoup soup = grid_soup(3);
    EXPECT_EQ(bounding_diagonal(Mesh(soup)), std::sqrt(18.0));
    soup.points.push_back({100, 100, 100});
    EXPECT_EQ(bounding_diagonal(Mesh(soup)), std::sqrt(18.0));
    EXPECT_EQ(bounding_diagonal(Mesh()), 0);
    EXPECT_NEAR(bounding_diagonal(Mesh(grid_soup(1, 1e300))) / 1e300, std::sqrt(2.0), 1e-15);
}

TEST(Statistics, EmptyMesh) {
    EXPECT_EQ(measure_angles(Mesh()).max_angle_deg, 0);
    EXPECT_EQ(measure_size(Mesh()).components, 0U);
}

}  // namespace
}  // namespace delmesh
