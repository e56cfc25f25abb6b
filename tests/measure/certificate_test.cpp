#include "delmesh/measure/certificate.hpp"

#include "delmesh/exact/predicates.hpp"
#include "measure/meshes.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace delmesh {
namespace {

using namespace delmesh::testing;

/// The certificate by its definition: one predicate for each edge, nothing clever.
Certificate by_definition(const Mesh& mesh) {
    Certificate c;
    c.complete = true;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (!mesh.names_edge(h)) continue;
        const Vec3 &p = mesh.point(mesh.origin(h)), &q = mesh.point(mesh.target(h)), &u = mesh.point(mesh.apex(h));
        const bool boundary = mesh.is_boundary(h);
        const Sign sign =
            boundary ? right_angle_sign(p, q, u) : delaunay_sign(p, q, u, mesh.point(mesh.apex(mesh.twin(h))));
        if (sign != Sign::negative) continue;
        ++(boundary ? c.obtuse_boundary_edges : c.non_delaunay_edges);
        if (c.offenders.size() < 16) c.offenders.push_back(mesh.edge(h));
    }
    c.certified = c.non_delaunay_edges + c.obtuse_boundary_edges == 0;
    return c;
}

void expect_same_counts(const Certificate& a, const Certificate& b) {
    EXPECT_EQ(a.certified, b.certified);
    EXPECT_EQ(a.complete, b.complete);
    EXPECT_EQ(a.non_delaunay_edges, b.non_delaunay_edges);
    EXPECT_EQ(a.obtuse_boundary_edges, b.obtuse_boundary_edges);
    EXPECT_EQ(a.offenders, b.offenders);
}

void expect_identical(const Certificate& a, const Certificate& b) {
    expect_same_counts(a, b);
    EXPECT_EQ(a.worst_excess_deg, b.worst_excess_deg);
    EXPECT_EQ(a.worst_edge, b.worst_edge);
    EXPECT_EQ(a.exact_edges, b.exact_edges);
    EXPECT_EQ(a.degenerate_faces, b.degenerate_faces);
}

/// Two triangles at the edge 0-1 of length 2 with the given heights of their apexes.
Mesh kite(double above, double below) {
    return mesh_of({{-1, 0, 0}, {1, 0, 0}, {0, above, 0}, {0, -below, 0}}, {0, 1, 2, 1, 0, 3});
}

double degrees(double radians) {
    return radians * 180 / std::numbers::pi;
}

TEST(Certificate, AgreesWithTheDefinitionOnNoisyTori) {
    for (const double noise : {0.0, 0.01, 0.1, 0.5}) {
        const Mesh mesh(torus_soup(40, 23, noise));
        const Certificate c = certify(mesh);
        expect_same_counts(c, by_definition(mesh));
        if (noise >= 0.1) {
            EXPECT_GT(c.non_delaunay_edges, 50U);
        }
    }
}

TEST(Certificate, AgreesWithTheDefinitionOnAllFamilies) {
    for (const test::NamedSoup& family : test::families()) {
        SCOPED_TRACE(family.name);
        const Mesh mesh(family.soup);
        const Certificate c = certify(mesh);
        Certificate expected = by_definition(mesh);
        EXPECT_EQ(c.degenerate_faces > 0, family.has_zero_area);
        if (family.has_zero_area) expected.certified = false;
        expect_same_counts(c, expected);
        EXPECT_EQ(c.worst_edge.has_value(), c.non_delaunay_edges + c.obtuse_boundary_edges > 0);
    }
}

TEST(Certificate, GridIsCertifiedAlthoughEveryDiagonalIsCocircular) {
    const Certificate c = certify(Mesh(grid_soup(30)));
    EXPECT_TRUE(c.certified);
    EXPECT_TRUE(c.complete);
    EXPECT_EQ(c.worst_excess_deg, 0);
    EXPECT_FALSE(c.worst_edge);
}

TEST(Certificate, ExactEdgesAreThoseThatTheFilterLeavesOpen) {
    // Turned, so that no difference has a zero: every diagonal is left to the exact tiers, and no side.
    const Certificate c = certify(Mesh(turned(grid_soup(10))));
    EXPECT_EQ(c.exact_edges, 100U);
    EXPECT_TRUE(c.certified);
    EXPECT_EQ(certify(kite(3, 3)).exact_edges, 0U);
}

TEST(Certificate, OneUlpDecides) {
    // The apexes see the edge at right angles each; one ulp lower and the sum exceeds pi.
    const double below_one = std::nextafter(1.0, 0.0), above_one = std::nextafter(1.0, 2.0);
    EXPECT_EQ(certify(kite(1, 1)).non_delaunay_edges, 0U);
    EXPECT_EQ(certify(kite(1, above_one)).non_delaunay_edges, 0U);
    const Certificate c = certify(kite(1, below_one));
    EXPECT_EQ(c.non_delaunay_edges, 1U);
    EXPECT_EQ(c.worst_edge, EdgeId(0));
    EXPECT_GE(c.worst_excess_deg, 0);
    EXPECT_LT(c.worst_excess_deg, 1e-13);
}

