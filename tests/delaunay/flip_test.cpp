#include "delaunay/flip.hpp"

#include "delaunay/features.hpp"
#include "delaunay/flip_queue.hpp"
#include "delaunay/preserve_check.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/exact/predicates.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "delmesh/mesh/validate.hpp"
#include "support/families.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace delmesh {
namespace {

using test::check_delaunay;

RemeshOptions options_of(RemeshMode mode) {
    RemeshOptions options;
    options.effort = 0;
    options.mode = mode;
    options.max_vertices = 20000;
    return options;
}

Mesh mesh_of(std::vector<Vec3> points, std::vector<std::uint32_t> corners) {
    PolygonSoup soup;
    soup.points = std::move(points);
    soup.corners = std::move(corners);
    return Mesh(std::move(soup));
}

double area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5 * norm(cross(b - a, c - a));
}

double area(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const HalfedgeId h = Mesh::halfedge(FaceId(f));
        sum += area(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.apex(h)));
    }
    return sum;
}

long long euler(const Mesh& mesh) {
    const std::set<VertexId> used(mesh.corners().begin(), mesh.corners().end());
    return static_cast<long long>(used.size()) - static_cast<long long>(mesh.count_edges()) +
           static_cast<long long>(mesh.face_count());
}

bool same(const Mesh& a, const Mesh& b) {
    return std::equal(a.points().begin(), a.points().end(), b.points().begin(), b.points().end()) &&
           std::equal(a.corners().begin(), a.corners().end(), b.corners().begin(), b.corners().end());
}

Vec3 random_point(test::Random& random, double thickness) {
    const double x = random.unit();
    const double y = random.unit();
    return {x, y, thickness * random.unit()};
}

TEST(Theorem1, AFlipNeverAddsArea) {
    test::Random random(1);
    int flips = 0;
    for (int i = 0; i < 100000; ++i) {
        const double thickness = i % 3 == 0 ? 1.0 : i % 3 == 1 ? 1e-3 : 0.0;
        const Vec3 p = random_point(random, thickness);
        const Vec3 q = random_point(random, thickness);
        const Vec3 u = random_point(random, thickness);
        const Vec3 v = random_point(random, thickness);
        if (delaunay_sign(p, q, u, v) != Sign::negative) continue;
        ++flips;
        const double before = area(p, q, u) + area(q, p, v);
        const double after = area(u, v, q) + area(v, u, p);
        // The two areas are sums of square roots: each is off by a few ulps of its terms.
        ASSERT_LE(after, before + 1e-14) << i;
        // Lemma 1: the opposing edge is Delaunay.
        ASSERT_NE(delaunay_sign(u, v, p, q), Sign::negative) << i;
    }
    EXPECT_GT(flips, 10000);
}

class Flip : public testing::TestWithParam<test::NamedSoup> {};

TEST_P(Flip, EveryModeAndOrderMakesADelaunayMesh) {
    const Mesh before(GetParam().soup);
    for (const RemeshMode mode : {RemeshMode::flip, RemeshMode::feature}) {
        for (const FlipOrder order : {FlipOrder::worst, FlipOrder::fifo, FlipOrder::lifo}) {
            for (const FlipFinish finish : {FlipFinish::keep_flipping, FlipFinish::literal}) {
                RemeshOptions options = options_of(mode);
                options.order = order;
                options.finish = finish;
                Mesh after = before;
                RemeshReport report;
                try {
                    report = make_delaunay(after, options);
                } catch (const Error& error) {
                    ASSERT_TRUE(GetParam().has_zero_area) << error.what();
                    return;
                }
                ASSERT_EQ(validate(after), "");
                EXPECT_EQ(euler(after), euler(before));
                EXPECT_EQ(after.vertex_count(), before.vertex_count() + report.splits);
                EXPECT_EQ(report.provenance.splits.size(), report.splits);
                if (report.stop == StopReason::done) {
                    EXPECT_EQ(check_delaunay(after), "");
                }
                if (!GetParam().extreme_scale) {
                    EXPECT_LE(area(after), area(before) * (1 + 1e-9));
                }
            }
        }
    }
}

TEST_P(Flip, NoFoldoverMakesNone) {
    RemeshOptions options = options_of(RemeshMode::flip);
    options.no_foldover = true;
    Mesh mesh(GetParam().soup);
    if (GetParam().has_zero_area) return;
    const RemeshReport report = make_delaunay(mesh, options);
    EXPECT_EQ(report.foldovers, 0u);
    EXPECT_EQ(validate(mesh), "");
    if (report.stop == StopReason::done) {
        EXPECT_EQ(check_delaunay(mesh), "");
    }
}

