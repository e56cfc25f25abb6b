#include "delmesh/simplify/simplify.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/measure/certificate.hpp"
#include "delmesh/measure/distance.hpp"
#include "delmesh/measure/statistics.hpp"
#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "delmesh/mesh/validate.hpp"
#include "simplify/decimator.hpp"
#include "support/families.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace delmesh {
namespace {

using test::SurfaceFacts;

/// What every result of simplifying must have in common with its input, and be.
void expect_sound(const Mesh& coarse, const SurfaceFacts& before, const std::string& what) {
    EXPECT_EQ(validate(coarse), "") << what;
    const SurfaceFacts after = test::examine(to_soup(coarse));
    EXPECT_EQ(after.fault, "") << what;
    EXPECT_EQ(after.euler, before.euler) << what;
    EXPECT_EQ(after.components, before.components) << what;
    EXPECT_EQ(after.boundary_loops, before.boundary_loops) << what;
    EXPECT_EQ(after.used_vertices, coarse.vertex_count()) << what;
    EXPECT_TRUE(certify(coarse).certified) << what;
}

SimplifyOptions to_vertices(std::size_t vertices) {
    SimplifyOptions options;
    options.vertices = vertices;
    return options;
}

Mesh sample(std::string_view name, std::size_t faces) {
    return Mesh(make_sample(name, faces));
}

TEST(Simplify, EveryFamilyKeepsItsTopologyAndIsDelaunayAtEveryLevel) {
    for (const test::NamedSoup& named : test::families(300)) {
        for (const Placement placement : {Placement::best, Placement::paper}) {
            Mesh mesh(named.soup);
            const SurfaceFacts before = test::examine(named.soup);
            SimplifyOptions options;
            options.placement = placement;
            options.remesh.max_vertices = 20000;
            const std::size_t n = mesh.vertex_count();
            options.levels = {std::max<std::size_t>(n / 2, 1), std::max<std::size_t>(n / 10, 1), 1};
            std::size_t calls = 0;
            options.on_level = [&](const Mesh& coarse, const LevelReport& level) {
                ++calls;
                EXPECT_EQ(coarse.vertex_count(), level.vertices) << named.name;
                expect_sound(coarse, before, named.name);
            };
            SimplifyReport report;
            try {
                report = simplify(mesh, options);
            } catch (const Error& error) {
                EXPECT_TRUE(named.has_zero_area || named.extreme_scale) << named.name << ": " << error.what();
                continue;
            }
            if (report.stop == SimplifyStop::not_delaunay) continue;
            EXPECT_EQ(calls, report.levels.size()) << named.name;
            EXPECT_NE(report.stop, SimplifyStop::cancelled) << named.name;
        }
    }
}

/// The exact conditions are checked from scratch after every single collapse.
TEST(Simplify, EverySingleCollapseLeavesADelaunayMesh) {
    for (const char* name : {"icosphere", "noisy-sphere", "torus", "terrain", "plate"}) {
        Mesh mesh = sample(name, 200);
        make_delaunay(mesh, SimplifyOptions::default_remesh());
        const SurfaceFacts before = test::examine(to_soup(mesh));
        Decimator decimator(mesh, Tuning{});
        for (std::size_t target = decimator.vertices(); target-- > 1;) {
            decimator.run(target);
            if (decimator.vertices() > target) break;
            Mesh copy = mesh;
            compact(copy);
            expect_sound(copy, before, std::string(name) + " at " + std::to_string(target));
            if (testing::Test::HasFailure()) return;
        }
        EXPECT_LT(decimator.vertices(), before.used_vertices / 2) << name;
    }
}

Mesh needles(std::size_t faces, double stretch) {
    Mesh mesh = sample("stretched-sphere", faces);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        Vec3 p = mesh.point(VertexId(v));
        p.z *= stretch;
        mesh.set_point(VertexId(v), p);
    }
    return mesh;
}

/// Needles that would need more points than allowed are collapsed before they get any.
TEST(Simplify, WhatNeedsTooManyPointsIsThinnedOutFirst) {
    Mesh mesh = needles(500, 32);
    const SurfaceFacts before = test::examine(to_soup(mesh));
    SimplifyOptions options = to_vertices(mesh.vertex_count() / 10);
    options.remesh.placement = SplitPlacement::shells;
    options.remesh.max_vertices = 10 * mesh.vertex_count();
    Mesh remeshed = mesh;
    ASSERT_EQ(make_delaunay(remeshed, options.remesh).stop, StopReason::max_vertices);
    Mesh again = mesh;

    const SimplifyReport report = simplify(mesh, options);
    EXPECT_EQ(report.stop, SimplifyStop::done);
    EXPECT_EQ(mesh.vertex_count(), options.vertices);
    EXPECT_EQ(report.thinned_to, 2 * options.vertices);
    EXPECT_LT(report.remesh->splits, options.remesh.max_vertices);
    expect_sound(mesh, before, "thinned");
    simplify(again, options);
    EXPECT_TRUE(std::ranges::equal(again.points(), mesh.points()));
}

