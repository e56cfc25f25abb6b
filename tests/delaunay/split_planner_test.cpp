// A chooser that is let go and made again knows what it knew.

#include "delaunay/split_planner.hpp"

#include "delaunay/classify.hpp"
#include "delaunay/refine.hpp"
#include "delmesh/mesh/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <tuple>

namespace delmesh {
namespace {

constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

std::vector<std::tuple<VertexId, VertexId, double>> sorted(const std::vector<SplitPoint>& splits) {
    std::vector<std::tuple<VertexId, VertexId, double>> result;
    for (const SplitPoint& s : splits) result.emplace_back(s.a, s.b, s.t);
    std::sort(result.begin(), result.end());
    return result;
}

class Planner : public testing::TestWithParam<const char*> {
protected:
    /// What the shells of the paper need.
    [[nodiscard]] std::vector<SplitPoint> shells() {
        Mesh copy;
        MarkedMesh split(copy, marked, 0);
        RemeshReport ignored;
        refine_and_clean(split, {}, nullptr, ignored, start.queue);
        std::vector<SplitPoint> splits = split.take_provenance().splits;
        // Those within facets are of no use to the search.
        std::erase_if(splits, [this](const SplitPoint& s) {
            return std::max(s.a, s.b).index() >= mesh.vertex_count() ||
                   !(mesh.find_halfedge(s.a, s.b).valid() || mesh.find_halfedge(s.b, s.a).valid());
        });
        return splits;
    }
    /// The ends of the first edges with points.
    static std::vector<std::array<VertexId, 2>> some_edges(const std::vector<SplitPoint>& splits) {
        std::vector<std::array<VertexId, 2>> edges;
        for (std::size_t i = 0; i < splits.size() && edges.size() < 5; i += 7)
            edges.push_back({splits[i].a, splits[i].b});
        return edges;
    }

    Mesh mesh{make_sample(GetParam(), 1500)};
    MarkedMesh marked{mesh, mark_edges(mesh, nullptr), {}};
    RemeshReport report;
    RefineStart start = flip_planar_edges(marked, {}, nullptr, report);
};

TEST_P(Planner, FindsTheSameWithARest) {
    std::vector<SplitPoint> lent = shells();
    std::vector<SplitPoint> kept = lent;
    const auto before = sorted(lent);
    ASSERT_FALSE(before.empty());
    const std::size_t large = 8 * lent.size();
    lent.reserve(large);
    SplitPlanner resting(marked, start.bad, {1, 1}, lent, 0);
    SplitPlanner awake(marked, start.bad, {1, 1}, kept, never);
    const std::vector<SplitPoint> plan = resting.search(nullptr);
    EXPECT_EQ(sorted(plan), sorted(awake.search(nullptr)));
    EXPECT_EQ(sorted(lent), before);
    EXPECT_LT(lent.capacity(), large) << "its memory was kept while the chooser had it";
    EXPECT_FALSE(resting.take_better_regions(plan));
    EXPECT_FALSE(awake.take_better_regions(plan));
    // In truth one region costs more than the shells: the same plan comes of it.
    std::vector<SplitPoint> truth = plan;
    truth.insert(truth.end(), lent.begin(), lent.end());
    truth.insert(truth.end(), lent.begin(), lent.end());
    const auto rested = resting.take_better_regions(truth);
    const auto other = awake.take_better_regions(truth);
    ASSERT_TRUE(rested && other);
    EXPECT_EQ(sorted(*rested), sorted(*other));
    EXPECT_EQ(sorted(lent), before);
}

TEST_P(Planner, ChoosersHandOverAllTheyKnow) {
    SplitChooser first(marked, start.bad, {1, 1});
    first.search(nullptr);
    ASSERT_TRUE(first.mend(some_edges(first.splits())));
    const SplitPlan plan = first.plan();
    EXPECT_FALSE(plan.distrusted.empty());
    SplitChooser second(marked, start.bad, {1, 1});
    second.resume(plan);
    const SplitPlan again = second.plan();
    EXPECT_EQ(sorted(again.splits), sorted(plan.splits));
    EXPECT_EQ(again.open, plan.open);
    EXPECT_EQ(std::set<EdgeId>(again.distrusted.begin(), again.distrusted.end()),
              std::set<EdgeId>(plan.distrusted.begin(), plan.distrusted.end()));
    EXPECT_EQ(again.is_compared, plan.is_compared);
}

/// In the midst of it, not after: each plan takes its time.
TEST_P(Planner, PlanesCanBeCancelled) {
    std::vector<SplitPoint> none;
    Context context;
    SplitPlanner first(marked, start.bad, {1, 1}, none);
    EXPECT_TRUE(first.lay_slices({}, {}, &context));
    context.cancel();
    SplitPlanner second(marked, start.bad, {1, 1}, none);
    EXPECT_FALSE(second.lay_slices({}, {}, &context));
}

INSTANTIATE_TEST_SUITE_P(Samples, Planner, testing::Values("noisy-sphere", "terrain"));

}  // namespace
}  // namespace delmesh
