#include "delmesh/delaunay/remesh.hpp"

#include "delaunay/preserve_check.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/exact/predicates.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "delmesh/mesh/validate.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace delmesh {
namespace {

using test::check_delaunay;
using test::check_preserved;

/// Algorithm 1 as published; fewest_test.cpp is about the other placement.
RemeshOptions by_shells() {
    RemeshOptions options;
    options.placement = SplitPlacement::shells;
    return options;
}

/// Growth is finite but can be large: the needles of some families stop here.
RemeshOptions bounded() {
    RemeshOptions options = by_shells();
    options.max_vertices = 40000;
    return options;
}

bool same_bits(const Mesh& a, const Mesh& b) {
    return a.vertex_count() == b.vertex_count() && a.face_count() == b.face_count() &&
           std::memcmp(a.points().data(), b.points().data(), a.points().size_bytes()) == 0 &&
           std::memcmp(a.corners().data(), b.corners().data(), a.corners().size_bytes()) == 0;
}

class Preserve : public testing::TestWithParam<test::NamedSoup> {};

TEST_P(Preserve, MakesADelaunayMeshOfTheSameSurface) {
    const Mesh before(GetParam().soup);
    Mesh after = before;
    RemeshReport report;
    try {
        report = make_delaunay(after, bounded());
    } catch (const Error& error) {
        ASSERT_TRUE(GetParam().has_zero_area) << error.what();
        return;
    }
    ASSERT_EQ(validate(after), "");
    if (report.stop == StopReason::done) {
        EXPECT_EQ(check_delaunay(after), "");
    } else {
        // Whatever stopped the run: the mesh is whole and the witness is an edge that still fails.
        ASSERT_TRUE(report.witness.has_value());
        EXPECT_NE(check_delaunay(after), "");
    }
    EXPECT_GE(report.splits + (report.stop == StopReason::done ? 0 : report.lower_bound), report.lower_bound);
    EXPECT_EQ(after.vertex_count(), before.vertex_count() + report.splits);
    if (GetParam().has_zero_area) return;
    EXPECT_EQ(check_preserved(before, after, report.provenance, GetParam().extreme_scale ? 1e-9 : 1e-13), "");
}

TEST_P(Preserve, SameBitsWhateverTheThreads) {
    if (GetParam().has_zero_area) GTEST_SKIP() << "covered by the other families";
    Mesh one(GetParam().soup);
    Mesh many(GetParam().soup);
    const Context single({}, 1);
    const Context four({}, 4);
    const RemeshReport a = make_delaunay(one, bounded(), &single);
    const RemeshReport b = make_delaunay(many, bounded(), &four);
    EXPECT_TRUE(same_bits(one, many));
    EXPECT_EQ(a.flips, b.flips);
    EXPECT_EQ(a.provenance.facet_of_face, b.provenance.facet_of_face);
}

TEST_P(Preserve, DelaunayMeshesAreLeftAlone) {
    Mesh mesh(GetParam().soup);
    if (GetParam().has_zero_area || make_delaunay(mesh, bounded()).stop != StopReason::done)
        GTEST_SKIP() << "does not become Delaunay within the bound";
    const Mesh once = mesh;
    const RemeshReport report = make_delaunay(mesh, by_shells());
    EXPECT_EQ(report.flips, 0u);
    EXPECT_EQ(report.splits, 0u);
    EXPECT_TRUE(same_bits(once, mesh));
}

TEST_P(Preserve, FloatPrecisionGivesFloats) {
    PolygonSoup soup = GetParam().soup;
    if (GetParam().has_zero_area || GetParam().extreme_scale) GTEST_SKIP() << "floats can not hold this family";
    round_to_float(soup);
    Mesh mesh(soup);
    RemeshOptions options = bounded();
    options.precision = Precision::float32;
    RemeshReport report;
    try {
        report = make_delaunay(mesh, options);
    } catch (const Error& error) {
        // Rounding may have merged points or flattened faces.
        EXPECT_TRUE(error.code() == ErrorCode::zero_length_edge || error.code() == ErrorCode::degenerate_geometry)
            << error.what();
        return;
    }
    ASSERT_EQ(validate(mesh), "");
    for (const Vec3& p : mesh.points()) ASSERT_EQ(round_to_float(p), p);
    if (report.stop == StopReason::done) {
        EXPECT_EQ(check_delaunay(mesh), "");
    }
}

INSTANTIATE_TEST_SUITE_P(Families, Preserve, testing::ValuesIn(test::families(300)), [](const auto& named) {
    std::string name = named.param.name;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
});

Mesh mesh_of(std::vector<Vec3> points, std::vector<std::uint32_t> corners) {
    PolygonSoup soup;
    soup.points = std::move(points);
    soup.corners = std::move(corners);
    return Mesh(std::move(soup));
}

// --- The pitfalls of the prototypes, one by one ---

TEST(Pitfalls, ToleranceWouldLeaveEdgesThatAreBarelyNotDelaunay) {
    // The fourth point lies one ulp inside the circle through the others: only exact signs see it.
    const double inside = std::nextafter(1.0, 0.0);
    Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, inside, 0}, {0, 1, 0}}, {0, 1, 3, 1, 2, 3});
    const bool was_delaunay = check_delaunay(mesh).empty();
    make_delaunay(mesh, by_shells());
    EXPECT_FALSE(was_delaunay);
    EXPECT_EQ(check_delaunay(mesh), "");
}

