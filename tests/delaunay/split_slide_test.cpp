// Threads of points around a thin tube: points that slide together become Delaunay, and stay in order.

#include "delaunay/split_slide.hpp"

#include "base/random.hpp"
#include "delaunay/prepared_model.hpp"
#include "delaunay/split_ring.hpp"
#include "delmesh/mesh/polygon_soup.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace delmesh {
namespace {

constexpr std::uint32_t sides = 6;

/// A tube along z with an uneven cross-section and slanted ends.
Mesh make_tube() {
    constexpr std::array<std::array<double, 2>, sides> section{
        {{0.01, 0}, {0.004, 0.008}, {-0.003, 0.009}, {-0.01, 0}, {-0.006, -0.007}, {0.005, -0.008}}};
    PolygonSoup soup;
    for (const double z : {0.0, 1.0})
        for (const auto& [x, y] : section) soup.points.push_back({x, y, z + (z > 0 ? 0.3 : -0.4) * x - 0.2 * y});
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t j = (i + 1) % sides;
        for (const std::uint32_t v : {i, j, sides + i, j, sides + j, sides + i}) soup.corners.push_back(v);
    }
    return Mesh(std::move(soup));
}

class Tube : public testing::Test {
protected:
    test::PreparedModel prepared_{make_tube()};
    SplitModel& model_ = prepared_.model;
};

TEST_F(Tube, IsARingOfAllItsLongEdges) {
    SplitRing ring(model_);
    for (std::uint32_t e = 0; e < model_.edge_count(); ++e) {
        const bool is_long =
            model_.layout().edge(e).side[0] != SplitModel::none && model_.layout().edge(e).side[1] != SplitModel::none;
        EXPECT_EQ(ring.gather(e, 100), is_long);
        if (is_long) {
            EXPECT_EQ(ring.rungs().size(), sides);
        }
        EXPECT_FALSE(ring.gather(e, sides - 1));
    }
}

TEST_F(Tube, ThreadsThatAreAskewSlideUntilAllIsDelaunay) {
    SplitRing ring(model_);
    SplitSlide slide(model_);
    Random random(5);
    std::uint32_t rung = 0;
    while (!ring.gather(rung, 100)) ++rung;
    int solved = 0;
    for (int round = 0; round < 20; ++round) {
        ring.lay_threads(6);
        std::vector<double> places;
        for (const Rung& r : ring.rungs()) {
            places.clear();
            for (const Part& part : model_.parts(r.edge).first(6))
                places.push_back(part.end * (1 + 0.005 * (random.uniform() - 0.5)));
            model_.cut(r.edge, 0, 6, places);
        }
        const bool had_bad = model_.suspect_count() > 0;
        const bool done = slide.run(60, 1000);
        solved += had_bad && done ? 1 : 0;
        for (const Rung& r : ring.rungs()) {
            ASSERT_EQ(model_.point_count(r.edge), 6u);
            double last = 0;
            for (const Part& part : model_.parts(r.edge)) {
                ASSERT_GT(part.end, last);
                last = part.end;
            }
            ASSERT_EQ(last, 1);
            EXPECT_TRUE(!done || model_.first_bad(r.edge) < 0);
        }
        while (model_.suspect_count() > 0) model_.drop_suspect(0);
    }
    EXPECT_GE(solved, 15);
}

TEST_F(Tube, PointsThatAreNotEnoughStayInOrder) {
    SplitRing ring(model_);
    SplitSlide slide(model_);
    std::uint32_t rung = 0;
    while (!ring.gather(rung, 100)) ++rung;
    for (const double at : {0.1, 0.5, 0.9}) {
        for (const Rung& r : ring.rungs()) model_.cut(r.edge, 0, model_.point_count(r.edge), {});
        const std::array<double, 2> pair{at, at + 1e-6};
        model_.cut(rung, 0, 0, pair);
        EXPECT_FALSE(slide.run(200, 1000));
        EXPECT_GT(model_.suspect_count(), 0u);
        EXPECT_GT(model_.parts(rung)[0].end, 0);
        EXPECT_GT(model_.parts(rung)[1].end, model_.parts(rung)[0].end);
        EXPECT_LT(model_.parts(rung)[1].end, 1);
        while (model_.suspect_count() > 0) model_.drop_suspect(0);
    }
}

}  // namespace
}  // namespace delmesh
