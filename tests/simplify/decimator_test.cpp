#include "simplify/decimator.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/mesh/edits.hpp"
#include "simplify/delaunay_sample.hpp"
#include "simplify/edge_cost.hpp"
#include "simplify/walk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace delmesh {
namespace {

using test::delaunay_sample;

/// Tries all edges, as if none had been tried before.
std::size_t count_possible(const Mesh& mesh, double scale) {
    const Tuning tuning;
    const VertexWeights weights(mesh, scale, tuning);
    Placer placer(mesh, tuning);
    Star star;
    std::size_t possible = 0;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (!mesh.origin(h).valid() || !mesh.names_edge(h) || !gather(mesh, h, scale, star)) continue;
        EdgeCost cost = edge_cost(mesh, weights, h, scale, tuning);
        add_volume(star, tuning, cost);
        const auto place = placer.best(star, cost);
        if (place && keeps_delaunay(mesh, star, star.frame.to_mesh(place->point))) ++possible;
    }
    return possible;
}

/// An edge that waits is woken by the vertices of the condition that failed, which does not see everything that may
/// help. When nothing is left in the queue, all edges must have had another turn.
TEST(Decimator, GivesUpOnlyWhereNoEdgeCanBeCollapsed) {
    std::size_t stuck = 0;
    for (const char* name : {"torus", "noisy-torus", "noisy-sphere", "terrain", "plate", "noisy-surface", "grid"}) {
        for (const std::size_t faces : {200, 300, 500, 800}) {
            Mesh mesh;
            try {
                mesh = delaunay_sample(name, faces);
            } catch (const Error&) {
                continue;
            }
            Decimator decimator(mesh, Tuning{});
            decimator.run(1);
            EXPECT_EQ(count_possible(mesh, decimator.scale()), 0u) << name << " " << faces;
            ++stuck;
        }
    }
    EXPECT_GT(stuck, 10u);
}

/// What is brought up to date collapse by collapse is what is found afresh.
TEST(VertexWeights, FollowACollapse) {
    for (const char* name : {"noisy-sphere", "terrain"}) {
        Mesh mesh = delaunay_sample(name, 600);
        const Tuning tuning;
        VertexWeights weights(mesh, 1, tuning);
        Star star;
        std::size_t done = 0;
        for (std::size_t i = 0; i < mesh.halfedge_count(); i += 7) {
            const HalfedgeId h(i);
            if (!mesh.origin(h).valid() || !gather(mesh, h, 1, star) || !can_collapse(mesh, h)) continue;
            const HalfedgeId t = mesh.twin(h);
            const VertexId left = mesh.apex(h);
            const VertexId right = t.valid() ? mesh.apex(t) : VertexId();
            const Vec3 w = star.v_point * 0.5;
            collapse(mesh, h, star.frame.to_mesh(w));
            weights.replace_star(star, star.frame.to_local(mesh.point(star.u)), left, right);
            ++done;
        }
        EXPECT_GT(done, 50u);
        const VertexWeights fresh(mesh, 1, tuning);
        for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
            const HalfedgeId h(i);
            if (!mesh.origin(h).valid()) continue;
            const Vec3 to_v = mesh.point(mesh.target(h)) - mesh.point(mesh.origin(h));
            const Quadric expected = fresh.of_edge(mesh.origin(h), mesh.target(h), to_v);
            const Quadric followed = weights.of_edge(mesh.origin(h), mesh.target(h), to_v);
            EXPECT_NEAR(followed.trace(), expected.trace(), 1e-9 * expected.trace());
            EXPECT_NEAR(followed.xy, expected.xy, 1e-9 * expected.trace());
            EXPECT_NEAR(followed.b.z, expected.b.z, 1e-9 * expected.trace());
            EXPECT_NEAR(followed.c, expected.c, 1e-9 * expected.trace());
        }
    }
}

}  // namespace
}  // namespace delmesh
