// Surfaces that lie on themselves: two sheets of them may want an edge between the same two vertices.

#include "delaunay/sheets.hpp"

#include "base/random.hpp"
#include "delaunay/preserve_check.hpp"
#include "delaunay/refine.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/exact/predicates.hpp"
#include "delmesh/mesh/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace delmesh {
namespace {

/// Two triangles with the corners 0, 1, 2, one for each sheet, and one more beyond 0-1 in each. The first sheet joins
/// 2 to 3, so its flip would join 0 and 1, as the second one does. There the boundary at 4 leaves a single place for
/// a vertex between 0 and 1.
Mesh make_doubled_triangle() {
    PolygonSoup soup;
    soup.points = {{-1, 0, 0}, {1, 0, 0}, {0.25, 4, 0}, {0, -2, 0}, {0.25, -1.5, 0}};
    soup.corners = {2, 0, 3, 3, 1, 2, 1, 0, 2, 0, 1, 4};
    return Mesh(std::move(soup));
}

/// Planar are edges within a sheet.
MarkedMesh mark(Mesh& mesh) {
    std::vector<Mark> marks(mesh.halfedge_count(), Mark::physical);
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i)
        if (mesh.twin(HalfedgeId(i)).valid() && i / 6 == mesh.twin(HalfedgeId(i)).value() / 6) marks[i] = Mark::planar;
    return {mesh, std::move(marks), {}};
}

HalfedgeId between(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
    const HalfedgeId h = mesh.find_halfedge(VertexId(a), VertexId(b));
    return h.valid() ? h : mesh.find_halfedge(VertexId(b), VertexId(a));
}

TEST(Sheets, AreInTheWayWhereTheyJoinTheSameVertices) {
    Mesh mesh = make_doubled_triangle();
    MarkedMesh marked = mark(mesh);
    const HalfedgeId blocked = between(mesh, 2, 3);
    ASSERT_FALSE(marked.is_flippable(blocked));
    EXPECT_EQ(mesh.edge(edge_in_the_way(marked, blocked)), mesh.edge(between(mesh, 0, 1)));
    EXPECT_FALSE(edge_in_the_way(marked, between(mesh, 0, 1)).valid());
    EXPECT_FALSE(edge_in_the_way(marked, between(mesh, 0, 2)).valid());
    EXPECT_FALSE(edge_in_the_way(marked, between(mesh, 0, 3)).valid());
}

TEST(Sheets, ArePartedWhereAllAroundStaysDelaunay) {
    Mesh mesh = make_doubled_triangle();
    MarkedMesh marked = mark(mesh);
    RemeshReport report;
    const std::vector<HalfedgeId> left = part_sheets(marked, {}, report, {between(mesh, 2, 3)});
    ASSERT_EQ(validate(mesh), "");
    EXPECT_TRUE(left.empty());
    ASSERT_EQ(marked.split_count(), 1u);
    EXPECT_EQ(mesh.point(VertexId(5)), (Vec3{0.25, 0, 0}));
    EXPECT_EQ(test::check_delaunay(mesh), "");
    // The first sheet has got its edge.
    ASSERT_TRUE(between(mesh, 0, 1).valid());
    EXPECT_FALSE(between(mesh, 2, 3).valid());
}

TEST(Sheets, FixedVerticesCountAsThoseOfAnInput) {
    Mesh mesh = make_doubled_triangle();
    MarkedMesh marked = mark(mesh);
    RemeshReport report;
    ASSERT_TRUE(part_sheets(marked, {}, report, {between(mesh, 2, 3)}).empty());
    ASSERT_EQ(marked.split_count(), 1u);
    EXPECT_FALSE(marked.is_input(VertexId(5)));
    marked.fix_vertices();
    EXPECT_TRUE(marked.is_input(VertexId(5)));
    EXPECT_EQ(marked.split_count(), 1u);
    EXPECT_EQ(marked.input_vertices(), 5u);
    const VertexId made = marked.split(between(mesh, 5, 2), {VertexId(2), VertexId(5), 0.5}, {0.25, 2, 0});
    EXPECT_FALSE(marked.is_input(made));
    EXPECT_EQ(marked.split_point(made).b, VertexId(5));
    EXPECT_EQ(marked.take_provenance().splits.size(), 2u);
}

