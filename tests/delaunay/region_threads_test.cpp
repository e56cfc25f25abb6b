// Threads at right angles to needles between borders of any shape: as few as do for all of them.

#include "delaunay/region_threads.hpp"

#include "delaunay/prepared_model.hpp"
#include "delaunay/preserve_check.hpp"
#include "delaunay/split_regions.hpp"
#include "delaunay/split_search.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/polygon_soup.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace delmesh {
namespace {

/// A fan, all but flat, of which the border leaves a circle about the tip at one half of its needles: whatever splits
/// these crosses all that follow.
Mesh make_fan(std::uint32_t needles) {
    PolygonSoup soup;
    soup.points.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i <= needles; ++i) {
        const double share = static_cast<double>(i) / needles;
        const double t = 0.4 * share - 0.2;
        const double radius = share < 0.5 ? 0.6 + 0.8 * share : 1;
        soup.points.push_back(
            {radius * (1 - t * t) / (1 + t * t), radius * 2 * t / (1 + t * t), i % 2 == 0 ? 0 : 1e-5});
    }
    for (std::uint32_t i = 1; i <= needles; ++i)
        for (const std::uint32_t v : {0U, i, i + 1}) soup.corners.push_back(v);
    return Mesh(std::move(soup));
}

std::vector<std::uint32_t> bad_edges(const SplitModel& model) {
    std::vector<std::uint32_t> bad;
    for (std::uint32_t e = 0; e < model.edge_count(); ++e)
        if (model.first_bad(e) >= 0) bad.push_back(e);
    return bad;
}

struct Solved : test::PreparedModel {
    explicit Solved(Mesh from) : PreparedModel(std::move(from)), search(model, 1) {
        search.construct(bad_edges(model), 1'000'000);
        search.close_open(10'000'000);
    }

    SplitSearch search;
};

TEST(RegionThreads, TakeFewerPointsThanOneThreadForEachCornerOfTheBorder) {
    Solved fan(make_fan(60));
    ASSERT_TRUE(bad_edges(fan.model).empty());
    const std::size_t before = fan.model.point_count();
    fan.search.lay_regions(20'000'000);
    EXPECT_TRUE(bad_edges(fan.model).empty());
    EXPECT_EQ(fan.model.suspect_count(), 0U);
    EXPECT_LE(fan.model.point_count(), before * 2 / 3) << before;
}

TEST(RegionThreads, LeaveAllAsItWasWhereTheyDoNotPay) {
    Solved fan(make_fan(60));
    fan.search.lay_regions(20'000'000);
    const std::vector<PlacedPoint> before = placed_points(fan.model);
    Random random(1);
    SplitRepair repair(fan.model, random);
    RegionThreads region(fan.model, repair, 7);
    region.gather(before.front().edge);
    EXPECT_EQ(region.point_count(), before.size());
    for (const std::uint64_t work : {0U, 100'000U, 3'000'000U}) {
        EXPECT_FALSE(region.thin(work)) << work;
        const std::vector<PlacedPoint> after = placed_points(fan.model);
        ASSERT_EQ(after.size(), before.size()) << work;
        for (std::size_t i = 0; i < after.size(); ++i) {
            ASSERT_EQ(after[i].edge, before[i].edge);
            ASSERT_EQ(after[i].at, before[i].at);
        }
        EXPECT_EQ(fan.model.suspect_count(), 0U);
        EXPECT_TRUE(bad_edges(fan.model).empty());
    }
}

TEST(RegionThreads, StandTheTestOfExactSigns) {
    const Mesh before = make_fan(60);
    Mesh mesh = before;
    RemeshOptions options;
    options.effort = 1;
    const RemeshReport report = make_delaunay(mesh, options);
    ASSERT_EQ(report.stop, StopReason::done);
    EXPECT_EQ(test::check_delaunay(mesh), "");
    EXPECT_EQ(test::check_preserved(before, mesh, report.provenance, 1e-13), "");
    EXPECT_LE(report.splits, 550U) << report.splits_by_shells;
}

}  // namespace
}  // namespace delmesh
