// What meets in too many ways comes apart, and nothing more than it must.

#include "repair/repair_support.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace delmesh::test {
namespace {

/// Half-planes along the z axis at the given angles, two triangles each; each drawn so that it runs up the axis.
PolygonSoup make_book(const std::vector<double>& degrees) {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {0, 0, 1}};
    for (const double d : degrees) {
        const double angle = d * 3.14159265358979323846 / 180;
        const auto v = static_cast<std::uint32_t>(soup.points.size());
        soup.points.push_back({std::cos(angle), std::sin(angle), 0});
        soup.points.push_back({std::cos(angle), std::sin(angle), 1});
        soup.add_face(Triangle{0, 1, v + 1});
        soup.add_face(Triangle{0, v + 1, v});
    }
    return soup;
}

/// The pages (by number) that are joined at the spine.
std::set<std::set<std::size_t>> joined_pages(const Repaired& out) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<std::size_t>> at;
    for (std::size_t f = 0; f < out.soup.face_count(); ++f) {
        const auto v = out.soup.face(f);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = v[i];
            const std::uint32_t b = v[(i + 1) % 3];
            const Vec3& p = out.soup.points[a];
            const Vec3& q = out.soup.points[b];
            if (p.x == 0 && p.y == 0 && q.x == 0 && q.y == 0)
                at[{std::min(a, b), std::max(a, b)}].insert(out.report.face_origin[f].index() / 2);
        }
    }
    std::set<std::set<std::size_t>> result;
    for (const auto& [edge, pages] : at) result.insert(pages);
    return result;
}

using Pages = std::set<std::set<std::size_t>>;

TEST(Manifold, ThreeSheetsKeepTheFlatterPair) {
    PolygonSoup soup = make_book({0, 90, 170});
    turn_face(soup, 4);
    turn_face(soup, 5);
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(joined_pages(out), (Pages{{0, 2}, {1}}));
    EXPECT_EQ(out.report.count(Defect::non_manifold_edge), 1U);
    EXPECT_EQ(out.report.count(Defect::non_manifold_vertex), 2U);
    EXPECT_EQ(out.soup.points.size(), 10U);
}

TEST(Manifold, CrossingPlanesStayPlanes) {
    // Oriented as two planes: pages 0 and 2 agree, and 1 and 3.
    PolygonSoup soup = make_book({0, 90, 180, 270});
    for (const std::size_t page : {2U, 3U})
        for (std::size_t i = 0; i < 2; ++i) turn_face(soup, 2 * page + i);
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(joined_pages(out), (Pages{{0, 2}, {1, 3}}));
    EXPECT_EQ(out.report.count(Defect::inconsistent_face), 0U);
}

TEST(Manifold, ThinSolidsAtAnEdgeComeApart) {
    // Pages alternate: two wedges of 10 degrees, far flatter across the gaps between them.
    PolygonSoup soup = make_book({0, 10, 180, 190});
    for (const std::size_t page : {0U, 2U})
        for (std::size_t i = 0; i < 2; ++i) turn_face(soup, 2 * page + i);
    EXPECT_EQ(joined_pages(repair_and_check(soup)), (Pages{{0, 1}, {2, 3}}));
}

TEST(Manifold, AnEvenNumberOfPagesIsJoinedInPairs) {
    for (const std::size_t pages : {2U, 3U, 4U, 9U, 16U, 17U, 40U, 101U}) {
        SCOPED_TRACE(pages);
        std::vector<double> degrees;
        for (std::size_t i = 0; i < pages; ++i) degrees.push_back(static_cast<double>((i * 97) % 360));
        PolygonSoup soup = make_book(degrees);
        // The spine is interior to the sheets: count its sides that stay alone.
        std::size_t alone = 0;
        for (const auto& joined : joined_pages(repair_and_check(soup))) alone += joined.size() == 1 ? 1 : 0;
        EXPECT_EQ(alone, pages % 2);
    }
}

