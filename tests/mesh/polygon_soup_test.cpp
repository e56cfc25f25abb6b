#include "delmesh/mesh/polygon_soup.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

namespace delmesh {
namespace {

using Polygon = std::vector<std::uint32_t>;

PolygonSoup one_polygon(std::vector<Vec3> points) {
    PolygonSoup soup;
    soup.points = std::move(points);
    Polygon polygon(soup.points.size());
    std::iota(polygon.begin(), polygon.end(), 0u);
    soup.add_face(polygon);
    return soup;
}

Vec3 area_vector(const std::vector<Vec3>& points, std::span<const std::uint32_t> face) {
    Vec3 area;
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        area = area + cross(points[face[i]] - points[face[0]], points[face[i + 1]] - points[face[0]]);
    }
    return area * 0.5;
}

/// The triangles of a triangulated polygon use each of its sides once and every other edge twice, in opposite
/// directions: they are a disk with the polygon's outline.
void expect_disk(const PolygonSoup& soup, std::span<const std::uint32_t> polygon) {
    ASSERT_TRUE(soup.is_triangles());
    ASSERT_EQ(soup.face_count(), polygon.size() - 2);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const auto t = soup.face(f);
        for (std::size_t i = 0; i < 3; ++i) {
            ++count[{t[i], t[(i + 1) % 3]}];
            --count[{t[(i + 1) % 3], t[i]}];
        }
    }
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::uint32_t a = polygon[i];
        const std::uint32_t b = polygon[(i + 1) % polygon.size()];
        --count[{a, b}];
        ++count[{b, a}];
    }
    for (const auto& [edge, n] : count) EXPECT_EQ(n, 0) << edge.first << " " << edge.second;
}

/// All triangles turn the same way as the polygon, and their areas add up to its own: they tile it.
void expect_tiling(std::vector<Vec3> points, const Vec3& normal) {
    PolygonSoup soup = one_polygon(std::move(points));
    const Polygon polygon = soup.corners;
    const double area = dot(area_vector(soup.points, polygon), normal);
    triangulate(soup);
    expect_disk(soup, polygon);
    double sum = 0;
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const double part = dot(area_vector(soup.points, soup.face(f)), normal);
        EXPECT_GT(part, 0) << f;
        sum += part;
    }
    EXPECT_NEAR(sum, area, 1e-12 * area);
}

TEST(PolygonSoup, TrianglesNeedNoStarts) {
    PolygonSoup soup;
    soup.add_face(Polygon{0, 1, 2});
    soup.add_face(Polygon{2, 1, 3});
    EXPECT_TRUE(soup.is_triangles());
    EXPECT_EQ(soup.face_count(), 2u);
    soup.add_face(Polygon{0, 1, 2, 3});
    soup.add_face(Polygon{});
    soup.add_face(Polygon{3, 2, 1});
    EXPECT_EQ(soup.starts, (std::vector<std::size_t>{0, 3, 6, 10, 10, 13}));
    EXPECT_EQ(soup.face(2).size(), 4u);
    EXPECT_EQ(soup.face(4)[0], 3u);
}

TEST(PolygonSoup, AFirstPolygonThatIsNoTriangle) {
    PolygonSoup soup;
    soup.add_face(Polygon{0, 1});
    EXPECT_EQ(soup.face_count(), 1u);
    EXPECT_EQ(soup.face(0).size(), 2u);
}

TEST(Triangulate, TrianglesStayInPlaceAndSmallFacesGo) {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (const Polygon& face : {Polygon{2, 0, 1}, {0, 1}, {3}, {}, {0, 1, 2, 3}, {1, 3, 2}}) soup.add_face(face);
    triangulate(soup);
    EXPECT_EQ(soup.corners, (Polygon{2, 0, 1, 0, 1, 2, 0, 2, 3, 1, 3, 2}));
    EXPECT_TRUE(soup.is_triangles());
}