TEST(Pitfalls, CocircularEdgesStay) {
    // Exactly pi is Delaunay: a lattice must not change, in any of its triangulations.
    PolygonSoup soup = make_sample("grid", 200);
    test::flip_at_random(soup, 0, 1);
    Mesh mesh(soup);
    const RemeshReport report = make_delaunay(mesh, by_shells());
    EXPECT_EQ(report.flips + report.splits, 0u);
}

TEST(Pitfalls, CapsAreFlippedAwayOnBothSides) {
    // Two caps back to back in the middle of a square: the long edge has a flat face on either side.
    Mesh mesh = mesh_of({{0, 0, 0}, {4, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 3, 0}, {2, -3, 0}},
                        {0, 1, 2, 1, 0, 3, 2, 1, 4, 0, 2, 4, 3, 0, 5, 1, 3, 5});
    const std::size_t faces = mesh.face_count();
    const RemeshReport report = make_delaunay(mesh, by_shells());
    EXPECT_EQ(report.stop, StopReason::done);
    EXPECT_GE(mesh.face_count(), faces);
    EXPECT_EQ(check_delaunay(mesh), "");
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const HalfedgeId h = Mesh::halfedge(FaceId(f));
        EXPECT_FALSE(are_collinear(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.apex(h))));
    }
}

TEST(Pitfalls, ACapAtTheBoundaryIsTakenOff) {
    Mesh mesh = mesh_of({{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {2, 3, 0}}, {0, 1, 2, 2, 1, 3, 0, 2, 3});
    const RemeshReport report = make_delaunay(mesh, by_shells());
    EXPECT_EQ(report.stop, StopReason::done);
    EXPECT_EQ(mesh.face_count(), 2u);
    EXPECT_EQ(validate(mesh), "");
}

TEST(Pitfalls, ZeroLengthEdgesPointToRepair) {
    Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3});
    const Mesh before = mesh;
    try {
        make_delaunay(mesh, by_shells());
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::zero_length_edge);
        EXPECT_EQ(error.elements(), (std::vector<std::size_t>{1, 2}));
        EXPECT_NE(std::string(error.what()).find("repair"), std::string::npos);
    }
    EXPECT_TRUE(same_bits(before, mesh));
}

