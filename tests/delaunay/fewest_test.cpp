// Placement fewest: the promises of mode preserve, and never more splits than the shells.

#include "base/random.hpp"
#include "delaunay/preserve_check.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "delmesh/mesh/validate.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

namespace delmesh {
namespace {

using test::check_delaunay;
using test::check_preserved;

RemeshOptions options_of(SplitPlacement placement, std::size_t effort = 0) {
    RemeshOptions options;
    options.placement = placement;
    options.effort = effort;
    options.max_vertices = 20000;
    return options;
}

bool same_bits(const Mesh& a, const Mesh& b) {
    return a.vertex_count() == b.vertex_count() && a.face_count() == b.face_count() &&
           std::memcmp(a.points().data(), b.points().data(), a.points().size_bytes()) == 0 &&
           std::memcmp(a.corners().data(), b.corners().data(), a.corners().size_bytes()) == 0;
}

class Fewest : public testing::TestWithParam<test::NamedSoup> {};

TEST_P(Fewest, KeepsTheSurfaceAndNeedsNoMoreThanShells) {
    const Mesh before(GetParam().soup);
    if (GetParam().has_zero_area) GTEST_SKIP() << "covered by the tests of the shells";
    Mesh shells = before;
    const RemeshReport by_shells = make_delaunay(shells, options_of(SplitPlacement::shells));
    Mesh mesh = before;
    const RemeshReport report = make_delaunay(mesh, options_of(SplitPlacement::fewest));
    ASSERT_EQ(validate(mesh), "");
    EXPECT_EQ(report.lower_bound, by_shells.lower_bound);
    EXPECT_EQ(mesh.vertex_count(), before.vertex_count() + report.splits);
    EXPECT_EQ(check_preserved(before, mesh, report.provenance, GetParam().extreme_scale ? 1e-9 : 1e-13), "");
    if (by_shells.stop != StopReason::done) return;
    ASSERT_EQ(report.stop, StopReason::done);
    EXPECT_EQ(check_delaunay(mesh), "");
    EXPECT_LE(report.splits, by_shells.splits);
    EXPECT_GE(report.splits, report.lower_bound);
}

TEST_P(Fewest, SameBitsWhateverTheThreads) {
    if (GetParam().has_zero_area) GTEST_SKIP() << "covered by the tests of the shells";
    Mesh one(GetParam().soup);
    Mesh many(GetParam().soup);
    const Context single({}, 1);
    const Context four({}, 4);
    make_delaunay(one, options_of(SplitPlacement::fewest), &single);
    make_delaunay(many, options_of(SplitPlacement::fewest), &four);
    EXPECT_TRUE(same_bits(one, many));
}

INSTANTIATE_TEST_SUITE_P(Families, Fewest, testing::ValuesIn(test::families(300)), [](const auto& named) {
    std::string name = named.param.name;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
});

TEST(Effort, NeverAddsPoints) {
    const Mesh before(make_sample("saddle", 800));
    std::size_t last = before.face_count() * 3;
    for (const std::size_t effort : {0, 1}) {
        Mesh mesh = before;
        const RemeshReport report = make_delaunay(mesh, options_of(SplitPlacement::fewest, effort));
        ASSERT_EQ(report.stop, StopReason::done);
        EXPECT_EQ(check_delaunay(mesh), "");
        EXPECT_LE(report.splits, last);
        last = report.splits;
    }
}

TEST(Effort, AboveTheDefaultFindsWhatTheDefaultMisses) {
    const Mesh before(make_sample("plate", 300));
    std::array<std::size_t, 2> splits{};
    for (const std::size_t more : {0, 1}) {
        Mesh mesh = before;
        const RemeshReport report = make_delaunay(mesh, options_of(SplitPlacement::fewest, 3 + more));
        ASSERT_EQ(report.stop, StopReason::done);
        EXPECT_EQ(check_delaunay(mesh), "");
        splits[more] = report.splits;
    }
    EXPECT_LT(splits[1], splits[0]);
}

TEST(Effort, ZeroTakesHalfOfTheShellsOnRoughSurfaces) {
    for (const char* sample : {"noisy-sphere", "noisy-surface"}) {
        const Mesh before(make_sample(sample, 2000));
        Mesh shells = before;
        Mesh mesh = before;
        const RemeshReport by_shells = make_delaunay(shells, options_of(SplitPlacement::shells));
        const RemeshReport report = make_delaunay(mesh, options_of(SplitPlacement::fewest));
        ASSERT_EQ(report.stop, StopReason::done);
        EXPECT_EQ(check_delaunay(mesh), "");
        EXPECT_LT(2 * report.splits, by_shells.splits) << sample;
    }
}

/// A long thin tube around a circle whose parts have these widths, relative to each other; the corners of both ends lie
/// off them by these lengths. Its triangles are as thin as one to some thousands: points on one long edge make points
/// on the next one necessary, all around, and few places fit.
Mesh make_tube(double radius, const std::vector<double>& widths, const std::vector<double>& offsets) {
    const double around = std::accumulate(widths.begin(), widths.end(), 0.0);
    const auto sides = static_cast<std::uint32_t>(widths.size());
    PolygonSoup soup;
    for (std::uint32_t end = 0; end < 2; ++end) {
        double sum = 0;
        for (std::uint32_t i = 0; i < sides; ++i) {
            // A rational circle, as sines differ in their last bits between systems.
            const double half = 4 * (sum / around) - 2;
            const double scale = radius / (1 + half * half);
            soup.points.push_back({scale * (1 - half * half), scale * 2 * half, end + offsets[end * sides + i]});
            sum += widths[i];
        }
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t j = (i + 1) % sides;
        for (const std::uint32_t v : {i, j, sides + i, j, sides + j, sides + i}) soup.corners.push_back(v);
    }
    return Mesh(std::move(soup));
}

Mesh make_tube(std::uint64_t seed) {
    constexpr std::size_t sides = 8;
    constexpr double radius = 0.003;
    Random random(seed);
    std::vector<double> widths(sides);
    std::vector<double> offsets(2 * sides);
    for (double& width : widths)
        width = random.chance(0.5) ? 0.05 + 0.1 * random.uniform() : 0.3 + 0.7 * random.uniform();
    for (double& offset : offsets) offset = 0.3 * radius * (2 * random.uniform() - 1);
    return make_tube(radius, widths, offsets);
}

TEST(ThinTubes, TakeAFewThreadsAroundAndNotThousandsOfShells) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Mesh before = make_tube(seed);
        Mesh mesh = before;
        const RemeshReport report = make_delaunay(mesh, options_of(SplitPlacement::fewest, 1));
        ASSERT_EQ(report.stop, StopReason::done);
        EXPECT_EQ(check_delaunay(mesh), "");
        EXPECT_EQ(check_preserved(before, mesh, report.provenance, 1e-13), "");
        EXPECT_LT(10 * report.splits, report.splits_by_shells);
    }
}

