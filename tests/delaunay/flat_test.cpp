// The flat tolerance: edges that are physical only by rounding flip, and the surface stays as near as was promised.

#include "delaunay/clean.hpp"
#include "delaunay/features.hpp"
#include "delaunay/flat_caps.hpp"
#include "delaunay/flat_rule.hpp"
#include "delaunay/marked_mesh.hpp"
#include "delaunay/preserve_check.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/measure/distance.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "delmesh/mesh/validate.hpp"
#include "support/families.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstring>

namespace delmesh {
namespace {

using test::check_delaunay;

RemeshOptions within(FlatTolerance tolerance) {
    RemeshOptions options;
    options.placement = SplitPlacement::shells;
    options.flat_tolerance_rel = tolerance;
    options.max_vertices = 20000;
    return options;
}

/// By rational numbers, so that only the last step rounds.
Vec3 turned(const Vec3& p) {
    const Vec3 q{0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
    return {q.x, 5.0 / 13 * q.y - 12.0 / 13 * q.z, 12.0 / 13 * q.y + 5.0 / 13 * q.z};
}

enum class Stored { doubles, floats, text };

/// The surface of a box of cells, each cut at random, turned in space and rounded.
PolygonSoup rounded_box(int n, Stored stored) {
    PolygonSoup soup;
    std::vector<std::uint32_t> index(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)), UINT32_MAX);
    const auto vertex = [&](std::array<int, 3> cell) {
        std::uint32_t& i = index[static_cast<std::size_t>((cell[0] * (n + 1) + cell[1]) * (n + 1) + cell[2])];
        if (i != UINT32_MAX) return i;
        i = static_cast<std::uint32_t>(soup.points.size());
        Vec3 p = turned({cell[0] * 1.0, cell[1] * 1.0, cell[2] * 1.0});
        if (stored == Stored::floats) p = round_to_float(p);
        if (stored == Stored::text)
            for (const int axis : {0, 1, 2}) p[axis] = std::nearbyint(p[axis] * 1e6) / 1e6;
        soup.points.push_back(p);
        return i;
    };
    test::Random random(3);
    for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {0, n}) {
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) {
                    const auto corner = [&](int di, int dj) {
                        std::array<int, 3> cell{};
                        cell[static_cast<std::size_t>(axis)] = side;
                        cell[static_cast<std::size_t>((axis + 1) % 3)] = i + di;
                        cell[static_cast<std::size_t>((axis + 2) % 3)] = j + dj;
                        return vertex(cell);
                    };
                    std::array<std::uint32_t, 4> quad{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
                    if (side == 0) std::swap(quad[1], quad[3]);
                    const std::size_t k = random.below(2u);
                    soup.corners.insert(soup.corners.end(), {quad[k], quad[k + 1], quad[(k + 2) % 4]});
                    soup.corners.insert(soup.corners.end(), {quad[k], quad[(k + 2) % 4], quad[(k + 3) % 4]});
                }
            }
        }
    }
    return soup;
}

TEST(FlatTolerance, RoundingAloneNeedsNoVertex) {
    for (const Stored stored : {Stored::doubles, Stored::floats, Stored::text}) {
        const Mesh before(rounded_box(7, stored));
        Mesh exact = before;
        const RemeshReport as_it_is = make_delaunay(exact, within({FlatRule::given, 0}));
        EXPECT_GT(as_it_is.splits, 50u) << "the case is not one";
        EXPECT_EQ(as_it_is.max_deviation, 0);
        Mesh mesh = before;
        const RemeshReport report = make_delaunay(mesh, within({FlatRule::stored}));
        EXPECT_EQ(report.splits, 0u);
        EXPECT_GT(report.max_deviation, 0);
        EXPECT_LE(report.max_deviation, report.flat_tolerance);
        EXPECT_EQ(check_delaunay(mesh), "");
    }
}

TEST(FlatTolerance, ByDefaultTheSurfaceIsKeptExactly) {
    const Mesh before(rounded_box(5, Stored::floats));
    Mesh exact = before;
    Mesh by_default = before;
    make_delaunay(exact, within({FlatRule::given, 0}));
    const RemeshReport report = make_delaunay(by_default, within({}));
    EXPECT_EQ(report.flat_tolerance, 0);
    EXPECT_EQ(test::check_preserved(before, by_default, report.provenance, 1e-13), "");
    EXPECT_EQ(std::memcmp(exact.corners().data(), by_default.corners().data(), exact.corners().size_bytes()), 0);
}