TEST(Pitfalls, GrowthIsBoundedOnRequest) {
    Mesh mesh(make_sample("stretched-sphere", 320));
    RemeshOptions options = by_shells();
    options.max_vertices = mesh.vertex_count() + 5;
    const RemeshReport report = make_delaunay(mesh, options);
    EXPECT_EQ(report.stop, StopReason::max_vertices);
    EXPECT_EQ(mesh.vertex_count(), options.max_vertices);
    EXPECT_TRUE(report.witness.has_value());
    EXPECT_EQ(validate(mesh), "");
}

TEST(Pitfalls, ADoubleCoveredTriangleIsPartedFirst) {
    // A split of the long edge alone would join the new vertex to the apex twice.
    Mesh mesh = mesh_of({{0, 0, 0}, {4, 0, 0}, {2, 1, 0}}, {0, 1, 2, 1, 0, 2});
    const RemeshReport report = make_delaunay(mesh, bounded());
    EXPECT_EQ(validate(mesh), "");
    EXPECT_NE(report.stop, StopReason::max_vertices);
    if (report.stop == StopReason::done) {
        EXPECT_EQ(check_delaunay(mesh), "");
    }
}

TEST(Pitfalls, CoplanarFoldOversArePhysical) {
    // Both faces in a plane and on the same side of their edge: flipping would change the surface.
    const Mesh before = mesh_of({{0, 0, 0}, {4, 0, 0}, {2, 1, 0}, {2, 0.5, 0}}, {0, 1, 2, 1, 0, 3});
    Mesh after = before;
    const RemeshReport report = make_delaunay(after, by_shells());
    EXPECT_EQ(report.stop, StopReason::done);
    EXPECT_GT(report.splits, 0u);
    EXPECT_EQ(check_preserved(before, after, report.provenance, 1e-14), "");
}

TEST(Pitfalls, TiesBetweenShellsAreSettledByRule) {
    // Length 3 * 2^k: the shells at one and at two thirds are equally near to the middle. The nearer to the end wins.
    Mesh mesh = mesh_of({{0, 0, 0}, {3, 0, 0}, {1.5, 0.5, 0}}, {0, 1, 2});
    const RemeshReport report = make_delaunay(mesh, by_shells());
    ASSERT_FALSE(report.provenance.splits.empty());
    EXPECT_EQ(mesh.points()[3], (Vec3{1, 0, 0}));
}

/// Runs on the mesh as it is and scaled by powers of two, with the unit of the shells scaled along.
void expect_same_at_any_scale(const char* sample, std::size_t faces, RemeshOptions options) {
    const PolygonSoup soup = make_sample(sample, faces);
    Mesh plain(soup);
    const RemeshReport expected = make_delaunay(plain, options);
    ASSERT_GT(expected.flips + expected.splits, 0u);
    for (const int exponent : {-900, -300, 300, 900}) {
        PolygonSoup scaled = soup;
        for (Vec3& p : scaled.points)
            p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
        Mesh mesh(scaled);
        options.shell_unit_abs = std::ldexp(1.0, exponent);
        const RemeshReport report = make_delaunay(mesh, options);
        EXPECT_EQ(report.flips, expected.flips);
        EXPECT_EQ(report.splits, expected.splits);
        EXPECT_TRUE(
            std::equal(mesh.corners().begin(), mesh.corners().end(), plain.corners().begin(), plain.corners().end()))
            << sample << ' ' << exponent;
        EXPECT_EQ(check_delaunay(mesh), "");
    }
}

TEST(Pitfalls, SquaredLengthsNeitherOverflowNorUnderflow) {
    expect_same_at_any_scale("torus", 200, bounded());
    RemeshOptions options;
    options.effort = 0;
    expect_same_at_any_scale("plate", 150, options);
    for (const RemeshMode mode : {RemeshMode::flip, RemeshMode::feature}) {
        options.mode = mode;
        expect_same_at_any_scale("plate", 300, options);
        expect_same_at_any_scale("spikes", 150, options);
    }
}

