// Meshes that a handful of points in exact places solves, where doubles see no solution.

#include "delaunay/preserve_check.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/validate.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

namespace delmesh {
namespace {

using test::check_delaunay;
using test::check_preserved;

void add_face(PolygonSoup& soup, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t v : {a, b, c}) soup.corners.push_back(v);
}

/// Needles of one plane around a corner, with all other corners on a line.
Mesh make_fan(std::uint32_t needles, double width, double length) {
    PolygonSoup soup;
    soup.points.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i <= needles; ++i) soup.points.push_back({length, i * width, 0});
    for (std::uint32_t i = 1; i <= needles; ++i) add_face(soup, 0, i, i + 1);
    return Mesh(std::move(soup));
}

/// The number of splits of a solution that keeps all promises.
std::size_t solve(const Mesh& before, Precision precision = Precision::float64) {
    Mesh mesh = before;
    RemeshOptions options;
    options.precision = precision;
    options.max_vertices = 20000;
    const RemeshReport report = make_delaunay(mesh, options);
    EXPECT_EQ(report.stop, StopReason::done);
    EXPECT_EQ(validate(mesh), "");
    EXPECT_EQ(check_delaunay(mesh), "");
    EXPECT_EQ(check_preserved(before, mesh, report.provenance, precision == Precision::float64 ? 1e-13 : 1e-6), "");
    EXPECT_EQ(mesh.vertex_count(), before.vertex_count() + report.splits);
    return report.splits;
}

/// The point lies at about a quarter to once the square of the fan's height from an end: there are doubles there down
/// to a height of 4e-8.
TEST(NeedleFans, NeedOnePointWhereDoublesCanHoldIt) {
    for (const std::uint32_t needles : {5U, 10U, 40U, 100U})
        for (const double height : {1e-2, 1e-4, 1e-6, 1e-7, 4e-8})
            EXPECT_EQ(solve(make_fan(needles, height / needles, 1)), 1U)
                << needles << " needles, " << height << " high";
    EXPECT_EQ(solve(make_fan(40, 1e-9, 3)), 1U);
    EXPECT_EQ(solve(make_fan(33, 3e-8, 0.7)), 1U);
}

/// Thinner ones need two points, one right above the other.
TEST(NeedleFans, NeverNeedMoreThanTwoPoints) {
    for (const std::uint32_t needles : {5U, 10U, 40U, 100U})
        for (const double width : {1e-8, 1e-9, 1e-10, 1e-11, 1e-12})
            EXPECT_LE(solve(make_fan(needles, width, 1)), 2U) << needles << " needles, each " << width << " wide";
}

TEST(NeedleFans, InFloatsNeedNoMore) {
    for (const float height : {0x1p-6F, 0x1p-10F}) {
        const Mesh fan = make_fan(8, height / 8, 1);
        EXPECT_EQ(solve(fan, Precision::float32), 1U) << height;
    }
}

TEST(NeedleFans, OfAnySizeGetTheSamePoints) {
    const Mesh fan = make_fan(40, 1e-9, 1);
    Mesh expected = fan;
    (void)make_delaunay(expected, {});
    for (const double size : {0x1p-900, 0x1p-500, 0x1p500, 0x1p900}) {
        PolygonSoup soup;
        for (const Vec3& p : fan.points()) soup.points.push_back(size * p);
        for (std::uint32_t i = 1; i <= 40; ++i) add_face(soup, 0, i, i + 1);
        Mesh mesh(std::move(soup));
        EXPECT_EQ(make_delaunay(mesh, {}).stop, StopReason::done);
        ASSERT_EQ(mesh.vertex_count(), expected.vertex_count()) << size;
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
            EXPECT_EQ(mesh.point(VertexId(v)), size * expected.point(VertexId(v))) << size;
    }
}

/// The boundary is Delaunay only if both angles at the point are right: exactly, which takes a foot that a double
/// holds.
TEST(ObtuseTriangles, NeedOnePointWhereARightAngleIsExact) {
    for (const double height : {100.0, 1.0, 0x1p-10, 0x1p-40})
        for (const double foot : {500.0, 256.0, 1.0, 999.0}) {
            PolygonSoup soup;
            soup.points = {{0, 0, 0}, {1000, 0, 0}, {foot, height, 0}};
            add_face(soup, 0, 1, 2);
            const Mesh triangle(std::move(soup));
            const bool obtuse = height * height < foot * (1000 - foot);
            EXPECT_EQ(solve(triangle), obtuse ? 1U : 0U) << foot << ", " << height;
        }
}

}  // namespace
}  // namespace delmesh
