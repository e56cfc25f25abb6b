#include "repair/repair_support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace delmesh::test {
namespace {

TEST(Weld, JoinsTheCornersOfATriangleSoup) {
    const PolygonSoup cube = make_cube({0, 0, 0});
    const Repaired out = repair_and_check(take_apart(cube));
    EXPECT_EQ(out.soup.points.size(), 8U);
    EXPECT_EQ(count_boundary_edges(out.soup), 0U);
    EXPECT_EQ(out.report.count(Defect::duplicate_vertex), 28U);
}

TEST(Weld, ClosesASeamAndKeepsTheFirstNumbers) {
    // A strip whose middle edge is there twice, as at a seam of texture coordinates.
    const PolygonSoup soup =
        triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {3, 5, 4}});
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
    EXPECT_EQ(out.report.vertex_origin, (std::vector<VertexId>{VertexId(0), VertexId(1), VertexId(2), VertexId(5)}));
    EXPECT_EQ(count_boundary_edges(out.soup), 4U);
}

TEST(Weld, MinusZeroIsZero) {
    const PolygonSoup soup = triangles(
        {{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, -0.0, -0.0}, {0, -1, 0}, {1, -0.0, 0}}, {{0, 1, 2}, {3, 4, 5}});
    EXPECT_EQ(repair_and_check(soup).soup.points.size(), 4U);
}

TEST(Weld, KeepsWhatIsNotAtTheSamePlace) {
    PolygonSoup cube = take_apart(make_cube({1, 1, 1}));
    for (std::size_t i = 0; i < cube.points.size(); ++i) cube.points[i].x += static_cast<double>(i % 7) * 0x1p-40;
    EXPECT_GT(repair_and_check(cube).soup.points.size(), 8U);
}

TEST(Weld, ToleranceClosesGaps) {
    PolygonSoup cube = take_apart(make_cube({0, 0, 0}, 2));
    for (std::size_t i = 0; i < cube.points.size(); ++i)
        cube.points[i][static_cast<int>(i % 3)] += 1e-6 * std::sin(static_cast<double>(i));
    for (const double scale : {1.0, 1e-300, 1e300, 1e-310}) {
        SCOPED_TRACE(scale);
        PolygonSoup soup = cube;
        for (Vec3& p : soup.points) p = p * scale;
        const PolygonSoup before = soup;
        const RepairReport report = repair(soup, {.weld_tolerance_rel = 1e-5});
        EXPECT_EQ(soup.points.size(), 8U);
        EXPECT_EQ(count_boundary_edges(soup), 0U);
        EXPECT_EQ(report.count(Defect::near_vertex), 28U);
    }
    const Repaired out = repair_and_check(cube, {.weld_tolerance_rel = 1e-5});
    for (std::size_t f = 0; f < out.soup.face_count(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& was = cube.points[cube.corners[3 * out.report.face_origin[f].index() + i]];
            const Vec3& is = out.soup.points[out.soup.face(f)[i]];
            EXPECT_LE(norm(is - was), 1e-5 * norm({2.1, 2.1, 2.1}));
        }
}

TEST(Weld, ChainsDoNotRunTogether) {
    // A strip of 101 columns, each nearer to the next than the tolerance: clusters are balls, so some columns remain.
    PolygonSoup soup;
    for (int i = 0; i <= 100; ++i)
        for (int j = 0; j < 2; ++j) soup.points.push_back({i * 0.01, j * 1.0, 0});
    for (std::uint32_t i = 0; i < 100; ++i) {
        soup.add_face(Triangle{2 * i, 2 * i + 2, 2 * i + 1});
        soup.add_face(Triangle{2 * i + 1, 2 * i + 2, 2 * i + 3});
    }
    const double tolerance = 0.025 / std::sqrt(2.0);
    const Repaired out = repair_and_check(soup, {.weld_tolerance_rel = tolerance});
    EXPECT_EQ(out.soup.points.size(), 2U * 34U);
    for (const Vec3& p : soup.points) {
        double nearest = 1;
        for (const Vec3& q : out.soup.points) nearest = std::min(nearest, norm(p - q));
        EXPECT_LE(nearest, 0.025);
    }
}

TEST(Weld, WholeBoxWithinTheTolerance) {
    const Repaired out = repair_and_check(make_cube({0, 0, 0}), {.weld_tolerance_rel = 1});
    EXPECT_EQ(out.soup.face_count(), 0U);
    EXPECT_TRUE(out.report.changed);
}

}  // namespace
}  // namespace delmesh::test
