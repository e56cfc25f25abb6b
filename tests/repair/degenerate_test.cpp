// Faces without area go, and the surface stays.

#include "repair/repair_support.hpp"

#include <gtest/gtest.h>

namespace delmesh::test {
namespace {

double total_area(const PolygonSoup& soup) {
    double sum = 0;
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const auto v = soup.face(f);
        sum += norm(cross(soup.points[v[1]] - soup.points[v[0]], soup.points[v[2]] - soup.points[v[0]])) / 2;
    }
    return sum;
}

TEST(Degenerate, NeedleIsClosed) {
    // Two triangles and between them a face with two corners at (1, 0, 0).
    const PolygonSoup soup =
        triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}});
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.points.size(), 4U);
    EXPECT_EQ(out.soup.face_count(), 2U);
    EXPECT_EQ(count_boundary_edges(out.soup), 4U);
    EXPECT_EQ(out.report.count(Defect::zero_length_edge), 1U);
    EXPECT_EQ(out.report.count(Defect::duplicate_vertex), 1U);
}

/// A square whose lower half is a fan about the middle of the diagonal, with a cap along the diagonal.
PolygonSoup square_with_cap() {
    return triangles({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}},
                     {{0, 1, 4}, {1, 2, 4}, {0, 4, 2}, {0, 2, 3}});
}

TEST(Degenerate, CapIsFlippedWithItsNeighbour) {
    const Repaired out = repair_and_check(square_with_cap());
    EXPECT_EQ(out.soup.face_count(), 4U);
    EXPECT_EQ(out.soup.points.size(), 5U);
    EXPECT_EQ(count_boundary_edges(out.soup), 4U);
    EXPECT_EQ(total_area(out.soup), 4);
    EXPECT_EQ(out.report.face_origin, (std::vector<FaceId>{FaceId(0), FaceId(1), FaceId(3), FaceId(3)}));
    EXPECT_EQ(out.report.count(Defect::zero_area), 1U);
    EXPECT_EQ(out.report.findings.front().places, std::vector<std::size_t>{2});
}

TEST(Degenerate, CapAtTheBoundaryIsDropped) {
    PolygonSoup soup = square_with_cap();
    soup.corners.resize(9);
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.face_count(), 2U);
    EXPECT_EQ(count_boundary_edges(out.soup), 4U);
}

TEST(Degenerate, CapOnACrowdedEdge) {
    // Two sheets pass through the diagonal; the cap belongs to one of them. Every edge stays even or has one side.
    PolygonSoup soup = square_with_cap();
    soup.points.push_back({1, 1, 2});
    soup.points.push_back({1, 1, -2});
    soup.add_face(Triangle{0, 2, 5});
    soup.add_face(Triangle{2, 0, 6});
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.face_count(), 6U);
    EXPECT_EQ(count_boundary_edges(out.soup), 8U);
}

TEST(Degenerate, FacesOnALineHaveNoSurface) {
    PolygonSoup soup;
    for (int i = 0; i < 2000; ++i) soup.points.push_back({1.0 * i, 2.0 * i, -3.0 * i});
    for (std::uint32_t i = 0; i + 2 < 2000; ++i) soup.add_face(Triangle{0, i + 1, i + 2});
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.face_count(), 0U);
    EXPECT_EQ(out.report.count(Defect::zero_area_dropped), 1998U);
}

TEST(Degenerate, TwoCapsThatCancel) {
    // The same cap twice, back to back, between two triangles.
    const PolygonSoup soup = triangles({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, -1, 0}},
                                       {{0, 2, 3}, {2, 1, 3}, {2, 0, 1}, {0, 2, 1}, {2, 0, 4}, {1, 2, 4}});
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.face_count(), 4U);
    EXPECT_EQ(count_boundary_edges(out.soup), 4U);
}

/// Between an upper and a lower fan lies a sliver without area: `upper` points along a line against `lower` ones,
/// triangulated from the left end, so that all of it must be flipped into the fans.
PolygonSoup lens(std::uint32_t upper, std::uint32_t lower) {
    PolygonSoup soup;
    const auto chain = [&](std::uint32_t count, double shift) {
        std::vector<std::uint32_t> ids;
        for (std::uint32_t i = 0; i < count; ++i) {
            ids.push_back(static_cast<std::uint32_t>(soup.points.size()));
            soup.points.push_back({(i + shift) / count, 0, 0});
        }
        return ids;
    };
    soup.points = {{-1, 0, 0}, {2, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}};
    for (const bool is_upper : {true, false}) {
        std::vector<std::uint32_t> ids = chain(is_upper ? upper : lower, is_upper ? 0.3 : 0.7);
        ids.insert(ids.begin(), 0);
        ids.push_back(1);
        for (std::size_t i = 0; i + 1 < ids.size(); ++i) {
            Triangle fan{ids[i], ids[i + 1], is_upper ? 2U : 3U};
            Triangle cap{0, ids[i + 1], ids[i]};
            if (!is_upper) std::swap(fan[0], fan[1]);
            if (!is_upper) std::swap(cap[1], cap[2]);
            soup.add_face(fan);
            if (i > 0) soup.add_face(cap);
        }
    }
    return soup;
}

TEST(Degenerate, SliverOfManyCapsIsFlippedAway) {
    for (const std::uint32_t upper : {1U, 2U, 7U, 60U})
        for (const std::uint32_t lower : {1U, 3U, 50U}) {
            SCOPED_TRACE(upper * 1000 + lower);
            const Repaired out = repair_and_check(lens(upper, lower));
            EXPECT_EQ(count_boundary_edges(out.soup), 4U);
            EXPECT_NEAR(total_area(out.soup), 3, 1e-12);
            EXPECT_EQ(out.report.count(Defect::zero_area_dropped), 0U);
        }
}

}  // namespace
}  // namespace delmesh::test