TEST(FlatTolerance, ByDefaultItHelpsWhereTheRunWouldStopShort) {
    const Mesh before(rounded_box(7, Stored::floats));
    Mesh mesh = before;
    RemeshOptions options = within({});
    options.max_vertices = before.vertex_count() + 5;
    const RemeshReport report = make_delaunay(mesh, options);
    EXPECT_EQ(report.stop, StopReason::done);
    EXPECT_EQ(report.splits, 0u);
    EXPECT_GT(report.flat_tolerance, 0);
    options.flat_tolerance_rel = {FlatRule::given, 0};
    Mesh stopped = before;
    EXPECT_EQ(make_delaunay(stopped, options).stop, StopReason::max_vertices);
}

class Flat : public testing::TestWithParam<test::NamedSoup> {};

TEST_P(Flat, TheSurfaceStaysWithinWhatIsReported) {
    if (GetParam().has_zero_area || GetParam().extreme_scale) GTEST_SKIP() << "distances are measured with doubles";
    const Mesh before(GetParam().soup);
    const UnitFrame frame = unit_frame(before);
    for (const double tolerance : {1e-6, 1e-3, 1e-2}) {
        Mesh mesh = before;
        RemeshOptions given = within({FlatRule::given, tolerance});
        // The search lays facets out as if they were plane: what it proposes is checked all the same.
        given.placement = tolerance == 1e-3 ? SplitPlacement::fewest : SplitPlacement::shells;
        given.effort = 0;
        const RemeshReport report = make_delaunay(mesh, given);
        ASSERT_EQ(validate(mesh), "");
        if (report.stop == StopReason::done) {
            EXPECT_EQ(check_delaunay(mesh), "");
        }
        EXPECT_LE(report.max_deviation, report.flat_tolerance);
        DistanceOptions options;
        options.samples_per_face = 2;
        options.min_samples = 2000;
        const DistanceReport distance = measure_distance(before, mesh, options);
        // Split points are rounded.
        const double rounding = frame.length(0x1p-50 * frame.largest);
        EXPECT_LE(distance.hausdorff.value, report.max_deviation + rounding);
        EXPECT_EQ(std::memcmp(before.points().data(), mesh.points().data(), before.points().size_bytes()), 0);
    }
}

TEST_P(Flat, SameBitsWhateverTheThreadsAndTheScale) {
    if (GetParam().has_zero_area || GetParam().extreme_scale) GTEST_SKIP() << "covered by the other families";
    Mesh one(GetParam().soup);
    Mesh many(GetParam().soup);
    PolygonSoup soup = GetParam().soup;
    for (Vec3& p : soup.points) p = 0x1p-500 * p;
    Mesh small(soup);
    const Context single({}, 1);
    const Context four({}, 4);
    RemeshOptions options = within({FlatRule::given, 1e-4});
    make_delaunay(one, options, &single);
    make_delaunay(many, options, &four);
    options.shell_unit_abs = 0x1p-500;
    make_delaunay(small, options, &single);
    ASSERT_EQ(one.vertex_count(), many.vertex_count());
    EXPECT_EQ(std::memcmp(one.points().data(), many.points().data(), one.points().size_bytes()), 0);
    ASSERT_EQ(one.face_count(), small.face_count());
    EXPECT_EQ(std::memcmp(one.corners().data(), many.corners().data(), one.corners().size_bytes()), 0);
    EXPECT_EQ(std::memcmp(one.corners().data(), small.corners().data(), one.corners().size_bytes()), 0);
}

INSTANTIATE_TEST_SUITE_P(Families, Flat, testing::ValuesIn(test::families(150)), [](const auto& named) {
    std::string name = named.param.name;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
});

TEST(FlatTolerance, IsRefusedOutOfRange) {
    Mesh mesh(make_sample("grid", 20));
    for (const double tolerance : {-1e-9, 0.011, std::nan("")})
        EXPECT_THROW(make_delaunay(mesh, within({FlatRule::given, tolerance})), Error);
}

TEST(Growth, IsToldBeforeTheFirstSplit) {
    for (const SplitPlacement placement : {SplitPlacement::shells, SplitPlacement::fewest}) {
        Mesh mesh(rounded_box(5, Stored::floats));
        const std::size_t vertices = mesh.vertex_count();
        RemeshOptions options = within({});
        options.placement = placement;
        options.effort = 0;
        std::vector<GrowthEstimate> told;
        options.on_growth = [&](const GrowthEstimate& growth) { told.push_back(growth); };
        const RemeshReport report = make_delaunay(mesh, options);
        ASSERT_FALSE(told.empty());
        EXPECT_EQ(told[0].vertices, vertices);
        EXPECT_EQ(told[0].lower_bound, report.lower_bound);
        EXPECT_EQ(told[0].lower_bound_if_flat, 0u);
        EXPECT_EQ(told[0].sharp_edges, 0u);
        EXPECT_GE(told[0].likely_splits, report.lower_bound);
    }
}