TEST(Certificate, WorstExcessIsTheAngleSumLessPi) {
    for (const double height : {1e-12, 0.01, 0.3, 0.9}) {
        const Certificate c = certify(kite(height, 0.5));
        const double sum = 2 * std::atan2(1.0, height) + 2 * std::atan2(1.0, 0.5);
        EXPECT_NEAR(c.worst_excess_deg, degrees(sum) - 180, 1e-12);
        EXPECT_EQ(c.worst_edge, EdgeId(0));
    }
}

TEST(Certificate, WorstEdgeIsTheWorstOfAll) {
    const Mesh mesh(torus_soup(40, 23, 0.1));
    double worst = 0;
    EdgeId edge;
    const auto angle = [&mesh](HalfedgeId h) {
        const Vec3 u = mesh.point(mesh.apex(h));
        const Vec3 a = mesh.point(mesh.origin(h)) - u, b = mesh.point(mesh.target(h)) - u;
        return std::acos(dot(a, b) / (norm(a) * norm(b)));
    };
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        const double excess = degrees(angle(h) + angle(mesh.twin(h))) - 180;
        if (excess > worst && mesh.names_edge(h)) worst = excess, edge = mesh.edge(h);
    }
    const Certificate c = certify(mesh);
    EXPECT_NEAR(c.worst_excess_deg, worst, 1e-9);
    EXPECT_EQ(c.worst_edge, edge);
}

TEST(Certificate, BoundaryEdgeBeyondARightAngle) {
    const auto triangle = [](double height) { return mesh_of({{-1, 0, 0}, {1, 0, 0}, {0, height, 0}}, {0, 1, 2}); };
    EXPECT_TRUE(certify(triangle(1)).certified);
    EXPECT_TRUE(certify(triangle(2)).certified);
    const Certificate c = certify(triangle(0.25));
    EXPECT_FALSE(c.certified);
    EXPECT_EQ(c.obtuse_boundary_edges, 1U);
    EXPECT_EQ(c.offenders, std::vector<EdgeId>{EdgeId(0)});
    EXPECT_NEAR(c.worst_excess_deg, degrees(2 * std::atan2(1.0, 0.25)) - 90, 1e-12);
}

TEST(Certificate, ZeroAreaFaceIsNeverCertified) {
    // A cap on the edge 0-1: its angle pi there exceeds the limit with any neighbour.
    const Certificate cap = certify(kite(0, 5));
    EXPECT_EQ(cap.degenerate_faces, 1U);
    EXPECT_EQ(cap.non_delaunay_edges, 1U);
    EXPECT_FALSE(cap.certified);
    // Both caps: the largest excess there is.
    const Certificate two = certify(kite(0, 0));
    EXPECT_EQ(two.degenerate_faces, 2U);
    EXPECT_NEAR(two.worst_excess_deg, 180, 1e-12);
    // A needle with two corners in one place: no edge to blame, but not certified.
    const Certificate needle = certify(mesh_of({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {0, 1, 2}));
    EXPECT_EQ(needle.degenerate_faces, 1U);
    EXPECT_EQ(needle.obtuse_boundary_edges, 0U);
    EXPECT_FALSE(needle.certified);
}

TEST(Certificate, PowersOfTwoChangeNothing) {
    const PolygonSoup soup = torus_soup(30, 20, 0.1);
    const Certificate unscaled = certify(Mesh(soup));
    EXPECT_GT(unscaled.non_delaunay_edges, 0U);
    for (const int exponent : {-900, -300, 300, 1000}) {
        Certificate c = certify(Mesh(scaled(soup, exponent)));
        EXPECT_NEAR(c.worst_excess_deg, unscaled.worst_excess_deg, 1e-12);
        c.worst_excess_deg = unscaled.worst_excess_deg;
        c.exact_edges = unscaled.exact_edges;  // the filter may give up earlier at extreme scales
        expect_identical(c, unscaled);
    }
}

TEST(Certificate, DoesNotDependOnTheNumberOfThreads) {
    const Mesh mesh(torus_soup(300, 130, 0.02));  // several blocks
    Context one({}, 1);
    const Certificate c = certify(mesh, &one);
    EXPECT_GT(c.non_delaunay_edges, 100U);
    for (const int threads : {2, 3, 8}) {
        Context several({}, threads);
        expect_identical(certify(mesh, &several), c);
    }
    expect_identical(certify(mesh), c);
}

TEST(Certificate, CancelledCallCertifiesNothing) {
    Context context;
    context.cancel();
    const Certificate c = certify(Mesh(grid_soup(10)), &context);
    EXPECT_FALSE(c.complete);
    EXPECT_FALSE(c.certified);
}

TEST(Certificate, EmptyMeshIsCertified) {
    EXPECT_TRUE(certify(Mesh()).certified);
}

}  // namespace
}  // namespace delmesh
