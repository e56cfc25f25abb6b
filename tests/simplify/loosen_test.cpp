#include "simplify/loosen.hpp"

#include "delmesh/measure/certificate.hpp"
#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/validate.hpp"
#include "simplify/decimator.hpp"
#include "simplify/delaunay_sample.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

using test::delaunay_sample;

TEST(Loosener, KeepsTheMeshDelaunayAndItsTopology) {
    for (const char* name : {"torus", "noisy-sphere", "terrain", "plate"}) {
        Mesh mesh = delaunay_sample(name, 300);
        Decimator decimator(mesh, Tuning{});
        decimator.run(60);
        compact(mesh);
        const test::SurfaceFacts before = test::examine(to_soup(mesh));
        const std::uint64_t bits = test::hash_bits(to_soup(mesh));
        std::size_t changes = 0;
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            Loosener loosener(
                mesh, nullptr, decimator.scale(), [](const Vec3& w) { return w; }, [](VertexId, const Vec3&) {});
            changes += loosener.run({.seed = seed});
            EXPECT_EQ(validate(mesh), "") << name;
            EXPECT_TRUE(certify(mesh).certified) << name;
            const test::SurfaceFacts after = test::examine(to_soup(mesh));
            EXPECT_EQ(after.euler, before.euler) << name;
            EXPECT_EQ(after.components, before.components) << name;
            EXPECT_EQ(after.boundary_loops, before.boundary_loops) << name;
            EXPECT_EQ(after.used_vertices, before.used_vertices) << name;
        }
        EXPECT_GT(changes, 20u) << name;
        EXPECT_NE(test::hash_bits(to_soup(mesh)), bits) << name;
    }
}

/// What samples are told of flips and moves is what is found afresh.
TEST(Loosener, NoSampleGetsFartherThanAllowed) {
    Mesh mesh = delaunay_sample("noisy-sphere", 600);
    Decimator decimator(mesh, Tuning{});
    decimator.follow_samples(mesh.vertex_count(), 100000);
    decimator.run(60);
    const double scale = decimator.scale();
    const double allowed2 = 9 * decimator.samples().mean2();
    const double mean2 = decimator.samples().mean2();
    std::size_t changes = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        Loosener loosener(
            mesh, &decimator.samples(), scale, [](const Vec3& w) { return w; }, [](VertexId, const Vec3&) {});
        changes += loosener.run({.seed = seed, .allowed2 = allowed2});
    }
    EXPECT_GT(changes, 20u);
    decimator.samples().freshen(mesh, scale);
    EXPECT_LE(decimator.samples().mean2(), std::max(mean2, allowed2));
    Star star;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.halfedge(VertexId(v)).valid()) continue;
        gather(mesh, VertexId(v), scale, star);
        decimator.samples().gather(star);
        const double noted = decimator.samples().present().sum;
        EXPECT_LE(decimator.samples().measure(star, {}).sum, noted * (1 + 1e-5) + 1e-12);
    }
}

}  // namespace
}  // namespace delmesh