/// Patches of a needle that rounding could have made, a face across its long side, at any angle, and two beside that
/// one.
Mesh needles_by_rounding(std::size_t count) {
    PolygonSoup soup;
    test::Random random(5);
    for (std::size_t i = 0; i < count; ++i) {
        const auto base = static_cast<std::uint32_t>(soup.points.size());
        const double slope = 0.25 * random.unit();
        const double depth = random.unit();
        const Vec3 at = round_to_float({random.unit(), random.unit(), random.unit()});
        const Vec3 end = round_to_float(at + Vec3{1, slope, 0});
        const Vec3 middle = round_to_float(at + (end - at) * (0.4 + 0.2 * random.unit()) + Vec3{0, 0, 0x1p-22});
        const Vec3 below = round_to_float(at + Vec3{0.5, -0.7, -depth});
        const Vec3 left = round_to_float(at + Vec3{-0.3, -0.8, -depth});
        const Vec3 right = round_to_float(end + Vec3{0.3, -0.8 - slope, -depth});
        soup.points.insert(soup.points.end(), {at, end, middle, below, left, right});
        for (const std::uint32_t corner : {0, 1, 2, 1, 0, 3, 3, 0, 4, 1, 3, 5}) soup.corners.push_back(base + corner);
    }
    return Mesh(soup);
}

/// Each needle takes one flip, and the surface moves no farther than it is told.
void expect_needles_flipped(const Mesh& before, const RemeshOptions& options, std::size_t needles) {
    Mesh mesh = before;
    const RemeshReport report = make_delaunay(mesh, options);
    EXPECT_EQ(report.stop, StopReason::done);
    EXPECT_EQ(report.splits, 0u);
    EXPECT_EQ(report.flips, needles);
    EXPECT_GT(report.max_deviation, 0);
    EXPECT_LE(report.max_deviation, report.flat_tolerance);
    EXPECT_LE(measure_distance(before, mesh).hausdorff.value, report.max_deviation);
    EXPECT_EQ(check_delaunay(mesh), "");
    EXPECT_EQ(validate(mesh), "");
}

TEST(FlatTolerance, ByDefaultModeFeatureLosesTheNeedlesThatStopIt) {
    const Mesh before = needles_by_rounding(30);
    RemeshOptions options;
    options.mode = RemeshMode::feature;
    options.max_vertices = before.vertex_count();
    options.flat_tolerance_rel = {FlatRule::given, 0};
    Mesh stopped = before;
    EXPECT_EQ(make_delaunay(stopped, options).stop, StopReason::max_vertices);
    options.flat_tolerance_rel = {};
    expect_needles_flipped(before, options, 30);
    // What the user has listed stays, whatever the cost.
    options.feature_edges = {{VertexId(0u), VertexId(1u)}};
    Mesh listed = before;
    EXPECT_EQ(make_delaunay(listed, options).stop, StopReason::max_vertices);
    EXPECT_EQ(listed.face_count(), before.face_count()) << "what there is, is handed over";
    // Where the run does not stop short, nothing moves.
    options.feature_edges = {};
    options.max_vertices = 0;
    Mesh whole = before;
    const RemeshReport exact = make_delaunay(whole, options);
    EXPECT_EQ(exact.stop, StopReason::done);
    EXPECT_GE(exact.splits, 30u);
    EXPECT_EQ(exact.max_deviation, 0);
    EXPECT_EQ(exact.flat_tolerance, 0);
}

TEST(FlatTolerance, ModeFeatureSplitsNoNeedlesByTheThousand) {
    const Mesh before = needles_by_rounding(1010);
    RemeshOptions options;
    options.mode = RemeshMode::feature;
    options.effort = 0;
    expect_needles_flipped(before, options, 1010);
    options.flat_tolerance_rel = {FlatRule::given, 0};
    Mesh exact = before;
    EXPECT_GE(make_delaunay(exact, options).splits, 1010u);
}

/// A sheet with a crease along x, in which two faces, lower than rounding explains, lie on each other: a flip of their
/// edge leaves a face without area, as p, u and v are on one line.
PolygonSoup doubled_caps() {
    constexpr double low = 0x1p-28;
    const Vec3 p{0, 0, 0}, q{1, 0, 0}, u{0.5, low, 0}, v{0.625, 1.25 * low, 0};
    PolygonSoup soup;
    soup.points = {p, q, u, v, {0.25, 0.75, -0.25}, {0.75, 0.75, -0.25}, {0.25, -0.75, -0.25}, {0.875, -0.75, -0.25}};
    soup.corners = {0, 1, 2, 1, 0, 3, 0, 2, 4, 2, 5, 4, 2, 1, 5, 3, 0, 6, 3, 6, 7, 3, 7, 1};
    return soup;
}

