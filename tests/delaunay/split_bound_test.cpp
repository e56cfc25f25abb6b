// The proved lower bound: no run beats it, and no points that are put anywhere do.

#include "delaunay/split_bound.hpp"

#include "base/random.hpp"
#include "delaunay/classify.hpp"
#include "delaunay/close_gaps.hpp"
#include "delaunay/refine.hpp"
#include "delaunay/split_model.hpp"
#include "delaunay/split_search.hpp"
#include "delaunay/split_trial.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

namespace delmesh {
namespace {

void add_face(PolygonSoup& soup, const std::array<std::uint32_t, 3>& face) {
    soup.add_face(face);
}

class SplitBound : public testing::TestWithParam<test::NamedSoup> {};

TEST_P(SplitBound, NoRunNeedsFewerSplits) {
    const Mesh before(GetParam().soup);
    RemeshOptions options;
    options.max_vertices = 20000;
    std::optional<std::size_t> bound;
    for (const SplitPlacement placement : {SplitPlacement::shells, SplitPlacement::fewest}) {
        for (const std::size_t seed : {1, 2}) {
            options.placement = placement;
            options.effort = 0;
            options.seed = seed;
            options.shell_unit_abs = seed == 1 ? 1 : 0.7;
            options.bound = seed == 1;
            Mesh mesh = before;
            const RemeshReport report = make_delaunay(mesh, options);
            ASSERT_EQ(report.lower_bound_strong.has_value(), options.bound);
            const std::size_t told = report.lower_bound_strong.value_or(bound.value_or(0));
            EXPECT_EQ(told, bound.value_or(told)) << "depends on the run";
            bound = told;
            EXPECT_GE(told, report.lower_bound);
            if (report.stop != StopReason::done) continue;
            EXPECT_LE(told, report.splits);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Families, SplitBound, testing::ValuesIn(test::families(30)), [](const auto& named) {
    std::string name = named.param.name;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
});

/// A rim of random points around a hub: a small piece of a rough surface.
Mesh wheel(Random& random, std::size_t spokes) {
    PolygonSoup soup;
    soup.points.push_back({random.uniform() - 0.5, random.uniform() - 0.5, random.uniform()});
    for (std::size_t i = 0; i < spokes; ++i) {
        const double angle = 6.283 * (static_cast<double>(i) + 0.4 * random.uniform()) / static_cast<double>(spokes);
        const double radius = 0.4 + 1.6 * random.uniform();
        soup.points.push_back({radius * std::cos(angle), radius * std::sin(angle), random.uniform()});
    }
    for (std::uint32_t i = 0; i < spokes; ++i) {
        const auto next = static_cast<std::uint32_t>((i + 1) % spokes);
        add_face(soup, {0, i + 1, next + 1});
    }
    return Mesh(std::move(soup));
}

struct Small {
    explicit Small(Mesh from) : mesh(std::move(from)), marked(mesh, mark_edges(mesh, nullptr), {}) {
        RemeshReport report;
        bad = flip_planar_edges(marked, {}, nullptr, report).bad;
        bound = strong_lower_bound(marked, bad, {}, nullptr);
    }
    Mesh mesh;
    MarkedMesh marked;
    std::vector<EdgeId> bad;
    std::size_t bound = 0;
};

/// Do points at these parameters, one on each edge that must be split, make all edges Delaunay?
bool is_solution(SplitModel& model, const std::vector<std::uint32_t>& edges, const std::vector<double>& at) {
    for (std::size_t i = 0; i < edges.size(); ++i) model.cut(edges[i], 0, model.point_count(edges[i]), {&at[i], 1});
    for (std::uint32_t e = 0; e < model.edge_count(); ++e)
        if (model.first_bad(e) >= 0) return false;
    return true;
}

bool has_solution_with_one_each(const Small& small, int steps) {
    SplitModel model(small.marked);
    std::vector<std::uint32_t> edges;
    for (const EdgeId e : small.bad) edges.push_back(model.edge_of(Mesh::halfedge(e)));
    for (const std::uint32_t e : edges) model.prepare(e);
    std::vector<double> at(edges.size());
    int total = 1;
    for (std::size_t i = 0; i < edges.size(); ++i) total *= steps;
    for (int k = 0; k < total; ++k) {
        for (int i = 0, rest = k; i < static_cast<int>(edges.size()); ++i, rest /= steps)
            at[i] = (rest % steps + 0.5) / steps;
        if (is_solution(model, edges, at)) return true;
    }
    return false;
}

TEST(SplitBoundOfWheels, ASearchOfAllPlacesAgrees) {
    Random random(3);
    int above = 0;
    int missed = 0;
    int met = 0;
    for (int round = 0; round < 300; ++round) {
        const Small small(wheel(random, 3 + round % 4));
        if (small.bad.empty() || small.bad.size() > 2) continue;
        const bool solved = has_solution_with_one_each(small, small.bad.size() == 1 ? 400 : 50);
        if (small.bound > small.bad.size()) {
            ++above;
            EXPECT_FALSE(solved) << "round " << round;
        } else {
            ++(solved ? met : missed);
        }
    }
    EXPECT_GT(above, 10);
    EXPECT_GT(met, 25);
    // Some need more though no core is found.
    EXPECT_LT(missed, above / 2);
}

TEST(SplitBoundOfWheels, ALongSearchNeverBeatsItAndOftenMeetsIt) {
    Random random(5);
    int met = 0;
    int above = 0;
    int count = 0;
    for (int round = 0; round < 150; ++round) {
        Mesh mesh = wheel(random, 3 + round % 6);
        RemeshOptions options;
        options.bound = true;
        options.effort = 0;
        for (const std::size_t seed : {1, 2, 3}) {
            options.seed = seed;
            Mesh copy = mesh;
            const RemeshReport report = make_delaunay(copy, options);
            ASSERT_EQ(report.stop, StopReason::done);
            ASSERT_LE(*report.lower_bound_strong, report.splits) << "round " << round << " seed " << seed;
            if (seed > 1 || report.lower_bound == 0) continue;
            ++count;
            if (*report.lower_bound_strong == report.splits) ++met;
            if (*report.lower_bound_strong > report.lower_bound + 1) ++above;
        }
    }
    EXPECT_GT(above, count / 20);
    EXPECT_GT(met, count / 3);
}

TEST(SplitBoundOfTriangles, ObtuseOnesNeedOnePoint) {
    for (const double height : {0.3, 1e-3, 1e-6, 1e-9, 1e-12}) {
        PolygonSoup soup;
        soup.points = {{0, 0, 0}, {1, 0, 0}, {0.3, height, 0.2 * height}};
        add_face(soup, {0, 1, 2});
        EXPECT_EQ(Small(Mesh(std::move(soup))).bound, 1U);
    }
}

/// A fan of needles around a corner needs a single point, next to an end: where that is so is a matter of digits.
TEST(SplitBoundOfNeedles, AFanNeedsOnePoint) {
    PolygonSoup soup;
    soup.points.push_back({0, 0, 0});
    for (int i = 0; i <= 40; ++i) soup.points.push_back({1, i * 1e-9, 0});
    for (std::uint32_t i = 1; i <= 40; ++i) add_face(soup, {0, i, i + 1});
    const Mesh fan(soup);
    const Small small(fan);
    EXPECT_EQ(small.bad.size(), 1U);
    EXPECT_EQ(small.bound, 1U);

    // The point at the distance 1e-15 from that end: no splits are left to do.
    const double t = 1 - 1e-15;
    PolygonSoup split = to_soup(fan);
    split.points.push_back({t, t * 40e-9, 0});
    PolygonSoup halves;
    halves.points = split.points;
    for (std::uint32_t i = 1; i < 40; ++i) add_face(halves, {0, i, i + 1});
    add_face(halves, {0, 40, 42});
    add_face(halves, {42, 40, 41});
    Mesh mesh(std::move(halves));
    EXPECT_EQ(make_delaunay(mesh).splits, 0U);
}

/// What lies above the bound is looked at again, several cores together.
TEST(SplitGaps, WhatIsProvedThenIsMoreAndNoRunBeatsIt) {
    const Mesh before(make_sample("noisy-sphere", 600));
    RemeshOptions options;
    options.bound = true;
    std::array<std::size_t, 2> proved{};
    std::size_t fewest = unlimited_splits;
    for (const std::size_t more : {0, 1}) {
        options.effort = more == 0 ? 3 : 4;
        for (const std::size_t seed : {1, 2}) {
            options.seed = seed;
            Mesh mesh = before;
            const RemeshReport report = make_delaunay(mesh, options);
            ASSERT_EQ(report.stop, StopReason::done);
            proved[more] = std::max(proved[more], *report.lower_bound_strong);
            fewest = std::min(fewest, report.splits);
        }
    }
    EXPECT_GT(proved[1], proved[0]);
    EXPECT_LE(proved[1], fewest);
}

/// Points that a quick construction has too many.
TEST(SplitGaps, PlacesForFewerPointsAreFound) {
    Random random(7);
    std::size_t before = 0;
    std::size_t after = 0;
    int met = 0;
    int count = 0;
    for (int round = 0; round < 100; ++round) {
        Small small(wheel(random, 4 + round % 5));
        if (small.bad.empty()) continue;
        SplitModel model(small.marked);
        SplitSearch search(model, 1);
        std::vector<std::uint32_t> edges;
        for (const EdgeId e : small.bad) edges.push_back(model.edge_of(Mesh::halfedge(e)));
        for (const std::uint32_t e : edges) model.prepare(e);
        search.construct(edges, 1'000'000);
        if (!search.open().empty()) continue;
        ++count;
        const std::size_t points = model.point_count();
        GapCloser gaps(model, small.bad, {}, 1, nullptr);
        gaps.run(10'000'000, nullptr);
        before += points;
        after += model.point_count();
        EXPECT_LE(model.point_count(), points);
        EXPECT_LE(gaps.bound(), model.point_count());
        EXPECT_GE(gaps.bound(), small.bound);
        for (std::uint32_t e = 0; e < model.edge_count(); ++e) EXPECT_LT(model.first_bad(e), 0);
        if (gaps.bound() == model.point_count()) ++met;
        RemeshOptions options;
        options.effort = 0;
        for (options.seed = 1; options.seed <= 3; ++options.seed) {
            Mesh copy = small.mesh;
            EXPECT_GE(make_delaunay(copy, options).splits, gaps.bound()) << "round " << round;
        }
    }
    EXPECT_GT(count, 40);
    EXPECT_LT(after, before - before / 20);
    EXPECT_GT(met, 3 * count / 4);
}

TEST(SplitBoundOfSamples, IsFarAboveTheNumberOfEdges) {
    for (const char* name : {"noisy-sphere", "terrain"}) {
        const Small small{Mesh(make_sample(name, 600))};
        EXPECT_GT(small.bound, small.bad.size() + small.bad.size() / 20) << name;
    }
}

}  // namespace
}  // namespace delmesh
