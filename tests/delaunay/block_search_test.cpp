// The search in blocks: the same points whatever the threads, fewer than before, and nothing is bad after it.

#include "delaunay/block_search.hpp"

#include "delaunay/classify.hpp"
#include "delaunay/facet_blocks.hpp"
#include "delaunay/refine.hpp"
#include "delaunay/split_regions.hpp"
#include "delaunay/split_search.hpp"
#include "delmesh/mesh/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace delmesh {
namespace {

constexpr int rounds = 3;

struct Prepared {
    explicit Prepared(const char* sample)
        : mesh(make_sample(sample, 1500)),
          marked(mesh, mark_edges(mesh, nullptr), {}),
          start(flip_planar_edges(marked, {}, nullptr, report)) {}

    /// A model with the first solution that comes along.
    void construct(SplitModel& model) const {
        std::vector<std::uint32_t> bad;
        for (const EdgeId e : start.bad) {
            bad.push_back(model.edge_of(Mesh::halfedge(e)));
            model.prepare(bad.back());
        }
        SplitSearch search(model, 1);
        search.construct(bad, 100'000'000);
    }

    Mesh mesh;
    MarkedMesh marked;
    RemeshReport report;
    RefineStart start;
};

/// Edges that are bad but not given up.
std::size_t count_bad(const SplitModel& model) {
    std::size_t count = 0;
    for (std::uint32_t e = 0; e < model.edge_count(); ++e)
        if (!model.is_given_up(e) && model.first_bad(e) >= 0) ++count;
    return count;
}

class Blocks : public testing::TestWithParam<const char*> {};

TEST_P(Blocks, ImproveWhateverTheThreads) {
    const Prepared prepared(GetParam());
    std::vector<PlacedPoint> first;
    for (const int threads : {1, 2, 5}) {
        const Context context({}, threads);
        SplitModel model(prepared.marked);
        prepared.construct(model);
        std::size_t before = model.point_count();
        for (int round = 0; round < rounds; ++round) {
            improve_in_blocks(model, round, {3, 3000, false, 60}, &context);
            EXPECT_LE(model.point_count(), before);
            EXPECT_EQ(count_bad(model), 0U);
            EXPECT_EQ(model.suspect_count(), 0U);
            before = model.point_count();
        }
        const std::vector<PlacedPoint> points = placed_points(model);
        if (first.empty()) first = points;
        EXPECT_TRUE(std::equal(points.begin(), points.end(), first.begin(), first.end(),
                               [](const auto& a, const auto& b) { return a.edge == b.edge && a.at == b.at; }))
            << threads << " threads";
    }
}

TEST_P(Blocks, AreSmallAndLeaveMostFacetsInside) {
    const Prepared prepared(GetParam());
    SplitModel model(prepared.marked);
    prepared.construct(model);
    std::vector<std::vector<std::uint32_t>> by_round;
    for (int round = 0; round < rounds; ++round) {
        const FacetBlocks blocks = cut_into_blocks(model, 60, round);
        EXPECT_GE(blocks.facets.size(), model.point_count() / 60);
        std::size_t facets = 0;
        for (const auto& block : blocks.facets) facets += block.size();
        EXPECT_EQ(facets, model.layout().facet_count());
        EXPECT_EQ(std::count(blocks.block_of.begin(), blocks.block_of.end(), FacetBlocks::none), 0);
        by_round.push_back(blocks.block_of);
    }
    EXPECT_NE(by_round[0], by_round[1]);
    EXPECT_NE(by_round[1], by_round[2]);
}

/// The faces with an angle whose sine is below a limit once the model's points are put in.
std::size_t count_thin_faces(const Prepared& prepared, const SplitModel& model, double limit) {
    std::vector<SplitPoint> plan;
    for (const PlacedPoint& point : placed_points(model)) {
        const HalfedgeId h = model.layout().edge(point.edge).halfedge;
        const auto [a, b] = std::minmax({prepared.mesh.origin(h), prepared.mesh.target(h)});
        plan.push_back({a, b, point.at});
    }
    Mesh mesh = prepared.mesh;
    MarkedMesh marked(mesh, prepared.marked);
    RemeshReport report;
    EXPECT_TRUE(carry_out(marked, {}, nullptr, report, prepared.start, plan).empty());
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        std::array<Vec3, 3> p;
        for (std::uint32_t i = 0; i < 3; ++i) p[i] = mesh.point(mesh.origin(HalfedgeId(3 * f + i)));
        std::array<double, 3> sides{norm(p[1] - p[0]), norm(p[2] - p[1]), norm(p[0] - p[2])};
        std::sort(sides.begin(), sides.end());
        if (norm(cross(p[1] - p[0], p[2] - p[0])) < limit * sides[1] * sides[2]) ++count;
    }
    return count;
}

TEST_P(Blocks, PolishingLeavesFewerThinFacesAndNoMorePoints) {
    const Prepared prepared(GetParam());
    for (const bool in_blocks : {false, true}) {
        SplitModel model(prepared.marked);
        prepared.construct(model);
        if (count_bad(model) > 0 || GetParam() == std::string("plate")) return;  // the mesh has thin faces itself
        const std::size_t points = model.point_count();
        const std::size_t thin = count_thin_faces(prepared, model, 0.02);
        if (in_blocks) {
            improve_in_blocks(model, 0, {3, 20000, true, 60}, nullptr);
        } else {
            SplitSearch search(model, 1);
            search.polish(20000 * points);
        }
        EXPECT_LE(model.point_count(), points);
        EXPECT_EQ(count_bad(model), 0U);
        EXPECT_GE(thin, 5U);
        EXPECT_LT(count_thin_faces(prepared, model, 0.02), thin);
    }
}

INSTANTIATE_TEST_SUITE_P(Samples, Blocks, testing::Values("terrain", "plate", "noisy-sphere"), [](const auto& named) {
    std::string name = named.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

}  // namespace
}  // namespace delmesh
