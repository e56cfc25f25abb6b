#include "simplify/decimator.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/mesh/edits.hpp"
#include "simplify/delaunay_sample.hpp"
#include "simplify/edge_cost.hpp"
#include "simplify/pool.hpp"
#include "simplify/walk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
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

/// Calls `collapse_at(h, star, left, right)` for each `step`-th half-edge that can be collapsed, with the two apexes;
/// how often.
template <class CollapseAt>
std::size_t collapse_some(const Mesh& mesh, std::size_t step, CollapseAt&& collapse_at) {
    Star star;
    std::size_t done = 0;
    for (std::size_t i = 0; i < mesh.halfedge_count(); i += step) {
        const HalfedgeId h(i);
        if (!mesh.origin(h).valid() || !gather(mesh, h, 1, star) || !can_collapse(mesh, h)) continue;
        const HalfedgeId t = mesh.twin(h);
        collapse_at(h, star, mesh.apex(h), t.valid() ? mesh.apex(t) : VertexId());
        ++done;
    }
    return done;
}

/// What is brought up to date collapse by collapse is what is found afresh.
TEST(VertexWeights, FollowACollapse) {
    for (const char* name : {"noisy-sphere", "terrain"}) {
        Mesh mesh = delaunay_sample(name, 600);
        const Tuning tuning;
        VertexWeights weights(mesh, 1, tuning);
        const auto halve = [&](HalfedgeId h, const Star& star, VertexId left, VertexId right) {
            collapse(mesh, h, star.frame.to_mesh(star.v_point * 0.5));
            weights.replace_star(star, star.frame.to_local(mesh.point(star.u)), left, right);
        };
        EXPECT_GT(collapse_some(mesh, 7, halve), 50u);
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

/// Planes that are computed when they are asked for are those that are kept, to the last bit.
TEST(VertexWeights, ThatKeepOnlyWhatHasChangedAreTheSame) {
    for (const char* name : {"noisy-sphere", "terrain"}) {
        Mesh mesh = delaunay_sample(name, 600);
        const Tuning tuning;
        VertexWeights all(mesh, 1, tuning);
        VertexWeights changed(mesh, 1, tuning, VertexWeights::Kept::changed);
        std::size_t done = 0;
        const auto halve = [&](HalfedgeId h, const Star& star, VertexId left, VertexId right) {
            const Vec3 w = star.v_point * 0.5;
            changed.prepare(star);
            for (VertexWeights* weights : {&all, &changed})
                weights->set_history(star.u, weights->merged_history(star, w));
            collapse(mesh, h, star.frame.to_mesh(w));
            for (VertexWeights* weights : {&all, &changed}) {
                weights->forget(star.v);
                weights->replace_star(star, star.frame.to_local(mesh.point(star.u)), left, right);
            }
            if (++done % 20 != 0) return;
            const CompactMap map = compact(mesh);
            all.renumber(map.vertex);
            changed.close_gaps(map.vertex);
        };
        EXPECT_GT(collapse_some(mesh, 17, halve), 30u);
        const auto expect_same = [](const Quadric& a, const Quadric& b) {
            EXPECT_EQ(a.xx, b.xx);
            EXPECT_EQ(a.yz, b.yz);
            EXPECT_EQ(a.b, b.b);
            EXPECT_EQ(a.c, b.c);
        };
        for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
            const HalfedgeId h(i);
            if (!mesh.origin(h).valid()) continue;
            const Vec3 to_v = mesh.point(mesh.target(h)) - mesh.point(mesh.origin(h));
            expect_same(changed.of_edge(mesh.origin(h), mesh.target(h), to_v),
                        all.of_edge(mesh.origin(h), mesh.target(h), to_v));
            expect_same(changed.history(mesh.origin(h)), all.history(mesh.origin(h)));
        }
    }
}

TEST(Pool, GivesRoomAgainThatWasGivenBack) {
    struct Pair {
        double a = 1, b = 2;
    };
    Pool<Pair> pool;
    constexpr std::uint32_t many = 100'000;  // more than a block
    for (std::uint32_t i = 0; i < many; ++i) {
        ASSERT_EQ(pool.take(), i);
        pool[i].a = i;
    }
    pool.give_back(7);
    pool.give_back(many - 1);
    EXPECT_EQ(pool.take(), many - 1);
    EXPECT_EQ(pool[many - 1].a, 1) << "as new";
    EXPECT_EQ(pool.take(), 7u);
    EXPECT_EQ(pool.take(), many);
    EXPECT_EQ(pool[8].a, 8);
    EXPECT_EQ(pool[many - 2].a, many - 2);
}

}  // namespace
}  // namespace delmesh