TEST_P(Flip, FeatureAnglesAtTheEndsAreTheOtherModes) {
    if (GetParam().has_zero_area) return;
    for (const auto& [angle, mode] : {std::pair{0.0, RemeshMode::preserve}, std::pair{180.0, RemeshMode::flip}}) {
        Mesh by_angle(GetParam().soup);
        Mesh by_mode(GetParam().soup);
        RemeshOptions options = options_of(RemeshMode::feature);
        options.feature_angle_deg = angle;
        make_delaunay(by_angle, options);
        make_delaunay(by_mode, options_of(mode));
        EXPECT_TRUE(same(by_angle, by_mode)) << angle;
    }
}

/// Features lie under chains of output edges, from end to end.
void expect_features_tiled(const Mesh& before, const RemeshOptions& options) {
    Mesh after = before;
    const RemeshReport report = make_delaunay(after, options);
    if (report.stop != StopReason::done) GTEST_SKIP() << "does not become Delaunay within the bound";
    EXPECT_EQ(check_delaunay(after), "");
    EXPECT_EQ(report.splits_boundary + report.splits_feature + report.splits_unflippable, report.splits);
    const std::vector<Mark> marks = mark_features(before, options.feature_angle_deg, options.feature_edges, nullptr);
    std::map<std::pair<VertexId, VertexId>, std::vector<std::pair<double, VertexId>>> chains;
    for (std::size_t i = 0; i < marks.size(); ++i) {
        const HalfedgeId h(i);
        if (marks[i] != Mark::physical || !before.names_edge(h)) continue;
        const auto [a, b] =
            std::pair{std::min(before.origin(h), before.target(h)), std::max(before.origin(h), before.target(h))};
        chains[{a, b}] = {{0.0, a}, {1.0, b}};
    }
    for (std::size_t i = 0; i < report.provenance.splits.size(); ++i) {
        const SplitPoint& split = report.provenance.splits[i];
        const auto found = chains.find({split.a, split.b});
        if (found != chains.end()) found->second.emplace_back(split.t, VertexId(report.provenance.input_vertices + i));
    }
    for (auto& [ends, chain] : chains) {
        std::sort(chain.begin(), chain.end());
        for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            EXPECT_TRUE(after.are_joined(chain[i].second, chain[i + 1].second))
                << ends.first.value() << "-" << ends.second.value();
    }
}

TEST_P(Flip, FeaturesAreTiledByEdgesOfTheOutput) {
    if (GetParam().has_zero_area) return;
    const Mesh before(GetParam().soup);
    for (const SplitPlacement placement : {SplitPlacement::shells, SplitPlacement::fewest}) {
        RemeshOptions options = options_of(RemeshMode::feature);
        options.placement = placement;
        expect_features_tiled(before, options);
        // Listed edges anywhere: on creases, inside plane facets, at the boundary.
        for (std::size_t i = 0; i < before.halfedge_count(); i += 7)
            options.feature_edges.push_back({before.origin(HalfedgeId(i)), before.target(HalfedgeId(i))});
        expect_features_tiled(before, options);
    }
}

/// Heights of few values over a grid: many edges are equally far from Delaunay.
Mesh steps(std::uint64_t seed) {
    PolygonSoup soup = make_sample("plate", 400);
    test::Random random(seed);
    for (Vec3& p : soup.points) p = {std::round(8 * p.x), std::round(8 * p.y), std::floor(3 * random.unit())};
    return Mesh(soup);
}

TEST(Features, FlipsAloneSplitNothing) {
    RemeshOptions options = options_of(RemeshMode::feature);
    options.finish = FlipFinish::literal;
    std::size_t flips = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        options.order = static_cast<FlipOrder>(seed % 3);
        Mesh mesh = steps(seed);
        MarkedMesh marked(mesh, mark_features(mesh, 60, {}, nullptr), {});
        RemeshReport report;
        flip_edges(marked, false, options, nullptr, report);
        flips += report.flips;
        ASSERT_EQ(report.splits, 0u) << seed;
    }
    EXPECT_GT(flips, 1000u);
}

TEST(Features, TheLimitOnVerticesHoldsForBothWays) {
    for (const RemeshMode mode : {RemeshMode::flip, RemeshMode::feature}) {
        for (const std::size_t more : {0, 1, 20}) {
            Mesh mesh(make_sample("spikes", 300));
            RemeshOptions options = options_of(mode);
            options.max_vertices = mesh.vertex_count() + more;
            EXPECT_EQ(make_delaunay(mesh, options).stop, StopReason::max_vertices);
            EXPECT_LE(mesh.vertex_count(), options.max_vertices);
            EXPECT_EQ(validate(mesh), "");
        }
    }
}