/// Thinned out as ever, that would still need too many points.
TEST(Simplify, NeedlesInEachOthersWayAreMended) {
    Mesh mesh = needles(200, 1e5);
    for (const double ratio : {0.5, 0.1}) {
        Mesh copy = mesh;
        SimplifyOptions options;
        options.ratio = ratio;
        options.remesh.max_vertices = 3 * mesh.vertex_count();
        options.remesh.placement = SplitPlacement::shells;  // a search would take longer than all the rest
        const SimplifyReport report = simplify(copy, options);
        EXPECT_EQ(report.stop, SimplifyStop::done);
        EXPECT_LE(copy.vertex_count(), report.levels.back().target);
        EXPECT_EQ(report.remesh->splits, 0u);
        EXPECT_GT(report.thinned_to, 0u);
        expect_sound(copy, test::examine(to_soup(mesh)), "mended");
    }
}

/// Each collapse around a vertex of so many faces would look at all samples.
TEST(Simplify, SamplesAreNotFollowedAroundHubs) {
    for (const std::size_t faces : {900, 1500}) {
        PolygonSoup cone;
        cone.points.push_back({0, 0, 1});
        for (std::size_t i = 0; i < faces; ++i) {
            const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(faces);
            cone.points.push_back({std::cos(angle), std::sin(angle), 0});
        }
        for (std::size_t i = 0; i < faces; ++i)
            cone.add_face(std::array<std::uint32_t, 3>{0, static_cast<std::uint32_t>(1 + i),
                                                       static_cast<std::uint32_t>(1 + (i + 1) % faces)});
        Mesh mesh(cone);
        const SurfaceFacts before = test::examine(cone);
        const SimplifyReport report = simplify(mesh, to_vertices(60));
        EXPECT_EQ(report.stop, SimplifyStop::done);
        EXPECT_EQ(mesh.vertex_count(), 60u);
        EXPECT_EQ(report.moves == 0, faces > 1000) << faces;
        expect_sound(mesh, before, "cone");
    }
}

TEST(Simplify, NothingIsThinnedOutNorFlippedWiderWithoutNeed) {
    Mesh mesh = sample("noisy-sphere", 2000);
    const SimplifyReport report = simplify(mesh, to_vertices(100));
    ASSERT_TRUE(report.remesh.has_value());
    EXPECT_EQ(report.thinned_to, 0u);
    EXPECT_EQ(report.remesh_angle_deg, SimplifyOptions::default_remesh().feature_angle_deg);
}

