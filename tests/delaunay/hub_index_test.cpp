#include "delaunay/hub_index.hpp"

#include "delaunay/marked_mesh.hpp"
#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/validate.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace delmesh {
namespace {

/// Two vertices of `n` edges each, over and under a ring that both are joined to.
Mesh two_hubs(std::uint32_t n) {
    PolygonSoup soup;
    for (std::uint32_t i = 0; i < n; ++i) soup.points.push_back({1.0 * i, 1.0 * i * i, 0});
    soup.points.push_back({0, 0, 1});
    soup.points.push_back({0, 0, -1});
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        soup.corners.insert(soup.corners.end(), {i, j, n, j, i, n + 1});
    }
    return Mesh(soup);
}

TEST(HubIndex, KeepsInStepWithFlipsAndSplits) {
    Mesh mesh = two_hubs(3000);
    MarkedMesh marked(mesh, std::vector<Mark>(mesh.corners().size(), Mark::planar), {});
    test::Random random(5);
    std::size_t flips = 0, refused = 0;
    for (int step = 0; step < 20000; ++step) {
        const HalfedgeId h(random.below(mesh.corners().size()));
        const bool flippable = marked.is_flippable(h);
        const bool apart = mesh.point(mesh.apex(h)) != mesh.point(mesh.apex(mesh.twin(h)));
        ASSERT_EQ(flippable, apart && can_flip(mesh, h)) << step;
        if (flippable && step % 3 != 0) {
            marked.flip_planar(h);
            ++flips;
        } else if (step % 50 == 0) {
            marked.split(h, {mesh.origin(h), mesh.target(h), 0.5}, {0.5 + step, -1.0 * step, 0.25});
        } else {
            ++refused;
        }
    }
    EXPECT_GT(flips, 1000u);
    EXPECT_GT(refused, 1000u);
    EXPECT_EQ(validate(mesh), "");
}

TEST(HubIndex, TheOnlyEdgeBetweenTwoHubs) {
    const std::uint32_t n = 5000;
    Mesh mesh = two_hubs(n);
    MarkedMesh marked(mesh, std::vector<Mark>(mesh.corners().size(), Mark::planar), {});
    const HalfedgeId rim = mesh.find_halfedge(VertexId(7), VertexId(8));
    const HalfedgeId other = mesh.find_halfedge(VertexId(2000), VertexId(2001));
    ASSERT_TRUE(marked.is_flippable(other));
    const HalfedgeId made = marked.flip_planar(rim);
    EXPECT_FALSE(marked.is_flippable(other));
    EXPECT_FALSE(marked.is_flippable(mesh.find_halfedge(VertexId(100), VertexId(101))));
    marked.flip_planar(made);
    EXPECT_TRUE(marked.is_flippable(other));
}

}  // namespace
}  // namespace delmesh