TEST(Features, TheSearchNeverSplitsMore) {
    for (const char* name : {"noisy-sphere", "terrain", "plate", "noisy-surface", "spikes"}) {
        for (const double angle : {1.0, 5.0, 20.0, 180.0}) {
            RemeshOptions options = options_of(RemeshMode::feature);
            options.feature_angle_deg = angle;
            Mesh few(make_sample(name, 300));
            Mesh many = few;
            const RemeshReport fewest = make_delaunay(few, options);
            options.placement = SplitPlacement::shells;
            const RemeshReport shells = make_delaunay(many, options);
            ASSERT_EQ(fewest.stop, StopReason::done);
            EXPECT_EQ(check_delaunay(few), "");
            EXPECT_LE(fewest.splits, shells.splits) << name << ' ' << angle;
            if (angle == 1.0 || std::string_view(name) == "spikes") {
                EXPECT_LT(fewest.splits, shells.splits) << name << ' ' << angle;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Families, Flip, testing::ValuesIn(test::families(120)), [](const auto& named) {
    std::string name = named.param.name;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
});

// --- Unflippable edges, section 4.3 of the paper: p, q far apart, u and v near the middle of pq, u and v joined ---

const std::vector<Vec3> flip_tet{{0, 2, 0}, {0, -2, 0}, {-0.6, 0, -0.1}, {0.6, 0, -0.1}};

TEST(Exposed, FourFacesIsATetrahedron) {
    Mesh mesh = mesh_of(flip_tet, {0, 1, 2, 1, 0, 3, 0, 2, 3, 1, 3, 2});
    const RemeshReport report = make_delaunay(mesh, options_of(RemeshMode::flip));
    EXPECT_EQ(report.exposed, (std::array<std::size_t, 3>{0, 0, 1}));
    EXPECT_GE(report.splits_unflippable, 1u);
    EXPECT_EQ(check_delaunay(mesh), "");
}

TEST(Exposed, ThreeFacesIsAThinFin) {
    std::vector<Vec3> points = flip_tet;
    points.push_back({0, -0.5, -2});
    Mesh mesh = mesh_of(points, {0, 1, 2, 1, 0, 3, 0, 2, 3, 1, 3, 4, 3, 2, 4, 2, 1, 4});
    const RemeshReport report = make_delaunay(mesh, options_of(RemeshMode::flip));
    EXPECT_EQ(report.exposed, (std::array<std::size_t, 3>{0, 1, 0}));
    EXPECT_EQ(check_delaunay(mesh), "");
}

TEST(Exposed, TwoFacesIsAPinchedTube) {
    std::vector<Vec3> points = flip_tet;
    points.push_back({0, 1, -1});
    points.push_back({0, -1, -1});
    Mesh mesh = mesh_of(points, {0, 1, 2, 1, 0, 3, 0, 2, 4, 3, 0, 4, 4, 2, 3, 2, 1, 5, 1, 3, 5, 2, 5, 3});
    const RemeshReport report = make_delaunay(mesh, options_of(RemeshMode::flip));
    EXPECT_EQ(report.exposed, (std::array<std::size_t, 3>{1, 0, 0}));
    EXPECT_EQ(check_delaunay(mesh), "");
}

// --- Fold-overs ---

TEST(Foldover, IsCountedAndCanBeForbidden) {
    // A flat dart: the reflex corner lies at q, so the flip turns one face over.
    Mesh free = mesh_of({{0, 4, 0}, {0, 0.1, 0}, {-1, 0, 0.02}, {1, 0, 0.02}}, {0, 2, 1, 0, 1, 3});
    const bool was_delaunay = check_delaunay(free).empty();
    Mesh kept = free;
    const RemeshReport counted = make_delaunay(free, options_of(RemeshMode::flip));
    RemeshOptions forbid = options_of(RemeshMode::flip);
    forbid.no_foldover = true;
    const RemeshReport forbidden = make_delaunay(kept, forbid);
    EXPECT_EQ(forbidden.foldovers, 0u);
    EXPECT_GE(counted.foldovers, forbidden.foldovers);
    EXPECT_FALSE(was_delaunay && counted.flips > 0);
    EXPECT_EQ(check_delaunay(kept), "");
}

// --- Features ---

TEST(Features, CosineOfDegreesIsExactWhereItCanBe) {
    EXPECT_EQ(cosine_of_degrees(0), 1.0);
    EXPECT_EQ(cosine_of_degrees(60), 0.5);
    EXPECT_EQ(cosine_of_degrees(90), 0.0);
    EXPECT_EQ(cosine_of_degrees(120), -0.5);
    EXPECT_EQ(cosine_of_degrees(180), -1.0);
    for (double angle = 0.1; angle < 180; angle += 0.37)
        EXPECT_NEAR(cosine_of_degrees(angle), std::cos(angle * 3.14159265358979323846 / 180), 5e-16) << angle;
}

TEST(Features, ListedEdgesAreKept) {
    // A square with the wrong diagonal bent a little: the diagonal flips, unless it is listed.
    const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {2, 1, 0.01}, {2, -1, 0.01}};
    const std::vector<std::uint32_t> corners{0, 1, 2, 1, 0, 3};
    Mesh flipped = mesh_of(points, corners);
    EXPECT_EQ(make_delaunay(flipped, options_of(RemeshMode::feature)).flips, 1u);
    Mesh kept = mesh_of(points, corners);
    RemeshOptions options = options_of(RemeshMode::feature);
    options.feature_edges = {{VertexId(1), VertexId(0)}};
    const RemeshReport report = make_delaunay(kept, options);
    EXPECT_GE(report.splits_feature, 1u);
    EXPECT_EQ(check_delaunay(kept), "");
    options.feature_edges = {{VertexId(2), VertexId(3)}};
    EXPECT_THROW(make_delaunay(kept, options), Error);
    options.feature_edges = {{VertexId(2), VertexId(99)}};
    EXPECT_THROW(make_delaunay(kept, options), Error);
}

TEST(Features, ThresholdIsExact) {
    // A right-angled fold, turned so that nothing is aligned with the axes, deviates by exactly 90 degrees: not by
    // more.
    const Mesh mesh = mesh_of({{0, 0, 0}, {1, 2, 2}, {2, 1, -2}, {2, -2, 1}}, {0, 1, 2, 1, 0, 3});
    EXPECT_EQ(mark_features(mesh, 90, {}, nullptr)[0], Mark::planar);
    EXPECT_EQ(mark_features(mesh, 89.999999999999, {}, nullptr)[0], Mark::physical);
}

// --- The queue ---

TEST(FlipQueue, WorstFirstOfEqualsTheFirstComer) {
    FlipQueue queue(FlipOrder::worst);
    for (const FlipQueue::Entry entry : {FlipQueue::Entry{HalfedgeId(5), 10}, {HalfedgeId(2), 10}, {HalfedgeId(9), 30}})
        queue.push(entry);
    EXPECT_EQ(queue.pop().h.value(), 9u);
    EXPECT_EQ(queue.pop().h.value(), 5u);
    queue.push({HalfedgeId(1), most_urgent});
    queue.push({HalfedgeId(7), 0});
    EXPECT_EQ(queue.size(), 3u);
    for (const std::uint32_t next : {1u, 2u, 7u}) EXPECT_EQ(queue.pop().h.value(), next);
    EXPECT_TRUE(queue.empty());
}

TEST(FlipQueue, WorstFirstAsASortDoes) {
    FlipQueue queue(FlipOrder::worst);
    std::vector<FlipQueue::Entry> entries;
    for (std::uint32_t i = 0; i < 30000; ++i) entries.push_back({HalfedgeId(i), i * 7919 % 3 * (i % 85)});
    for (const FlipQueue::Entry& entry : entries) queue.push(entry);
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a.urgency > b.urgency; });
    for (const FlipQueue::Entry& entry : entries) {
        const HalfedgeId foreseen = queue.upcoming(0);
        ASSERT_TRUE(!foreseen.valid() || foreseen == entry.h);
        const auto [h, urgency] = queue.pop();
        ASSERT_EQ(h, entry.h);
        ASSERT_EQ(urgency, entry.urgency);
    }
}