TEST(Triangulate, ConvexPolygonsAndBentQuadsBecomeTheFanOfTheirFirstCorner) {
    for (int turn = 0; turn < 4; ++turn) {
        std::vector<Vec3> bent{{-3, 0, 1}, {0, -1, 0}, {3, 0, 1}, {0, 1, 0}};
        std::rotate(bent.begin(), bent.begin() + turn, bent.end());
        PolygonSoup soup = one_polygon(bent);
        triangulate(soup);
        EXPECT_EQ(soup.corners, (Polygon{0, 1, 2, 0, 2, 3}));
    }
    PolygonSoup hexagon = one_polygon({{2, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {-2, 0, 0}, {-1, -2, 0}, {1, -2, 0}});
    triangulate(hexagon);
    EXPECT_EQ(hexagon.corners, (Polygon{0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5}));
}

TEST(Triangulate, ConcaveQuadsAreCutInside) {
    for (int turn = 0; turn < 4; ++turn) {
        for (const double depth : {0.1, 0.5, 0.99}) {
            std::vector<Vec3> dart{{0, 0, 2}, {1, 0, 2}, {1 - depth, 1 - depth, 2}, {0, 1, 2}};
            if (depth == 0.1) dart[2] = {0.49, 0.49, 2};
            std::rotate(dart.begin(), dart.begin() + turn, dart.end());
            expect_tiling(dart, {0, 0, 1});
        }
    }
}

TEST(Triangulate, SizeDoesNotMatter) {
    const std::vector<Vec3> shape{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {3, 1, 0}, {1, 1, 0}, {0, 3, 0}};
    for (std::size_t corners : {4, 6}) {
        PolygonSoup expected = one_polygon({shape.begin(), shape.begin() + static_cast<std::ptrdiff_t>(corners)});
        triangulate(expected);
        for (const int exponent : {-1070, -600, -100, 100, 600, 1020}) {
            PolygonSoup soup = one_polygon({shape.begin(), shape.begin() + static_cast<std::ptrdiff_t>(corners)});
            for (Vec3& p : soup.points)
                p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
            triangulate(soup);
            EXPECT_EQ(soup.corners, expected.corners) << exponent;
        }
    }
}

/// A star with `tips` tips, in a plane with the given axes.
std::vector<Vec3> star(int tips, const Vec3& u, const Vec3& v) {
    std::vector<Vec3> points;
    for (int i = 0; i < 2 * tips; ++i) {
        const double angle = std::numbers::pi * i / tips;
        const double radius = i % 2 == 0 ? 1 : 0.3;
        points.push_back(radius * std::cos(angle) * u + radius * std::sin(angle) * v + Vec3{7, -5, 3});
    }
    return points;
}

TEST(Triangulate, ConcavePolygonsAreTiled) {
    const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const int tips : {3, 5, 16, 100}) {
        for (int i = 0; i < 3; ++i) {
            expect_tiling(star(tips, axes[i], axes[(i + 1) % 3]), axes[(i + 2) % 3]);
            expect_tiling(star(tips, axes[(i + 1) % 3], axes[i]), -axes[(i + 2) % 3]);
        }
        expect_tiling(star(tips, {0.6, 0, 0.8}, {0.48, 0.8, -0.36}), cross({0.6, 0, 0.8}, {0.48, 0.8, -0.36}));
    }
}

TEST(Triangulate, SpiralsAndCombsAreTiled) {
    std::vector<Vec3> comb;
    for (int i = 0; i < 40; ++i) comb.push_back({1.0 * i, i % 2 == 0 ? 0.0 : 9.0, 0});
    comb.push_back({39, 10, 0});
    comb.push_back({0, 10, 0});
    expect_tiling(comb, {0, 0, 1});
    std::vector<Vec3> spiral;
    for (int i = 0; i <= 60; ++i) spiral.push_back({(i + 1) * std::cos(0.3 * i), (i + 1) * std::sin(0.3 * i), 0});
    for (int i = 60; i >= 0; --i) spiral.push_back({(i + 4) * std::cos(0.3 * i), (i + 4) * std::sin(0.3 * i), 0});
    std::reverse(spiral.begin(), spiral.end());
    expect_tiling(spiral, {0, 0, 1});
}

TEST(Triangulate, PointsInTheMiddleOfSidesAreKept) {
    expect_tiling({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}}, {0, 0, 1});
    expect_tiling({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {0, 0, 1});
    expect_tiling({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 2, 0}}, {0, 0, 1});
}

TEST(Triangulate, HolesJoinedToTheOutline) {
    // A square with a square hole, joined by a cut that is run through in both directions.
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
    const Polygon polygon{0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
    soup.add_face(polygon);
    triangulate(soup);
    expect_disk(soup, polygon);
    double area = 0;
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const double part = area_vector(soup.points, soup.face(f)).z;
        EXPECT_GT(part, 0);
        area += part;
    }
    EXPECT_DOUBLE_EQ(area, 8);
}

TEST(Triangulate, WhatCanNotBeCutBecomesAFan) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const std::vector<Vec3>& points :
         {std::vector<Vec3>{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {-1, 1, 0}},  // crosses itself
          std::vector<Vec3>(6, Vec3{1, 1, 1}),                                        // no extent
          {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},                    // on a line
          {{0, 0, 0}, {1, 0, 0}, {1, infinity, 0}, {0, 1, 0}, {0, 0.5, 0}}}) {
        PolygonSoup soup = one_polygon(points);
        const Polygon polygon = soup.corners;
        triangulate(soup);
        expect_disk(soup, polygon);
        for (std::size_t f = 0; f < soup.face_count(); ++f) EXPECT_EQ(soup.face(f)[0], 0u);
    }
}

TEST(Triangulate, LargePolygonsBecomeFans) {
    std::vector<Vec3> circle;
    for (int i = 0; i < 100'000; ++i) circle.push_back({std::cos(i * 6e-5), std::sin(i * 6e-5), 0});
    PolygonSoup soup = one_polygon(circle);
    const Polygon polygon = soup.corners;
    triangulate(soup);
    expect_disk(soup, polygon);
}

TEST(Triangulate, RepeatedAndMissingVerticesAreLeftToTheMeshBuilder) {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    soup.add_face(Polygon{0, 1, 1, 2});
    soup.add_face(Polygon{0, 1, 2, 99});
    soup.add_face(Polygon{0, 0, 0, 0, 0});
    triangulate(soup);
    EXPECT_EQ(soup.face_count(), 2u + 2u + 3u);
    EXPECT_NE(std::ranges::find(soup.corners, 99u), soup.corners.end());
}

}  // namespace
}  // namespace delmesh