TEST(Manifold, CubesAtAnEdgeComeApartClosed) {
    PolygonSoup soup = make_cube({0, 0, 0});
    append(soup, make_cube({1, 1, 0}));
    PolygonSoup one_inside_out = make_cube({0, 0, 0});
    turn_all_faces(one_inside_out);
    append(one_inside_out, make_cube({1, 1, 0}));
    for (const PolygonSoup& cubes : {soup, one_inside_out})
        for (const PolygonSoup& way : {cubes, merge_places(cubes), take_apart(cubes)}) {
            const Repaired out = repair_and_check(way);
            EXPECT_EQ(count_boundary_edges(out.soup), 0U);
            EXPECT_EQ(count_components(out.soup), 2U);
            EXPECT_EQ(out.soup.points.size(), 16U);
            EXPECT_NEAR(examine(out.soup).volume6, 12, 1e-12);
        }
    EXPECT_FALSE(repair_and_check(soup).report.changed);
}

TEST(Manifold, CubesAtAVertexComeApart) {
    PolygonSoup soup = make_cube({0, 0, 0});
    append(soup, make_cube({1, 1, 1}));
    const Repaired out = repair_and_check(merge_places(soup));
    EXPECT_EQ(count_components(out.soup), 2U);
    EXPECT_EQ(out.report.count(Defect::non_manifold_vertex), 1U);
    EXPECT_EQ(out.report.findings.front().places, std::vector<std::size_t>{7});
}

TEST(Manifold, CubesWithACommonSideStayTwo) {
    PolygonSoup soup = make_cube({0, 0, 0});
    append(soup, make_cube({1, 0, 0}));
    for (const PolygonSoup& way : {soup, merge_places(soup), take_apart(soup)}) {
        const Repaired out = repair_and_check(way);
        EXPECT_EQ(count_boundary_edges(out.soup), 0U);
        EXPECT_EQ(count_components(out.soup), 2U);
        EXPECT_EQ(out.soup.face_count(), 24U);
    }
}

TEST(Manifold, BowTie) {
    const PolygonSoup soup =
        triangles({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.corners, (std::vector<std::uint32_t>{0, 1, 2, 5, 3, 4}));
    EXPECT_EQ(out.report.vertex_origin.back(), VertexId(0));
}

TEST(Manifold, WallOnAFloor) {
    // The floor stays whole, the wall stands by itself.
    PolygonSoup soup = make_book({0, 90, 180});
    turn_face(soup, 0);
    turn_face(soup, 1);
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(joined_pages(out), (Pages{{0, 2}, {1}}));
}

TEST(Manifold, DoubleCoveredTriangleIsAMesh) {
    const PolygonSoup soup = triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
    EXPECT_FALSE(repair_and_check(soup).report.changed);
    const Repaired apart = repair_and_check(take_apart(soup));
    EXPECT_EQ(apart.soup.corners, soup.corners);
}

/// With an obtuse angle it is one that can not become Delaunay.
TEST(Manifold, DoubleCoveredObtuseTriangleLosesItsBack) {
    const PolygonSoup soup = triangles({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.face_count(), 1U);
    EXPECT_EQ(out.report.count(Defect::duplicate_face), 1U);
    // On a wall, where it is joined with nothing but its back, and where a rim takes it up.
    PolygonSoup wall = triangles({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {2, -3, 0}, {2, -3, 5}},
                                 {{0, 1, 2}, {0, 2, 1}, {1, 0, 3}, {0, 1, 4}});
    EXPECT_GE(repair_and_check(wall).soup.face_count(), 3U);
}

TEST(Manifold, RepeatedFacesAreDropped) {
    // Of the same orientation, in another order, and with vertices of their own.
    PolygonSoup soup = make_cube({0, 0, 0});
    soup.add_face(Triangle{soup.corners[1], soup.corners[2], soup.corners[0]});
    append(soup, make_cube({0, 0, 0}));
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.face_count(), 12U);
    EXPECT_EQ(out.soup.points.size(), 8U);
    EXPECT_EQ(out.report.count(Defect::duplicate_face), 13U);
}

TEST(Manifold, FacesAtOnePlaceCancel) {
    // The first of three copies faces the wrong way: the one that is kept does not.
    PolygonSoup soup = make_cube({0, 0, 0});
    const Triangle first{soup.corners[0], soup.corners[1], soup.corners[2]};
    soup.add_face(first);
    soup.add_face(first);
    turn_face(soup, 0);
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.face_count(), 12U);
    EXPECT_EQ(out.report.count(Defect::inconsistent_face), 0U);
    EXPECT_EQ(out.report.face_origin.back(), FaceId(12));
}

