#include "delmesh/mesh/mesh.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/mesh/validate.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>

namespace delmesh {
namespace {

PolygonSoup soup_of(std::size_t points, std::vector<std::uint32_t> corners) {
    PolygonSoup soup;
    for (std::size_t i = 0; i < points; ++i) {
        const double x = static_cast<double>(i);
        soup.points.push_back({x, x * x, x * x * x});
    }
    soup.corners = std::move(corners);
    return soup;
}

PolygonSoup tetrahedron() {
    return soup_of(4, {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0});
}

/// A grid of n by n squares, each cut in two.
PolygonSoup grid(std::uint32_t n) {
    PolygonSoup soup;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i)
            soup.points.push_back({static_cast<double>(i), static_cast<double>(j), 0});
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            for (const std::uint32_t v : {a, a + 1, a + n + 2, a, a + n + 2, a + n + 1}) soup.corners.push_back(v);
        }
    }
    return soup;
}

/// Builds and returns the error; fails if there is none.
Error error_of(PolygonSoup soup) {
    try {
        const Mesh mesh(std::move(soup));
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "the mesh was built";
    return {ErrorCode::bad_argument, ""};
}

TEST(Mesh, KeepsOrderOfPointsAndFaces) {
    const PolygonSoup soup = grid(5);
    const Mesh mesh(soup);
    EXPECT_EQ(to_soup(mesh).points, soup.points);
    EXPECT_EQ(to_soup(mesh).corners, soup.corners);
}

TEST(Mesh, ClosedAndOpenMeshesAreValid) {
    EXPECT_EQ(validate(Mesh(tetrahedron())), "");
    const Mesh open(grid(7));
    EXPECT_EQ(validate(open), "");
    EXPECT_EQ(open.count_edges(), 7u * 8 * 2 + 7 * 7);
    EXPECT_EQ(validate(Mesh()), "");
}

TEST(Mesh, TwinsAreThoseOfABruteForceMap) {
    const Mesh mesh(grid(6));
    std::map<std::pair<std::uint32_t, std::uint32_t>, HalfedgeId> by_ends;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        by_ends[{mesh.origin(h).value(), mesh.target(h).value()}] = h;
    }
    for (const auto& [ends, h] : by_ends) {
        const auto back = by_ends.find({ends.second, ends.first});
        EXPECT_EQ(mesh.twin(h), back == by_ends.end() ? HalfedgeId() : back->second);
    }
}

TEST(Mesh, FindHalfedgeAgreesWithTheListOfAll) {
    const Mesh mesh(grid(4));
    std::map<std::pair<std::uint32_t, std::uint32_t>, HalfedgeId> by_ends;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i)
        by_ends[{mesh.origin(HalfedgeId(i)).value(), mesh.target(HalfedgeId(i)).value()}] = HalfedgeId(i);
    for (std::uint32_t a = 0; a < mesh.vertex_count(); ++a) {
        for (std::uint32_t b = 0; b < mesh.vertex_count(); ++b) {
            const auto there = by_ends.find({a, b});
            const HalfedgeId expected = there == by_ends.end() ? HalfedgeId() : there->second;
            EXPECT_EQ(mesh.find_halfedge(VertexId(a), VertexId(b)), expected) << a << " " << b;
            EXPECT_EQ(mesh.are_joined(VertexId(a), VertexId(b)), expected.valid() || by_ends.contains({b, a}));
        }
    }
}

TEST(Mesh, IsolatedVerticesKeepTheirPlace) {
    PolygonSoup soup = soup_of(6, {0, 2, 5});
    const Mesh mesh(soup);
    EXPECT_EQ(mesh.vertex_count(), 6u);
    EXPECT_FALSE(mesh.halfedge(VertexId(1)).valid());
    EXPECT_FALSE(mesh.is_boundary(VertexId(1)));
    EXPECT_TRUE(mesh.is_boundary(VertexId(2)));
    EXPECT_EQ(validate(mesh), "");
}

TEST(Mesh, PolygonsAreTriangulated) {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, 0}};
    soup.add_face(std::vector<std::uint32_t>{0, 1, 2, 3});
    soup.add_face(std::vector<std::uint32_t>{1, 4, 2});
    const Mesh mesh(soup);
    EXPECT_EQ(mesh.face_count(), 3u);
    EXPECT_EQ(validate(mesh), "");
}

TEST(MeshErrors, NotFinite) {
    PolygonSoup soup = tetrahedron();
    soup.points[2].y = std::numeric_limits<double>::quiet_NaN();
    soup.points[3].z = -std::numeric_limits<double>::infinity();
    const Error error = error_of(soup);
    EXPECT_EQ(error.code(), ErrorCode::not_finite);
    EXPECT_EQ(error.elements(), (std::vector<std::size_t>{2, 3}));
}

TEST(MeshErrors, IndexOutOfRangeAtTheSmallestBadValue) {
    const Error error = error_of(soup_of(4, {0, 1, 2, 1, 2, 4}));
    EXPECT_EQ(error.code(), ErrorCode::index_out_of_range);
    EXPECT_EQ(error.elements(), (std::vector<std::size_t>{1}));
}

TEST(MeshErrors, RepeatedVertex) {
    const Error error = error_of(soup_of(4, {0, 1, 2, 3, 1, 3}));
    EXPECT_EQ(error.code(), ErrorCode::degenerate_face);
    EXPECT_EQ(error.elements(), (std::vector<std::size_t>{1}));
}

TEST(MeshErrors, ThreeFacesAtAnEdge) {
    const Error error = error_of(soup_of(5, {0, 1, 2, 1, 0, 3, 0, 1, 4}));
    EXPECT_EQ(error.code(), ErrorCode::non_manifold_edge);
    EXPECT_EQ(error.elements(), (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(error.count(), 1u);
}

TEST(MeshErrors, FacesThatRunTheSameWay) {
    const Error error = error_of(soup_of(4, {0, 1, 2, 0, 1, 3}));
    EXPECT_EQ(error.code(), ErrorCode::inconsistent_edge);
    EXPECT_EQ(error.elements(), (std::vector<std::size_t>{0, 1}));
}

TEST(MeshErrors, TwoFansAtAVertex) {
    const Error open = error_of(soup_of(5, {0, 1, 2, 0, 3, 4}));
    EXPECT_EQ(open.code(), ErrorCode::non_manifold_vertex);
    EXPECT_EQ(open.elements(), (std::vector<std::size_t>{0}));
    // Two tetrahedra that share a vertex: closed fans.
    PolygonSoup closed = soup_of(7, {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0, 0, 4, 5, 0, 6, 4, 4, 6, 5, 5, 6, 0});
    EXPECT_EQ(error_of(closed).code(), ErrorCode::non_manifold_vertex);
}

TEST(MeshErrors, ListsAtMostSixteenButCountsAll) {
    PolygonSoup soup = soup_of(3, {});
    for (int i = 0; i < 40; ++i) soup.corners.insert(soup.corners.end(), {0, 1, 9});
    const Error error = error_of(soup);
    EXPECT_EQ(error.elements().size(), 16u);
    EXPECT_EQ(error.count(), 40u);
}

TEST(Validate, FiresOnADoubleCoveredTriangleOnlyWhereItIsWrong) {
    // Two faces over the same three vertices are a sphere, and a legal mesh.
    EXPECT_EQ(validate(Mesh(soup_of(3, {0, 1, 2, 2, 1, 0}))), "");
}

}  // namespace
}  // namespace delmesh
