#include "simplify/sweeper.hpp"

#include "delmesh/measure/certificate.hpp"
#include "delmesh/measure/distance.hpp"
#include "delmesh/mesh/validate.hpp"
#include "simplify/delaunay_sample.hpp"
#include "simplify/merged_into.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

#include <string>

namespace delmesh {
namespace {

using test::delaunay_sample;

class SweeperOn : public testing::TestWithParam<const char*> {};

/// Stopped after one collapse more each time, so that every one of them is seen.
TEST_P(SweeperOn, EverySingleCollapseLeavesADelaunayMesh) {
    Mesh mesh = delaunay_sample(GetParam(), 300);
    const test::SurfaceFacts before = test::examine(to_soup(mesh));
    for (std::size_t target = mesh.vertex_count(); target-- > 1;) {
        Numbering numbering(mesh);
        Sweeper sweeper(mesh, Tuning{}, Precision::float64, numbering);
        sweeper.run(target, nullptr);
        EXPECT_EQ(sweeper.collapses(), target + 1 - mesh.vertex_count());
        if (mesh.vertex_count() > target) break;
        ASSERT_EQ(validate(mesh), "") << target;
        const test::SurfaceFacts after = test::examine(to_soup(mesh));
        ASSERT_EQ(after.fault, "") << target;
        ASSERT_EQ(after.euler, before.euler) << target;
        ASSERT_EQ(after.components, before.components) << target;
        ASSERT_EQ(after.boundary_loops, before.boundary_loops) << target;
        ASSERT_TRUE(certify(mesh).certified) << target;
    }
    EXPECT_LT(mesh.vertex_count(), 2 * before.used_vertices / 3);
}

/// Gaps are closed on the way, and what is known of edges and vertices must move along.
TEST_P(SweeperOn, GetsFarAndStaysClose) {
    Mesh mesh = delaunay_sample(GetParam(), 8000);
    const Mesh fine = mesh;
    Numbering numbering(mesh);
    Sweeper sweeper(mesh, Tuning{}, Precision::float64, numbering);
    const std::size_t target = mesh.vertex_count() / 8;
    sweeper.run(target, nullptr);
    // On plane sides no distance is usual, so sweeping ends early there and leaves the rest to the queue.
    EXPECT_LE(mesh.vertex_count(), std::string(GetParam()) == "plate" ? fine.vertex_count() * 3 / 4 : target);
    EXPECT_TRUE(certify(mesh).certified);
    EXPECT_LT(measure_distance(fine, mesh, {.samples_per_face = 1}).mean.percent, 0.5);
    test::expect_merged_nearby(fine, mesh, sweeper.merged_into());
}

INSTANTIATE_TEST_SUITE_P(Shapes, SweeperOn, testing::Values("icosphere", "noisy-sphere", "torus", "terrain", "plate"));

TEST(Sweeper, FloatsStayFloats) {
    PolygonSoup soup = make_sample("torus", 1000);
    for (Vec3& p : soup.points) p = round_to_float(p);
    Mesh mesh(std::move(soup));
    RemeshOptions remesh = SimplifyOptions::default_remesh();
    remesh.precision = Precision::float32;
    make_delaunay(mesh, remesh);
    Numbering numbering(mesh);
    Sweeper sweeper(mesh, Tuning{}, Precision::float32, numbering);
    sweeper.run(100, nullptr);
    EXPECT_EQ(mesh.vertex_count(), 100u);
    for (const Vec3& p : mesh.points()) EXPECT_EQ(round_to_float(p), p);
    EXPECT_TRUE(certify(mesh).certified);
}

TEST(Sweeper, CancellingLeavesAValidMesh) {
    Mesh mesh = delaunay_sample("torus", 2000);
    const std::size_t before = mesh.vertex_count();
    Numbering numbering(mesh);
    Sweeper sweeper(mesh, Tuning{}, Precision::float64, numbering);
    Context context;
    context.cancel();
    sweeper.run(10, &context);
    EXPECT_EQ(mesh.vertex_count(), before);
    EXPECT_EQ(validate(mesh), "");
}

}  // namespace
}  // namespace delmesh