/// Points on a large mesh would mostly be for vertices that vanish, and with all that is kept beside it, it would need
/// three times its room.
TEST(Simplify, ALargeMeshIsThinnedFirst) {
    const Mesh fine = sample("noisy-sphere", 410'000);
    ASSERT_GE(fine.vertex_count(), 200'000u);
    const std::size_t faults = certify(fine).non_delaunay_edges;
    Mesh mesh = fine;
    const SimplifyReport report = simplify(mesh, to_vertices(1000));
    EXPECT_EQ(report.stop, SimplifyStop::done);
    EXPECT_EQ(mesh.vertex_count(), 1000u);
    EXPECT_EQ(report.collapses, fine.vertex_count() + report.remesh->splits - 1000);
    EXPECT_LT(report.remesh->flips + report.remesh->splits, faults / 20) << "of a tenth of the vertices at most";
    EXPECT_EQ(report.thinned_to, 0u);
    expect_sound(mesh, test::examine(to_soup(fine)), "large");
    EXPECT_LT(measure_distance(fine, mesh, {.samples_per_face = 0.1}).mean.percent, 0.2);
}

/// In a plane points are not needed, and collapses before the flips would leave needles.
TEST(Simplify, ALargePlaneMeshIsMadeDelaunayFirst) {
    const Mesh fine = sample("jittered-grid", 405'000);
    ASSERT_GE(fine.vertex_count(), 200'000u);
    const std::size_t faults = certify(fine).non_delaunay_edges;
    Mesh mesh = fine;
    const SimplifyReport report = simplify(mesh, to_vertices(1000));
    EXPECT_EQ(mesh.vertex_count(), 1000u);
    EXPECT_GE(report.remesh->flips, faults / 2) << "of all vertices";
    EXPECT_EQ(report.remesh->splits, 0u);
    expect_sound(mesh, test::examine(to_soup(fine)), "large and plane");
    for (const Vec3& p : mesh.points()) EXPECT_EQ(p.z, fine.points()[0].z);
}

TEST(Simplify, ALargeDelaunayMeshStaysSo) {
    const Mesh fine = sample("icosphere", 500'000);
    ASSERT_GE(fine.vertex_count(), 200'000u);
    ASSERT_TRUE(certify(fine).certified);
    Mesh mesh = fine;
    const SimplifyReport report = simplify(mesh, to_vertices(300));
    EXPECT_FALSE(report.remesh.has_value());
    EXPECT_EQ(report.collapses, fine.vertex_count() - 300);
    expect_sound(mesh, test::examine(to_soup(fine)), "large and Delaunay");
    EXPECT_LT(measure_distance(fine, mesh, {.samples_per_face = 0.1}).mean.percent, 0.2);
}

TEST(Simplify, AClosedSphereGoesDownToATetrahedron) {
    Mesh mesh = sample("icosphere", 1000);
    const SimplifyReport report = simplify(mesh, to_vertices(1));
    EXPECT_EQ(mesh.vertex_count(), 4u);
    EXPECT_EQ(report.stop, SimplifyStop::blocked);
    EXPECT_GT(report.levels.back().blocked[static_cast<std::size_t>(Obstacle::topology)], 0u);
    EXPECT_EQ(report.levels.back().vertices, 4u);
}

/// Where all edges are blocked, the mesh is shaken until some are free.
TEST(Simplify, HandlesAndNeedlesDoNotHoldUpTargets) {
    struct Case {
        const char* name;
        std::size_t faces, target;
    };
    for (const Case& c : {Case{"thin-helix", 300, 15}, Case{"plate", 600, 45}, Case{"torus", 600, 8}}) {
        std::uint64_t bits = 0;
        for (int run = 0; run < 2; ++run) {
            Mesh mesh = sample(c.name, c.faces);
            const SurfaceFacts before = test::examine(to_soup(mesh));
            const SimplifyReport report = simplify(mesh, to_vertices(c.target));
            EXPECT_EQ(report.stop, SimplifyStop::done) << c.name;
            EXPECT_EQ(mesh.vertex_count(), c.target) << c.name;
            expect_sound(mesh, before, c.name);
            const std::uint64_t now = test::hash_bits(to_soup(mesh));
            EXPECT_EQ(run == 0 ? now : bits, now) << c.name;
            bits = now;
        }
    }
}

TEST(Simplify, NamesTheTopologicalLimit) {
    Mesh mesh = sample("torus", 600);
    const SimplifyReport report = simplify(mesh, to_vertices(3));
    EXPECT_EQ(report.least_vertices, 7u);
    EXPECT_EQ(report.stop, SimplifyStop::blocked);
    EXPECT_LE(mesh.vertex_count(), 9u);
    EXPECT_TRUE(certify(mesh).certified);
}

TEST(Simplify, TheSameInputGivesTheSameBits) {
    const auto run = [] {
        Mesh mesh = sample("torus", 2000);
        (void)simplify(mesh, to_vertices(100));
        return test::hash_bits(to_soup(mesh));
    };
    EXPECT_EQ(run(), run());
}

/// Scaling by a power of two changes no decision.
TEST(Simplify, ResultsScaleWithTheMesh) {
    const auto run = [](int exponent) {
        PolygonSoup soup = make_sample("torus", 1000);
        for (Vec3& p : soup.points)
            p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
        Mesh mesh(std::move(soup));
        (void)simplify(mesh, to_vertices(60));
        PolygonSoup out = to_soup(mesh);
        for (Vec3& p : out.points)
            p = {std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent), std::ldexp(p.z, -exponent)};
        return test::hash_bits(out);
    };
    EXPECT_EQ(run(0), run(40));
    EXPECT_EQ(run(0), run(-300));
}

TEST(Simplify, SeveralLevelsAreTheSameAsEachAlone) {
    Mesh one = sample("torus", 1500);
    Mesh two = one;
    SimplifyOptions options;
    options.refit = false;
    options.levels = {100, 300, 100};
    std::vector<std::size_t> seen;
    options.on_level = [&](const Mesh& mesh, const LevelReport&) { seen.push_back(mesh.vertex_count()); };
    (void)simplify(one, options);
    EXPECT_EQ(seen, (std::vector<std::size_t>{300, 100}));
    SimplifyOptions alone = to_vertices(100);
    alone.refit = false;
    (void)simplify(two, alone);
    EXPECT_EQ(test::hash_bits(to_soup(one)), test::hash_bits(to_soup(two)));
}

TEST(Simplify, AFlatGridKeepsItsOutline) {
    Mesh mesh = sample("grid", 800);
    const double diagonal = bounding_diagonal(mesh);
    (void)simplify(mesh, to_vertices(12));
    EXPECT_LE(mesh.vertex_count(), 12u);
    EXPECT_NEAR(bounding_diagonal(mesh), diagonal, 1e-5 * diagonal);
}

TEST(Simplify, AnErrorLimitStopsInTime) {
    Mesh mesh = sample("icosphere", 4000);
    const double diagonal = bounding_diagonal(mesh);
    SimplifyOptions options;
    options.max_quadric_error_rel = 1e-3;
    const SimplifyReport report = simplify(mesh, options);
    EXPECT_EQ(report.stop, SimplifyStop::error_limit);
    EXPECT_LE(report.levels.back().quadric_error, 1e-3 * diagonal);
    EXPECT_GT(report.levels.back().quadric_error, 2e-4 * diagonal);
    EXPECT_LT(mesh.vertex_count(), 1000u);
    EXPECT_GT(mesh.vertex_count(), 10u);
}

TEST(Simplify, FloatsStayFloats) {
    PolygonSoup soup = make_sample("torus", 1000);
    for (Vec3& p : soup.points) p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    Mesh mesh(std::move(soup));
    SimplifyOptions options = to_vertices(50);
    options.remesh.precision = Precision::float32;
    (void)simplify(mesh, options);
    EXPECT_EQ(mesh.vertex_count(), 50u);
    for (const Vec3& p : mesh.points()) EXPECT_EQ(static_cast<double>(static_cast<float>(p.x)), p.x);
    EXPECT_TRUE(certify(mesh).certified);
}

TEST(Simplify, APartOfASmallMeshIsAsLittleAsCanBe) {
    Mesh mesh = sample("icosphere", 20);
    SimplifyOptions tenth;
    tenth.ratio = 0.1;
    const SimplifyReport report = simplify(mesh, tenth);
    EXPECT_EQ(report.stop, SimplifyStop::done);
    EXPECT_EQ(mesh.vertex_count(), 4u);
    Mesh same = sample("icosphere", 20);
    EXPECT_EQ(simplify(same, to_vertices(1)).stop, SimplifyStop::blocked) << "a number is meant as it is given";
}

TEST(Simplify, RefusesWhatMakesNoSense) {
    const auto code = [](const SimplifyOptions& options) {
        Mesh mesh = sample("icosphere", 100);
        try {
            (void)simplify(mesh, options);
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::too_large;
    };
    SimplifyOptions both = to_vertices(10);
    both.ratio = 0.5;
    SimplifyOptions above;
    above.ratio = 1.5;
    SimplifyOptions zero;
    zero.levels = {10, 0};
    EXPECT_EQ(code({}), ErrorCode::bad_argument);
    EXPECT_EQ(code(both), ErrorCode::bad_argument);
    EXPECT_EQ(code(above), ErrorCode::bad_argument);
    EXPECT_EQ(code(zero), ErrorCode::bad_argument);
}

TEST(Simplify, NoiseIsNotPreservedBySplitsUnlessAskedFor) {
    const auto report_for = [](const Mesh& input, bool wider) {
        Mesh mesh = input;
        SimplifyOptions options = to_vertices(3000);
        options.wider_angle_on_noise = wider;
        return simplify(mesh, options);
    };
    const Mesh noise = sample("noisy-surface", 210'000);
    const SimplifyReport usual = report_for(noise, true);
    const SimplifyReport asked = report_for(noise, false);
    ASSERT_TRUE(usual.remesh && asked.remesh);
    EXPECT_EQ(usual.remesh_angle_deg, 30);
    EXPECT_EQ(asked.remesh_angle_deg, 15);
    EXPECT_LT(2 * usual.remesh->splits, asked.remesh->splits);
    // Few edges that are sharp may be creases.
    EXPECT_EQ(report_for(sample("noisy-surface", 20'000), true).remesh_angle_deg, 15);
}

TEST(Simplify, CancellingLeavesAValidMesh) {
    Mesh mesh = sample("icosphere", 20000);
    Context context;
    context.cancel();
    SimplifyReport report = simplify(mesh, to_vertices(10), &context);
    EXPECT_EQ(report.stop, SimplifyStop::cancelled);
    EXPECT_EQ(validate(mesh), "");
}

}  // namespace
}  // namespace delmesh
