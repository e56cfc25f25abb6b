#include "simplify/polish.hpp"

#include "delmesh/measure/certificate.hpp"
#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/validate.hpp"
#include "simplify/decimator.hpp"
#include "simplify/delaunay_sample.hpp"
#include "simplify/numbering.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

#include <set>

namespace delmesh {
namespace {

void expect_same_surface(const Mesh& mesh, const test::SurfaceFacts& before) {
    Mesh living = mesh;
    for (std::size_t v = 0; v < living.vertex_count(); ++v)
        if (living.is_live(VertexId(v)) && !living.halfedge(VertexId(v)).valid()) remove_isolated(living, VertexId(v));
    compact(living);
    EXPECT_EQ(validate(living), "");
    EXPECT_TRUE(certify(living).certified);
    const test::SurfaceFacts after = test::examine(to_soup(living));
    EXPECT_EQ(after.euler, before.euler);
    EXPECT_EQ(after.components, before.components);
    EXPECT_EQ(after.boundary_loops, before.boundary_loops);
}

class PolishOf : public testing::TestWithParam<const char*> {
protected:
    PolishOf() : mesh(test::delaunay_sample(GetParam(), 3000)), facts(test::examine(to_soup(mesh))) {}

    Mesh mesh;
    test::SurfaceFacts facts;
};

TEST_P(PolishOf, ExchangesVerticesForLessError) {
    Numbering numbering(mesh);
    const std::size_t names = mesh.vertex_count();
    Decimator decimator(mesh, Tuning{});
    decimator.follow_samples(names, 1'000'000);
    decimator.run(names / 8);
    decimator.refit({.rounds = 6});
    decimator.close_gaps(numbering);
    const std::size_t vertices = mesh.vertex_count();
    const std::size_t faces = mesh.face_count();
    const double before = decimator.samples().mean2();
    EXPECT_GT(decimator.polish(), 0u);
    EXPECT_LT(decimator.samples().mean2(), 0.99 * before);
    EXPECT_EQ(mesh.vertex_count(), vertices);
    EXPECT_EQ(mesh.face_count(), faces);
    EXPECT_EQ(decimator.vertices(), vertices);
    EXPECT_EQ(validate(mesh), "");
    expect_same_surface(mesh, facts);
    std::set<VertexId> used;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) used.insert(numbering.name(VertexId(v)));
    EXPECT_EQ(used.size(), vertices) << "each has a name of its own";
    decimator.run(vertices / 2);
    EXPECT_EQ(decimator.vertices(), vertices / 2) << "the queue goes on from there";
    expect_same_surface(mesh, facts);
}

TEST_P(PolishOf, ReducesByWhatAddsLeast) {
    const std::size_t vertices = mesh.vertex_count();
    const std::size_t target = vertices / 10;
    Decimator decimator(mesh, Tuning{});
    decimator.follow_samples(vertices, 1'000'000);
    decimator.run(target + target / 4);
    const std::size_t from = decimator.vertices();
    const std::size_t collapses = decimator.counts().collapses;
    decimator.reduce(target);
    EXPECT_LT(decimator.vertices(), from);
    EXPECT_GE(decimator.vertices(), target);
    EXPECT_EQ(decimator.counts().collapses - collapses, from - decimator.vertices());
    std::size_t used = 0;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) used += mesh.halfedge(VertexId(v)).valid() ? 1 : 0;
    EXPECT_EQ(decimator.vertices(), used);
    expect_same_surface(mesh, facts);
}

INSTANTIATE_TEST_SUITE_P(All, PolishOf, testing::Values("terrain", "noisy-sphere", "torus"));

}  // namespace
}  // namespace delmesh
