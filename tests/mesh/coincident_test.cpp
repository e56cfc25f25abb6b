#include "delmesh/mesh/coincident.hpp"

#include "delmesh/mesh/rounding.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace delmesh {
namespace {

PolygonSoup touching() {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {5, 5, 5}, {5, 5, 5}, {1, 0, 0}, {0, 0, 0}};
    soup.corners = {0, 1, 2, 3, 6, 2, 7, 1, 2};
    return soup;
}

TEST(Coincident, PairsNameTheFirstOfEachPlaceAndSkipUnusedPoints) {
    const auto pairs = find_coincident(touching());
    const std::vector<std::array<std::uint32_t, 2>> expected{{0, 3}, {1, 6}, {0, 7}};
    EXPECT_EQ(pairs, expected);
}

TEST(Coincident, WeldingLeavesNone) {
    PolygonSoup soup = touching();
    EXPECT_EQ(weld_coincident(soup), 3u);
    EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 0, 1, 2}));
    EXPECT_TRUE(find_coincident(soup).empty());
    EXPECT_EQ(weld_coincident(soup), 0u);
}

TEST(Coincident, PartingLeavesNoneAndMovesByFloatSteps) {
    PolygonSoup soup = touching();
    const PolygonSoup before = soup;
    EXPECT_GE(part_coincident(soup), 3u);
    EXPECT_TRUE(find_coincident(soup).empty());
    EXPECT_EQ(soup.corners, before.corners);
    for (std::size_t v = 0; v < soup.points.size(); ++v) {
        EXPECT_EQ(round_to_float(soup.points[v]), soup.points[v]);
        EXPECT_LE(norm(soup.points[v] - before.points[v]), 3e-7);
    }
    // The first of each place stays.
    EXPECT_EQ(soup.points[0], before.points[0]);
    EXPECT_EQ(soup.points[1], before.points[1]);
}

}  // namespace
}  // namespace delmesh