TEST(Pitfalls, RightAnglesAtTheBoundaryAreDelaunay) {
    Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2});
    EXPECT_EQ(make_delaunay(mesh, by_shells()).splits, 0u);
}

TEST(Pitfalls, IsolatedVerticesKeepTheirPlace) {
    Mesh mesh = mesh_of({{9, 9, 9}, {0, 0, 0}, {4, 0, 0}, {8, 8, 8}, {2, 1, 0}}, {1, 2, 4});
    make_delaunay(mesh, by_shells());
    EXPECT_EQ(mesh.points()[0], (Vec3{9, 9, 9}));
    EXPECT_EQ(mesh.points()[3], (Vec3{8, 8, 8}));
    EXPECT_EQ(check_delaunay(mesh), "");
}

TEST(Remesh, SplitsLieOnShellsAboutAnInputVertex) {
    Mesh mesh(make_sample("saddle", 200));
    const RemeshReport report = make_delaunay(mesh, by_shells());
    ASSERT_GT(report.splits, 0u);
    std::size_t on_shell = 0;
    for (const SplitPoint& split : report.provenance.splits) {
        const double length = norm(mesh.point(split.b) - mesh.point(split.a));
        for (const double distance : {split.t * length, (1 - split.t) * length}) {
            const double k = std::log2(distance);
            if (std::fabs(k - std::round(k)) < 1e-9) {
                ++on_shell;
                break;
            }
        }
    }
    // Parts between two split vertices are measured from one of these instead.
    EXPECT_GT(on_shell, report.splits / 2);
}

TEST(Remesh, CoordinatesThatCanNotBeSplitStopTheRun) {
    // An obtuse triangle a few denormals wide: no double lies between the ends of its long edge at the shells.
    const double tiny = 5e-324;
    Mesh mesh = mesh_of({{0, 0, 0}, {3 * tiny, 0, 0}, {tiny, tiny, 0}}, {0, 1, 2});
    RemeshOptions options = by_shells();
    const RemeshReport report = make_delaunay(mesh, options);
    EXPECT_EQ(validate(mesh), "");
    if (report.stop == StopReason::done) {
        EXPECT_EQ(check_delaunay(mesh), "");
    } else {
        EXPECT_EQ(report.stop, StopReason::unresolved);
        EXPECT_TRUE(report.witness.has_value());
    }
}

TEST(Remesh, CancellingAtAnyStepLeavesAValidMesh) {
    for (const double when : {0.0, 0.01, 0.5}) {
        Mesh mesh(make_sample("noisy-surface", 20000));
        Context* running = nullptr;
        Context context([&](std::string_view phase, double fraction) {
            if (phase == "remesh" && fraction >= when) running->cancel();
        });
        running = &context;
        const RemeshReport report = make_delaunay(mesh, by_shells(), &context);
        EXPECT_EQ(report.stop, StopReason::cancelled) << when;
        EXPECT_EQ(validate(mesh), "");
        EXPECT_NE(check_delaunay(mesh), "");
    }
}

TEST(Remesh, RefusesOptionsOutOfRange) {
    Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2});
    for (const double unit : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
        RemeshOptions options = by_shells();
        options.shell_unit_abs = unit;
        EXPECT_THROW(make_delaunay(mesh, options), Error) << unit;
    }
    Mesh doubles = mesh_of({{0, 0, 0}, {1, 0, 0}, {0.1, 1, 0}}, {0, 1, 2});
    RemeshOptions options = by_shells();
    options.precision = Precision::float32;
    EXPECT_THROW(make_delaunay(doubles, options), Error);
}

TEST(Remesh, AnEmptyMeshIsDelaunay) {
    Mesh mesh;
    EXPECT_EQ(make_delaunay(mesh, by_shells()).stop, StopReason::done);
}

}  // namespace
}  // namespace delmesh
