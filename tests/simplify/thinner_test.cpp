#include "simplify/thinner.hpp"

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

Tuning only_no_more_faults() {
    Tuning tuning;
    tuning.constrained = false;
    tuning.mending = Mending::no_more;
    return tuning;
}

class ThinnerOn : public testing::TestWithParam<const char*> {
protected:
    /// Stopped after one collapse more each time, so that every one of them is seen by `look`, up to the first that
    /// finds nothing more.
    template <class Look>
    void step_down(Mesh& mesh, const Tuning& tuning, Look&& look) {
        const test::SurfaceFacts before = test::examine(to_soup(mesh));
        for (std::size_t target = mesh.vertex_count(); target-- > 1;) {
            Thinner thinner(mesh, tuning, Precision::float64);
            thinner.run(target, nullptr);
            ASSERT_EQ(thinner.collapses(), target + 1 - mesh.vertex_count());
            if (mesh.vertex_count() > target) break;
            ASSERT_EQ(validate(mesh), "") << target;
            const test::SurfaceFacts after = test::examine(to_soup(mesh));
            ASSERT_EQ(after.fault, "") << target;
            ASSERT_EQ(after.euler, before.euler) << target;
            ASSERT_EQ(after.components, before.components) << target;
            ASSERT_EQ(after.boundary_loops, before.boundary_loops) << target;
            look(mesh);
            if (HasFatalFailure()) return;
        }
        EXPECT_LT(mesh.vertex_count(), 3 * before.used_vertices / 4);
    }
};

TEST_P(ThinnerOn, EverySingleCollapseLeavesADelaunayMesh) {
    Mesh mesh = delaunay_sample(GetParam(), 300);
    step_down(mesh, Tuning{}, [](const Mesh& at) { ASSERT_TRUE(certify(at).certified); });
}

TEST_P(ThinnerOn, NoCollapseLeavesMoreEdgesThatAreNotDelaunay) {
    Mesh mesh(make_sample(GetParam(), 300));
    std::size_t most = certify(mesh).non_delaunay_edges;
    step_down(mesh, only_no_more_faults(), [&most](const Mesh& at) {
        const Certificate now = certify(at);
        ASSERT_LE(now.non_delaunay_edges + now.obtuse_boundary_edges, most);
        most = now.non_delaunay_edges + now.obtuse_boundary_edges;
    });
}

/// Gaps are closed on the way, and what is known of vertices must move along.
TEST_P(ThinnerOn, GetsFarAndStaysClose) {
    for (const Tuning& tuning : {Tuning{}, only_no_more_faults()}) {
        Mesh mesh = delaunay_sample(GetParam(), 8000);
        const Mesh fine = mesh;
        Thinner thinner(mesh, tuning, Precision::float64);
        const std::size_t target = mesh.vertex_count() / 4;
        thinner.run(target, nullptr);
        // On plane sides no distance is usual, so it ends early there and leaves the rest to others.
        EXPECT_LE(mesh.vertex_count(), std::string(GetParam()) == "plate" ? fine.vertex_count() * 4 / 5 : target);
        EXPECT_TRUE(certify(mesh).certified || !tuning.constrained);
        EXPECT_LT(measure_distance(fine, mesh, {.samples_per_face = 1}).mean.percent, 0.3);
        test::expect_merged_nearby(fine, mesh, thinner.merged_into());
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ThinnerOn, testing::Values("icosphere", "noisy-sphere", "torus", "terrain", "plate"));

TEST(Thinner, FloatsStayFloats) {
    PolygonSoup soup = make_sample("torus", 1000);
    for (Vec3& p : soup.points) p = round_to_float(p);
    Mesh mesh(std::move(soup));
    Thinner thinner(mesh, only_no_more_faults(), Precision::float32);
    thinner.run(100, nullptr);
    EXPECT_EQ(mesh.vertex_count(), 100u);
    for (const Vec3& p : mesh.points()) EXPECT_EQ(round_to_float(p), p);
}

TEST(Thinner, CancellingLeavesAValidMesh) {
    Mesh mesh = delaunay_sample("torus", 2000);
    const std::size_t before = mesh.vertex_count();
    Thinner thinner(mesh, Tuning{}, Precision::float64);
    Context context;
    context.cancel();
    thinner.run(10, &context);
    EXPECT_EQ(mesh.vertex_count(), before);
    EXPECT_EQ(validate(mesh), "");
}

}  // namespace
}  // namespace delmesh