/// A thin tube of needles that ends in a flat, doubled flap: both its sheets have the same corner at the far end, and
/// want the same edges there. Shells explode on the needles.
Mesh make_flap(std::uint64_t seed) {
    Random random(seed);
    const auto sides = static_cast<std::uint32_t>(4 + 2 * random.below(4));
    const std::uint32_t half = sides / 2;
    const double radius = 0.001 + 0.05 * random.uniform();
    const double length = 0.02 + random.uniform();
    PolygonSoup soup;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t k = i % half;
        const double x = (i < half ? 1 : -1) * (k == 0 ? -1.0 : -1 + 2 * (k + 0.8 * random.uniform() - 0.4) / half);
        const double up = k == 0 ? 0.0 : (0.1 + 0.5 * random.uniform()) * (1 - x * x);
        soup.points.push_back({radius * x, 0, radius * up});
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        // A rational circle, as sines differ in their last bits between systems.
        const double t = 4.0 * i / sides - 2;
        const double scale = radius / (1 + t * t);
        soup.points.push_back({scale * (1 - t * t), scale * 2 * t, 1 + radius * (random.uniform() - 0.5)});
    }
    soup.points.push_back({radius * (2 * random.uniform() - 1), 0, -length});
    const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        soup.corners.insert(soup.corners.end(), {a, b, c});
    };
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t j = (i + 1) % sides;
        face(i, j, sides + i);
        face(j, sides + j, sides + i);
    }
    for (std::uint32_t i = 0; i < half; ++i) face(i + 1, i, 2 * sides);
    for (std::uint32_t i = half + 1; i < sides; ++i) face((i + 1) % sides, i, half);
    face(0, half, 2 * sides);
    return Mesh(std::move(soup));
}

std::string say(const char* what, std::size_t index) {
    std::ostringstream text;
    text << what << ' ' << index;
    return text.str();
}

/// Empty if all vertices of a face lie in the plane of its facet, and its faces cover as much as they did, all the same
/// way up; each new vertex lies between two older ones.
std::string check_surface(const Mesh& before, const Mesh& after, const Provenance& from) {
    constexpr double slack = 1e-13;
    const auto normal = [](const Mesh& mesh, std::size_t f) {
        const HalfedgeId h = Mesh::halfedge(FaceId(f));
        const Vec3 a = mesh.point(mesh.origin(h));
        return cross(mesh.point(mesh.target(h)) - a, mesh.point(mesh.apex(h)) - a);
    };
    for (std::size_t i = 0; i < from.splits.size(); ++i) {
        const SplitPoint& split = from.splits[i];
        const VertexId v(from.input_vertices + i);
        if (!(split.a < split.b && split.b < v && split.t > 0 && split.t < 1)) return say("not between two: split", i);
        const Vec3 expected = (1 - split.t) * after.point(split.a) + split.t * after.point(split.b);
        if (norm(after.point(v) - expected) > slack) return say("not in its place: split", i);
    }
    std::map<FaceId, double> area;
    for (std::size_t f = 0; f < before.face_count(); ++f) area[from.facet_of_input_face[f]] += norm(normal(before, f));
    for (std::size_t f = 0; f < after.face_count(); ++f) {
        const std::size_t facet = from.facet_of_face[f].index();
        const Vec3 n = normal(before, facet);
        const Vec3 up = (1 / norm(n)) * n;
        const Vec3 base = before.point(before.origin(HalfedgeId(3 * facet)));
        for (std::size_t k = 0; k < 3; ++k)
            if (std::fabs(dot(up, after.point(after.corners()[3 * f + k]) - base)) > slack)
                return say("not in the plane of its facet: face", f);
        if (dot(up, normal(after, f)) < -slack) return say("upside down: face", f);
        area[from.facet_of_face[f]] -= norm(normal(after, f));
    }
    for (const auto& [facet, left] : area)
        if (std::fabs(left) > slack) return say("not covered: facet", facet.index());
    return {};
}

TEST(Sheets, FlapsOfNeedleTubesTakeFewPointsAndNotThousandsOfShells) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Mesh before = make_flap(seed);
        Mesh mesh = before;
        RemeshOptions options;
        options.placement = SplitPlacement::fewest;
        options.effort = 1;
        options.max_vertices = 20'000;
        const RemeshReport report = make_delaunay(mesh, options);
        ASSERT_EQ(report.stop, StopReason::done) << seed;
        ASSERT_EQ(validate(mesh), "");
        EXPECT_EQ(test::check_delaunay(mesh), "");
        EXPECT_EQ(check_surface(before, mesh, report.provenance), "");
        EXPECT_EQ(mesh.vertex_count(), before.vertex_count() + report.splits);
        EXPECT_EQ(report.splits, report.splits_feature + report.splits_boundary + report.splits_unflippable);
        EXPECT_GT(report.splits_unflippable, 0u) << seed;
        EXPECT_LT(report.splits, 300u) << seed;
    }
}

}  // namespace
}  // namespace delmesh