/// Threads around ends as uneven as these end on them, so that some edge stays open for long: that is no reason to take
/// all that the shells put in.
TEST(ThinTubes, WithUnevenEndsDoNotCostWhatShellsNeed) {
    std::vector<double> offsets{-27, 66,  -94, 94,  -41, 9,   -75, -91, -98, 20, 12,  63,
                                70,  -15, 69,  -60, 76,  -50, 88,  -23, -14, 4,  -88, -85};
    for (double& offset : offsets) offset = 0.003 * offset / 100;
    const Mesh before = make_tube(0.001, {44, 11, 13, 33, 65, 97, 59, 85, 32, 46, 11, 97}, offsets);
    Mesh mesh = before;
    RemeshOptions options = options_of(SplitPlacement::fewest, 1);
    options.max_vertices = 200'000;
    const RemeshReport report = make_delaunay(mesh, options);
    ASSERT_EQ(report.stop, StopReason::done);
    EXPECT_EQ(check_delaunay(mesh), "");
    EXPECT_EQ(check_preserved(before, mesh, report.provenance, 1e-13), "");
    ASSERT_GT(report.splits_by_shells, 10'000u);
    EXPECT_LT(report.splits, 500u);
}

/// Searches on `mesh`, a copy of `before`: it ends, certified, on the same surface, with fewer points than that for
/// each edge that must be split.
void expect_few_points(const Mesh& before, Mesh& mesh, std::size_t points_per_edge) {
    const RemeshReport report = make_delaunay(mesh, options_of(SplitPlacement::fewest, 1));
    ASSERT_EQ(report.stop, StopReason::done);
    EXPECT_EQ(validate(mesh), "");
    EXPECT_EQ(check_delaunay(mesh), "");
    EXPECT_EQ(check_preserved(before, mesh, report.provenance, 1e-13), "");
    EXPECT_LT(report.splits, points_per_edge * report.lower_bound);
}

/// Lines at right angles to needles that lean, as all but a few do here, wind around without end: shells put more than
/// a million points in. Planes do with ten for each edge that must be split.
TEST(LeaningNeedles, AreCutByPlanes) {
    PolygonSoup soup = make_sample("icosphere", 320);
    for (Vec3& p : soup.points) p.x *= 1e6;
    const Mesh before(soup);
    Mesh mesh = before;
    expect_few_points(before, mesh, 15);
    for (Vec3& p : soup.points) p = p * std::ldexp(1.0, -498);
    Mesh tiny(soup);
    (void)make_delaunay(tiny, options_of(SplitPlacement::fewest, 1));
    EXPECT_EQ(tiny.vertex_count(), mesh.vertex_count());
    EXPECT_TRUE(std::equal(tiny.corners().begin(), tiny.corners().end(), mesh.corners().begin(), mesh.corners().end()));
    Mesh shells = before;
    EXPECT_EQ(make_delaunay(shells, options_of(SplitPlacement::shells)).stop, StopReason::max_vertices);
}

/// At many corners planes leave edges not Delaunay however near they come; at the border, and at the tips of the
/// surface, too. And at a scale that is no power of two rounding spoils a plan elsewhere.
TEST(LeaningNeedles, NeedNoLuck) {
    struct Case {
        const char* sample;
        std::size_t faces;
        Vec3 axis;
        double stretch;
        double scale;
        std::size_t points_per_edge;
    };
    for (const Case& c : {Case{"noisy-sphere", 200, {1, 0, 0}, 1e5, 1, 80},
                          {"terrain", 100, {0.96, 0.28, 0}, 1e4, 1e30, 60},
                          {"torus", 200, {0.8, 0.36, 0.48}, 1e5, 1e-30, 100}}) {
        SCOPED_TRACE(c.sample);
        PolygonSoup soup = make_sample(c.sample, c.faces);
        for (Vec3& p : soup.points) p = (p + (c.stretch - 1) * dot(p, c.axis) * c.axis) * c.scale;
        const Mesh before(soup);
        Mesh mesh = before;
        expect_few_points(before, mesh, c.points_per_edge);
    }
}

}  // namespace
}  // namespace delmesh