PolygonSoup make_patch() {
    PolygonSoup soup;
    for (int i = 0; i < 16; ++i) soup.points.push_back({static_cast<double>(i % 4), static_cast<double>(i / 4), 0});
    for (std::uint32_t i = 0; i < 3; ++i)
        for (std::uint32_t j = 0; j < 3; ++j) {
            const std::uint32_t v = 4 * i + j;
            soup.add_face(Triangle{v, v + 1, v + 5});
            soup.add_face(Triangle{v, v + 5, v + 4});
        }
    return soup;
}

TEST(Manifold, ASheetThatIsThereTwiceBecomesOne) {
    const PolygonSoup patch = make_patch();
    PolygonSoup twice = patch;
    append(twice, patch);
    const Repaired out = repair_and_check(twice);
    EXPECT_EQ(out.soup.corners, patch.corners);
    EXPECT_EQ(out.report.count(Defect::duplicate_face), 18U);
}

PolygonSoup with_back_side(const PolygonSoup& sheet) {
    PolygonSoup back = sheet;
    turn_all_faces(back);
    PolygonSoup both = sheet;
    append(both, back);
    return both;
}

TEST(Manifold, TheTwoSidesOfASheetBecomeAFlatClosedSurface) {
    PolygonSoup fan;
    fan.points.push_back({0, 0, 0});
    for (int i = 0; i < 6; ++i) fan.points.push_back({std::cos(i * 1.0), std::sin(i * 1.0), 0});
    for (std::uint32_t i = 0; i < 6; ++i) fan.add_face(Triangle{0, i + 1, (i + 1) % 6 + 1});
    const PolygonSoup both = with_back_side(fan);
    for (const PolygonSoup& way : {both, merge_places(both), take_apart(both)}) {
        const Repaired out = repair_and_check(way);
        EXPECT_EQ(out.soup.face_count(), 12U);
        EXPECT_EQ(count_boundary_edges(out.soup), 0U);
        EXPECT_EQ(count_components(out.soup), 1U);
        EXPECT_EQ(examine(out.soup).euler, 2);
    }
}

TEST(Manifold, EarsOfATwoSidedSheetComeOff) {
    // The inner edge of an ear would join the same two vertices twice, in front and at the back.
    const PolygonSoup both = with_back_side(make_patch());
    for (const PolygonSoup& way : {both, merge_places(both), take_apart(both)}) {
        const Repaired out = repair_and_check(way);
        EXPECT_EQ(out.soup.face_count(), 36U);
        EXPECT_EQ(count_boundary_edges(out.soup), 0U);
        EXPECT_EQ(count_components(out.soup), 3U);
        EXPECT_EQ(examine(out.soup).euler, 6);
    }
}

TEST(Manifold, SomeDoubleFacesInASheetAreDropped) {
    PolygonSoup soup = make_patch();
    for (const std::size_t f : {8U, 9U}) soup.add_face(Triangle{soup.face(f)[0], soup.face(f)[2], soup.face(f)[1]});
    soup.add_face(Triangle{soup.face(3)[0], soup.face(3)[1], soup.face(3)[2]});
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.corners, make_patch().corners);
    EXPECT_EQ(out.report.count(Defect::duplicate_face), 3U);
}

}  // namespace
}  // namespace delmesh::test
