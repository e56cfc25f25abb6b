#include "delaunay/classify.hpp"

#include "delmesh/exact/predicates.hpp"
#include "delmesh/mesh/validate.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

TEST(MarkEdges, TwinsAgreeAndBoundaryIsPhysical) {
    for (const test::NamedSoup& named : test::families(200)) {
        const Mesh mesh(named.soup);
        const std::vector<Mark> marks = mark_edges(mesh, nullptr);
        for (std::size_t i = 0; i < marks.size(); ++i) {
            const HalfedgeId t = mesh.twin(HalfedgeId(i));
            if (t.valid()) {
                ASSERT_EQ(marks[i], marks[t.index()]) << named.name;
            } else {
                ASSERT_EQ(marks[i], Mark::physical) << named.name;
            }
        }
    }
}

TEST(FindFacets, AreNamedByTheirSmallestFaceAndEndAtPhysicalEdges) {
    for (const test::NamedSoup& named : test::families(200)) {
        const Mesh mesh(named.soup);
        const std::vector<Mark> marks = mark_edges(mesh, nullptr);
        const std::vector<FaceId> facets = find_facets(mesh, marks);
        for (std::size_t f = 0; f < facets.size(); ++f) {
            ASSERT_LE(facets[f], FaceId(f));
            ASSERT_EQ(facets[facets[f].index()], facets[f]);
        }
        for (std::size_t i = 0; i < marks.size(); ++i) {
            if (marks[i] == Mark::planar) {
                ASSERT_EQ(facets[i / 3], facets[mesh.twin(HalfedgeId(i)).index() / 3]) << named.name;
            }
        }
    }
}

TEST(RemoveCaps, LeavesNoFaceWithoutAreaAndNoNewVertex) {
    // A fan whose rim runs along a line: one proper face, and caps upon caps.
    PolygonSoup soup;
    const std::uint32_t n = 40;
    for (std::uint32_t i = 0; i <= n; ++i) soup.points.push_back({static_cast<double>(i), 0, 0});
    soup.points.push_back({7, 5, 0});
    soup.points.push_back({9, -5, 0});
    for (std::uint32_t i = 1; i < n; ++i) soup.corners.insert(soup.corners.end(), {0, i + 1, i});
    for (std::uint32_t i = 0; i < n; ++i) soup.corners.insert(soup.corners.end(), {i, i + 1, n + 1});
    soup.corners.insert(soup.corners.end(), {n, 0, n + 2});
    Mesh mesh(soup);
    const std::size_t changes = remove_caps(mesh, nullptr);
    EXPECT_GE(changes, static_cast<std::size_t>(n - 1));
    EXPECT_EQ(validate(mesh), "");
    EXPECT_EQ(mesh.vertex_count(), soup.points.size());
    EXPECT_EQ(mesh.face_count(), soup.face_count());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const HalfedgeId h = Mesh::halfedge(FaceId(f));
        EXPECT_FALSE(are_collinear(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.apex(h))));
    }
}

TEST(RemoveCaps, CleanMeshesAreUntouched) {
    for (const test::NamedSoup& named : test::families(200)) {
        if (named.has_zero_area) continue;
        Mesh mesh(named.soup);
        EXPECT_EQ(remove_caps(mesh, nullptr), 0u) << named.name;
    }
}

}  // namespace
}  // namespace delmesh
