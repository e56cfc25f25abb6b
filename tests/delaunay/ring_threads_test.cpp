// Rings and strips of needles: few threads of points close them, as many as their shape calls for.

#include "delaunay/ring_threads.hpp"

#include "delaunay/prepared_model.hpp"
#include "delaunay/preserve_check.hpp"
#include "delaunay/split_ring.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/polygon_soup.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>

namespace delmesh {
namespace {

/// A wall of needles around the z axis, with caps: `height(i)` tells how far vertex i of both borders lies from z = 0.
template <class Height>
Mesh make_wall(std::uint32_t sides, double radius, Height&& height) {
    PolygonSoup soup;
    for (const double sign : {-1.0, 1.0})
        for (std::uint32_t i = 0; i < sides; ++i) {
            // A rational circle, as sines differ in their last bits between systems.
            const std::uint32_t quarter = i / (sides / 4);
            const double t = static_cast<double>(i % (sides / 4)) / (sides / 4.0);
            const std::array<double, 2> p{(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)};
            const std::array<double, 4> x{p[0], -p[1], -p[0], p[1]};
            const std::array<double, 4> y{p[1], p[0], -p[1], -p[0]};
            soup.points.push_back({radius * x[quarter], radius * y[quarter], sign * height(i, sign)});
        }
    for (const double sign : {-1.0, 1.0}) soup.points.push_back({0, 0, 0.5 * sign});
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t j = (i + 1) % sides;
        for (const std::uint32_t v :
             {i, j, sides + i, j, sides + j, sides + i, j, i, 2 * sides, sides + i, sides + j, 2 * sides + 1})
            soup.corners.push_back(v);
    }
    return Mesh(std::move(soup));
}

RemeshReport remesh(Mesh& mesh, std::size_t effort, std::size_t seed = 1) {
    RemeshOptions options;
    options.effort = effort;
    options.seed = seed;
    options.max_vertices = 200'000;
    return make_delaunay(mesh, options);
}

/// Slopes of the borders between one and three times what a whole rung bears: one thread is needed, and enough.
TEST(Wall, OfNeedlesBetweenWavesTakesOneThread) {
    constexpr std::uint32_t sides = 400;
    constexpr double radius = 0.1;
    for (const std::size_t effort : {0u, 1u}) {
        const Mesh before = make_wall(sides, radius, [](std::uint32_t i, double) {
            const double t = (i % 20) / 20.0;
            return 0.5 + 8e-5 * (t < 0.5 ? t : 1 - t) + 2e-5 * (i % 2);
        });
        Mesh mesh = before;
        const RemeshReport report = remesh(mesh, effort);
        ASSERT_EQ(report.stop, StopReason::done);
        EXPECT_EQ(test::check_delaunay(mesh), "");
        EXPECT_EQ(test::check_preserved(before, mesh, report.provenance, 1e-13), "");
        EXPECT_GE(report.lower_bound, sides / 2);
        EXPECT_LE(report.splits, 2 * sides + sides / 10) << report.lower_bound << ", " << report.splits_by_shells;
    }
}

/// Borders that go up and down like a saw, by many times the width of the needles: threads lie closer and closer
/// together towards the borders.
Mesh make_saw(std::uint32_t sides) {
    return make_wall(sides, 0.1, [&](std::uint32_t i, double sign) {
        const std::uint32_t k = (i + (sign > 0 ? 7u : 0u)) % 24;
        return 0.5 + 0.06 * 6.28 / sides * (k < 12 ? k : 24 - k);
    });
}

TEST(Wall, OfNeedlesBetweenSawsTakesAFewThreads) {
    constexpr std::uint32_t sides = 480;
    const Mesh before = make_saw(sides);
    Mesh mesh = before;
    const RemeshReport report = remesh(mesh, 1);
    ASSERT_EQ(report.stop, StopReason::done);
    EXPECT_EQ(test::check_delaunay(mesh), "");
    EXPECT_EQ(test::check_preserved(before, mesh, report.provenance, 1e-13), "");
    EXPECT_LE(report.splits, 16 * sides) << report.splits_by_shells;
}

TEST(RingThreads, LeaveNoRungBadAndTakeWorkInProportionToTheRing) {
    std::array<double, 2> work{};
    for (const int i : {0, 1}) {
        const std::uint32_t sides = i == 0 ? 480 : 960;
        test::PreparedModel rings(make_saw(sides));
        SplitRing ring(rings.model);
        std::uint32_t e = 0;
        while (!ring.gather(e, 10'000)) ++e;
        ASSERT_EQ(ring.rungs().size(), sides);
        const std::uint64_t before = rings.model.work();
        const std::size_t threads = ring.plan(false);
        work[i] = static_cast<double>(rings.model.work() - before);
        ASSERT_GT(threads, 1u);
        EXPECT_LT(threads, 16u);
        ring.lay_planned_threads();
        std::size_t bad = 0;
        for (const Rung& rung : ring.rungs()) {
            ASSERT_EQ(rings.model.point_count(rung.edge), threads);
            double last = 0;
            for (const Part& part : rings.model.parts(rung.edge)) {
                ASSERT_GT(part.end, last);
                last = part.end;
            }
            ASSERT_EQ(last, 1);
            bad += rings.model.first_bad(rung.edge) >= 0 ? 1 : 0;
        }
        EXPECT_LE(16 * bad, ring.rungs().size());
    }
    EXPECT_LT(work[1], 4 * work[0]);
}

/// An open strip of needles that lean far more than they are wide, between a boundary and a wide face.
TEST(FootThreads, CloseStripsThatLeanWithoutShells) {
    PolygonSoup soup;
    constexpr std::uint32_t rungs = 8;
    for (std::uint32_t i = 0; i < rungs; ++i) {
        const double x = 0.004 * i;
        const double bend = 0.02 * x * (i + 1);
        soup.points.push_back({x, bend, 0.11 * i + 0.002 * (i % 3)});
        soup.points.push_back({x + 0.002, bend + 0.0001, 1 + 0.1 * i});
    }
    soup.points.push_back({1, 0.3, 1.2});
    for (std::uint32_t i = 0; i + 1 < rungs; ++i)
        for (const std::uint32_t v : {2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 1, 2 * i + 2, 2 * i + 3})
            soup.corners.push_back(v);
    for (const std::uint32_t v : {2 * rungs - 2, 2 * rungs, 2 * rungs - 1}) soup.corners.push_back(v);
    const Mesh before(std::move(soup));
    for (const std::size_t effort : {0u, 1u}) {
        Mesh mesh = before;
        // With most seeds rounding breaks some of the feet, and effort 0 mends nothing.
        const RemeshReport report = remesh(mesh, effort, effort == 0 ? 4 : 1);
        ASSERT_EQ(report.stop, StopReason::done);
        EXPECT_EQ(test::check_delaunay(mesh), "");
        EXPECT_EQ(test::check_preserved(before, mesh, report.provenance, 1e-13), "");
        EXPECT_LE(report.splits, 300) << report.splits_by_shells;
    }
}

}  // namespace
}  // namespace delmesh