TEST(FlatTolerance, ModeFeatureFlipsCapsAgainWhereTheirFlipsWereInTheWay) {
    PolygonSoup soup = doubled_caps();
    const Mesh needles = needles_by_rounding(30);
    for (const VertexId corner : needles.corners())
        soup.corners.push_back(static_cast<std::uint32_t>(soup.points.size()) + corner.value());
    soup.points.insert(soup.points.end(), needles.points().begin(), needles.points().end());
    const Mesh before{PolygonSoup(soup)};
    Mesh mesh = before;
    RemeshOptions options;
    options.mode = RemeshMode::feature;
    options.effort = 0;
    options.max_vertices = before.vertex_count();
    const RemeshReport report = make_delaunay(mesh, options);
    EXPECT_EQ(report.stop, StopReason::done);
    EXPECT_EQ(check_delaunay(mesh), "");
    EXPECT_EQ(validate(mesh), "");
    EXPECT_GT(report.max_deviation, 0);
    EXPECT_LE(report.max_deviation, report.flat_tolerance);
    EXPECT_LE(measure_distance(before, mesh).hausdorff.value, report.max_deviation);
}

/// A triangle of height h over its side along x, and a proper one on the other side.
Mesh cap_over(double length, double at, double height, double beyond) {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {length, 0, 0}, {at, height, 0}, {at, -beyond, -beyond}};
    soup.corners = {0, 1, 2, 1, 0, 3};
    return Mesh(soup);
}

TEST(HeightAbove, IsNeverTooSmallAndHardlyTooLarge) {
    test::Random random(11);
    for (int i = 0; i < 2000; ++i) {
        const double height = std::ldexp(1 + random.unit(), -random.below(60));
        const Mesh mesh = cap_over(1 + random.unit(), 0.2 + 0.6 * random.unit(), height, 1);
        const UnitFrame frame = unit_frame(mesh);
        const double bound = frame.length(height_above(mesh, frame, HalfedgeId(0u)));
        EXPECT_GE(bound, height);
        EXPECT_LE(bound, height * (1 + 1e-9));
    }
}

TEST(FlatCaps, GoToTheFacetAcrossTheirLongSide) {
    Mesh mesh = cap_over(3, 1.25, 1e-9, 1);
    const UnitFrame frame = unit_frame(mesh);
    EXPECT_EQ(flip_flat_caps(mesh, frame, std::ldexp(1e-10, frame.exponent), nullptr).flips, 0u);
    const FlatCaps caps = flip_flat_caps(mesh, frame, std::ldexp(1e-8, frame.exponent), nullptr);
    EXPECT_EQ(caps.flips, 1u);
    EXPECT_NEAR(frame.length(caps.moved), 1e-9, 1e-15);
    EXPECT_TRUE(mesh.are_joined(VertexId(2u), VertexId(3u)));
    EXPECT_EQ(validate(mesh), "");
}

TEST(FlatCaps, OfMarkedMeshesMayPassFacesWithoutArea) {
    Mesh mesh{doubled_caps()};
    const UnitFrame frame = unit_frame(mesh);
    const double allowed = std::ldexp(1e-6, frame.exponent);
    EXPECT_EQ(flip_flat_caps(mesh, frame, allowed, nullptr).flips, 0u);
    MarkedMesh marked(mesh, mark_features(mesh, 10, {}, nullptr), {});
    EXPECT_GT(flip_flat_caps(marked, frame, allowed, nullptr).flips, 0u);
    EXPECT_EQ(clean_up(marked, nullptr).changes, 0u);
    EXPECT_EQ(validate(mesh), "");
    // The crease goes where the caps were.
    for (const auto& [a, b] : {std::array{0u, 2u}, std::array{2u, 3u}, std::array{3u, 1u}}) {
        HalfedgeId h = mesh.find_halfedge(VertexId(a), VertexId(b));
        ASSERT_TRUE(h.valid()) << a << " " << b;
        EXPECT_FALSE(marked.is_planar(h)) << a << " " << b;
    }
}

TEST(SideAlong, IsTheSignOfTheAreaSeenAlongTheAxis) {
    const Vec3 a{1e-200, 0, 5}, b{0, 3e-200, -7}, c{0, 0, 1e300};
    EXPECT_EQ(side_along(2, c, a, b), Sign::positive);
    EXPECT_EQ(side_along(2, c, b, a), Sign::negative);
    EXPECT_EQ(side_along(2, {0, 0, 0}, {1, 1, 2}, {2, 2, 7}), Sign::zero);
    // One ulp beside the line.
    EXPECT_EQ(side_along(0, {0, 0, 0}, {9, 1, 1}, {3, 3, 3 + 0x1p-51}), Sign::positive);
}

}  // namespace
}  // namespace delmesh