TEST(FlipQueue, FirstInFirstOutAndTheReverse) {
    for (const FlipOrder order : {FlipOrder::fifo, FlipOrder::lifo}) {
        FlipQueue queue(order);
        for (std::uint32_t i = 0; i < 20000; ++i) queue.push({HalfedgeId(i), 20000 - i});
        for (std::uint32_t i = 0; i < 20000; ++i)
            ASSERT_EQ(queue.pop().h.value(), order == FlipOrder::fifo ? i : 19999 - i);
        EXPECT_TRUE(queue.empty());
    }
}

TEST(Urgency, GrowsWithTheAngleSumAtAnyScale) {
    std::uint32_t last = 0;
    for (double height = 0.9; height > 0.06; height *= 0.8) {
        for (const double scale : {1.0, 0x1p-900, 0x1p900}) {
            const Mesh mesh = mesh_of({{-scale, 0, 0}, {scale, 0, 0}, {0, height * scale, 0}, {0, -height * scale, 0}},
                                      {0, 1, 2, 1, 0, 3});
            const std::uint32_t now = urgency(mesh, HalfedgeId(0));
            if (scale == 1.0) {
                EXPECT_GT(now, last);
                last = now;
            }
            EXPECT_EQ(now, last);
        }
    }
}

}  // namespace
}  // namespace delmesh
