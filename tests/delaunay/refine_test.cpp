#include "delaunay/refine.hpp"

#include "delmesh/mesh/rounding.hpp"
#include "delmesh/mesh/validate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace delmesh {
namespace {

/// A 5 by 5 grid whose inner vertices lie folded on a few floats, as points on the sides of a needle do near its tip.
Mesh folded_grid() {
    constexpr int size = 5;
    constexpr int places[size * size][2] = {
        {-799, -800}, {-799, -400}, {-800, 1},   {-799, 400}, {-800, 800}, {-399, -798}, {1, 9},      {1, 4},  {1, 2},
        {-398, 802},  {1, -798},    {0, 9},      {0, 1},      {0, 0},      {1, 800},     {400, -798}, {0, 10}, {0, 4},
        {0, 6},       {401, 801},   {802, -798}, {801, -399}, {802, 2},    {802, 401},   {800, 800}};
    PolygonSoup soup;
    // Floats are 0.5 apart there.
    for (const auto& [x, y] : places) soup.points.push_back(Vec3{0x1p22 + 0.5 * x, 0x1p22 + 0.5 * y, 0});
    for (std::uint32_t i = 0; i + 1 < size; ++i) {
        for (std::uint32_t j = 0; j + 1 < size; ++j) {
            const std::uint32_t a = i * size + j;
            soup.add_face(std::array{a, a + size, a + size + 1});
            soup.add_face(std::array{a, a + size + 1, a + 1});
        }
    }
    return Mesh(std::move(soup));
}

/// There flips bring an edge back whenever it is halved.
TEST(Refine, StopsWhereAnEdgeInAPlaneComesBackForEver) {
    Mesh mesh = folded_grid();
    std::vector<Mark> marks;
    std::vector<HalfedgeId> queue;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        queue.emplace_back(i);
        marks.push_back(mesh.is_boundary(HalfedgeId(i)) ? Mark::physical : Mark::planar);
    }
    MarkedMesh marked(mesh, std::move(marks), {});
    RemeshOptions options;
    options.precision = Precision::float32;
    options.max_vertices = 100'000;
    RemeshReport report;
    split_rest(marked, options, nullptr, report, std::move(queue));
    EXPECT_EQ(report.stop, StopReason::unresolved);
    EXPECT_TRUE(report.endless);
    EXPECT_TRUE(report.witness.has_value());
    EXPECT_LT(mesh.vertex_count(), 1000U);
    EXPECT_EQ(validate(mesh), "");
}

}  // namespace
}  // namespace delmesh
