// Planes that come to nothing: their work is counted, and ends.

#include "delaunay/slice_threads.hpp"

#include "base/random.hpp"
#include "delaunay/prepared_model.hpp"
#include "delaunay/split_repair.hpp"
#include "delmesh/mesh/polygon_soup.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace delmesh {
namespace {

/// Three of its corners are on a line but for the last place, which no plane across that line keeps a distance from.
Mesh make_sliver() {
    PolygonSoup soup;
    soup.points = {{0, 0, 0},
                   {0x1.0000000000001p0, 0, 0x1.0000000000001p0},
                   {0x1.fffffffffffffp0, 0, 0x1.ffffffffffffep0},
                   {0, -0x1.7ffffffffffffp1, -0x1.7ffffffffffffp1}};
    soup.corners = {0, 2, 3, 0, 3, 1, 2, 0, 1, 2, 1, 3};
    return Mesh(std::move(soup));
}

struct Attempt : test::PreparedModel {
    Attempt() : PreparedModel(make_sliver()) {
        std::uint32_t bad = 0;
        while (model.first_bad(bad) < 0) ++bad;
        SliceThreads slices(model, repair, {0x1p-53, true, false});
        slices.gather(bad);
        edges = slices.edges();
        model.begin();
        const std::uint64_t before = model.work();
        repair.set_work_limit(before + 20'000'000);
        is_solved = slices.solve(nullptr);
        work = model.work() - before;
    }

    Random random{1};
    SplitRepair repair{model, random};
    std::vector<std::uint32_t> edges;
    bool is_solved = true;
    std::uint64_t work = 0;
};

TEST(SliceThreads, OfFewEdgesGiveUpSoon) {
    const Attempt attempt;
    EXPECT_FALSE(attempt.is_solved);
    EXPECT_LE(attempt.edges.size(), 3U);
    EXPECT_GT(attempt.work, 1'000'000U);
    EXPECT_LT(attempt.work, 10'000'000U);
}

/// Each point was put in by a step that had to find the part that is bad among all of its edge.
TEST(SliceThreads, CountAllThatTheyLookAt) {
    const Attempt attempt;
    std::uint64_t looked_at = 0;
    for (const std::uint32_t e : attempt.edges) {
        const std::uint64_t points = attempt.model.point_count(e);
        looked_at += points * points / 2;
    }
    EXPECT_GT(looked_at, 1'000'000U) << "no edge with many parts";
    EXPECT_GT(attempt.work, looked_at / 8);
}

}  // namespace
}  // namespace delmesh
