#include "delaunay/split_point.hpp"

#include "delmesh/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace delmesh {
namespace {

Mesh triangle(double length) {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {length, 0, 0}, {0.5 * length, 0.1 * length, 0}};
    soup.corners = {0, 1, 2};
    return Mesh(soup);
}

double shell_distance(double length, double unit) {
    return shell_parameter({VertexId(0), VertexId(1), 0, 1}, length, unit) * length;
}

TEST(ShellParameter, IsThePowerOfTwoNearestToTheMiddle) {
    // By search over all powers: |radius - length / 2| is least, ties to the shorter.
    for (double length = 0.01; length < 300; length *= 1.013) {
        double best = 0;
        for (int k = -20; k < 20; ++k) {
            const double radius = std::ldexp(1.0, k);
            if (radius < length && std::fabs(radius - length / 2) < std::fabs(best - length / 2)) best = radius;
        }
        EXPECT_NEAR(shell_distance(length, 1.0), best, 1e-12 * length) << length;
    }
}

TEST(ShellParameter, FollowsTheUnit) {
    EXPECT_NEAR(shell_distance(10, 3), 6, 1e-12);
    EXPECT_NEAR(shell_distance(1e-200, 1e-200), 0.5e-200, 1e-212);
    EXPECT_NEAR(shell_distance(1e200, 1) / 1e200, 0.5, 0.17);
}

TEST(ShellParameter, IsMeasuredFromAnEndOfTheEdgeWhereThePartReachesOne) {
    // On [5, 8] from b: the shells at 1 and 2 are equally near to 1.5, and the shorter one wins.
    EXPECT_DOUBLE_EQ(shell_parameter({VertexId(0), VertexId(1), 5.0 / 8, 1}, 8, 1), 7.0 / 8);
    EXPECT_DOUBLE_EQ(shell_parameter({VertexId(0), VertexId(1), 1, 5.0 / 8}, 8, 1), 7.0 / 8);
    // From a part's own end in the middle of the edge.
    EXPECT_DOUBLE_EQ(shell_parameter({VertexId(0), VertexId(1), 5.0 / 8, 7.0 / 8}, 8, 1), 6.0 / 8);
}

TEST(ShellParameter, IsNotANumberWhereDoublesEnd) {
    EXPECT_TRUE(std::isnan(shell_distance(1e-300, 1e300)));
    EXPECT_TRUE(std::isnan(shell_distance(1e300, 1e-300)));
}

TEST(PointBetween, StaysWithinTwoUlpsAndInTheBox) {
    const double eps = std::numeric_limits<double>::epsilon();
    for (int i = 1; i < 1000; ++i) {
        const double t = i / 1000.0;
        const Vec3 a{1.0 / i, -3e5 * i, 1e300};
        const Vec3 b{7.0 / i, 2e5 + i, -1e300};
        const Vec3 p = point_between(a, b, t, Precision::float64);
        for (int axis = 0; axis < 3; ++axis) {
            const long double exact = (1.0L - t) * a[axis] + static_cast<long double>(t) * b[axis];
            const double largest = std::max(std::fabs(a[axis]), std::fabs(b[axis]));
            EXPECT_LE(std::fabs(static_cast<double>(p[axis] - exact)), 2 * eps * largest);
            EXPECT_GE(p[axis], std::min(a[axis], b[axis]));
            EXPECT_LE(p[axis], std::max(a[axis], b[axis]));
        }
    }
}

TEST(PointBetween, RoundsToFloats) {
    const Vec3 p = point_between({0, 0, 0}, {1, 1, 1}, 1.0 / 3, Precision::float32);
    EXPECT_EQ(p.x, static_cast<double>(static_cast<float>(1.0 / 3)));
}

TEST(PartOfInputEdge, SurvivesSplits) {
    Mesh mesh = triangle(8);
    MarkedMesh marked(mesh, std::vector<Mark>(3, Mark::physical), {FaceId(0)});
    marked.split(HalfedgeId(0), {VertexId(0), VertexId(1), 0.5}, {4, 0, 0});
    const EdgePart left = part_of_input_edge(marked, HalfedgeId(0));
    EXPECT_EQ(left.from, 0.0);
    EXPECT_EQ(left.to, 0.5);
    marked.split(HalfedgeId(0), {VertexId(0), VertexId(1), 0.25}, {2, 0, 0});
    const HalfedgeId middle = mesh.find_halfedge(VertexId(4), VertexId(3));
    ASSERT_TRUE(middle.valid());
    const EdgePart part = part_of_input_edge(marked, middle);
    EXPECT_EQ(part.a, VertexId(0));
    EXPECT_EQ(part.b, VertexId(1));
    EXPECT_EQ(part.from, 0.25);
    EXPECT_EQ(part.to, 0.5);
}

}  // namespace
}  // namespace delmesh
