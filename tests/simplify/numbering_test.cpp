#include "simplify/numbering.hpp"

#include "delmesh/mesh/shapes.hpp"
#include "delmesh/mesh/validate.hpp"
#include "simplify/frame.hpp"
#include "support/random.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace delmesh {
namespace {

/// A mesh out of which some edges were collapsed.
Mesh worn(std::uint64_t seed) {
    Mesh mesh(make_sample("torus", 600));
    test::Random random(seed);
    for (int i = 0; i < 60; ++i) {
        const HalfedgeId h(random.below(mesh.halfedge_count()));
        if (mesh.is_live(Mesh::face(h)) && can_collapse(mesh, h)) collapse(mesh, h, mesh.point(mesh.origin(h)));
    }
    return mesh;
}

TEST(Numbering, GoingBackToTheNamesIsTheSameAsClosingTheGaps) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        Mesh mesh = worn(seed);
        Mesh expected = mesh;
        compact(expected);
        Numbering numbering(mesh);
        numbering.renumber(mesh, in_order_of_place(mesh, local_scale(mesh)));
        EXPECT_EQ(validate(mesh), "");
        EXPECT_NE(test::hash_bits(to_soup(mesh)), test::hash_bits(to_soup(expected)));
        numbering.close_gaps(mesh);
        numbering.renumber(mesh, numbering.in_order_of_names(mesh));
        EXPECT_EQ(validate(mesh), "");
        EXPECT_EQ(test::hash_bits(to_soup(mesh)), test::hash_bits(to_soup(expected)));
    }
}

TEST(Numbering, NamesSurviveTwoChanges) {
    Mesh mesh = worn(9);
    const Mesh before = mesh;
    Numbering numbering(mesh);
    numbering.renumber(mesh, in_order_of_place(mesh, local_scale(mesh)));
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (!mesh.is_live(Mesh::face(h)) || !can_collapse(mesh, h)) continue;
        collapse(mesh, h, mesh.point(mesh.origin(h)));
        break;
    }
    numbering.close_gaps(mesh);
    EXPECT_EQ(validate(mesh), "");
    const std::vector<VertexId> ids = numbering.ids();
    ASSERT_EQ(ids.size(), before.vertex_count());
    std::size_t found = 0;
    for (std::size_t v = 0; v < ids.size(); ++v) {
        if (!ids[v].valid()) continue;
        ++found;
        EXPECT_EQ(mesh.point(ids[v]), before.point(VertexId(v)));
        EXPECT_EQ(numbering.name(ids[v]), VertexId(v));
    }
    EXPECT_EQ(found, mesh.vertex_count());
}

/// What shares a face lies closer in memory than in a random order by far.
TEST(Numbering, NeighboursLieClose) {
    Mesh mesh(make_sample("icosphere", 20000));
    Numbering numbering(mesh);
    numbering.renumber(mesh, in_order_of_place(mesh, local_scale(mesh)));
    double sum = 0;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        sum += std::abs(static_cast<double>(mesh.origin(h).value()) - static_cast<double>(mesh.target(h).value()));
    }
    const double mean = sum / static_cast<double>(mesh.halfedge_count());
    EXPECT_LT(mean, 0.1 * static_cast<double>(mesh.vertex_count()));
}

}  // namespace
}  // namespace delmesh
