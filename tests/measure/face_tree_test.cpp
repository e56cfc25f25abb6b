#include "measure/face_tree.hpp"

#include "measure/meshes.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace delmesh::measure {
namespace {

using delmesh::test::Random;
using LongVec = std::array<long double, 3>;

long double long_dot(const LongVec& a, const LongVec& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
LongVec along(const LongVec& a, long double t, const LongVec& b) {
    return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
}
LongVec difference(const Vec3& a, const Vec3& b) {
    return {static_cast<long double>(a.x) - b.x, static_cast<long double>(a.y) - b.y,
            static_cast<long double>(a.z) - b.z};
}

/// The distance in long doubles by narrowing: slow, plain, without cases. With x = a + u ab + v ac the distance is
/// convex in (u, v); so is its minimum over v, as a function of u.
long double narrowed_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const LongVec pa = difference(a, p), ab = difference(b, a), ac = difference(c, a);
    const long double ac2 = long_dot(ac, ac);
    const auto best_over_v = [&](long double u) {
        const LongVec x = along(pa, u, ab);
        const long double v = ac2 > 0 ? std::min(1 - u, std::max(0.0L, -long_dot(x, ac) / ac2)) : 0;
        const LongVec y = along(x, v, ac);
        return std::sqrt(long_dot(y, y));
    };
    long double low = 0, high = 1;
    for (int i = 0; i < 150; ++i) {
        const long double s = low + (high - low) * 0.382L, t = low + (high - low) * 0.618L;
        if (best_over_v(s) <= best_over_v(t)) {
            high = t;
        } else {
            low = s;
        }
    }
    return std::min({best_over_v(low), best_over_v(high), best_over_v(0), best_over_v(1)});
}

struct Case {
    Vec3 p, a, b, c;
};

/// Triangles of all shapes with points near and far, on them and above them.
std::vector<Case> cases() {
    std::vector<Case> all;
    Random random(5);
    const auto vector = [&](double size) {
        return Vec3{size * random.real(-1, 1), size * random.real(-1, 1), size * random.real(-1, 1)};
    };
    for (int i = 0; i < 1500; ++i) {
        const double thin = std::pow(10.0, -(i % 18));
        const Vec3 a = vector(1), b = vector(1);
        Vec3 c = i % 3 == 0   ? vector(1)
                 : i % 3 == 1 ? a + random.real(-1, 1) * (b - a) + vector(thin)
                              : a + vector(thin);
        const double u = random.real(-1, 1), v = random.real(-1, 1);
        const Vec3 over = a + u * (b - a) + v * (c - a);
        const double distance = std::pow(10.0, -(i % 7) * 3);
        all.push_back({over + vector(distance), a, b, c});
        all.push_back({i % 2 == 0 ? a : c, a, b, c});
    }
    return all;
}

TEST(Triangle, DistanceAgreesWithNarrowing) {
    for (const Case& k : cases()) {
        const auto expected = static_cast<double>(narrowed_distance(k.p, k.a, k.b, k.c));
        const double d = std::sqrt(squared_distance(k.p, longest_first(k.a, k.b, k.c)));
        EXPECT_NEAR(d, expected, 4e-12);  // slivers below 2^-40 are taken for their edges
    }
}

TEST(Triangle, DistanceIsRightToTheLastBitsForTrianglesWithAHeight) {
    for (const Case& k : cases()) {
        const Vec3 ab = k.b - k.a, ac = k.c - k.a, bc = k.c - k.b;
        const double longest = std::max(norm(ab), std::max(norm(ac), norm(bc)));
        if (norm(cross(ab, ac)) < 1e-9 * longest * longest) continue;
        const auto expected = static_cast<double>(narrowed_distance(k.p, k.a, k.b, k.c));
        EXPECT_NEAR(std::sqrt(squared_distance(k.p, longest_first(k.a, k.b, k.c))), expected, 1e-14);
    }
}

TEST(Triangle, BoundsEncloseTheDistance) {
    for (const Case& k : cases()) {
        const auto expected = static_cast<double>(narrowed_distance(k.p, k.a, k.b, k.c));
        const Triangle t = longest_first(k.a, k.b, k.c);
        EXPECT_LE(lower_distance(k.p, t), expected + 1e-14);
        EXPECT_GE(upper_distance(k.p, t), expected - 1e-14);
        EXPECT_NEAR(upper_distance(k.p, t), expected, 4e-12);
    }
}

TEST(EightBoxes, PortableAndVectorisedCodeAgree) {
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        EightBoxes boxes;
        for (int axis = 0; axis < 3; ++axis) {
            for (std::size_t lane = 0; lane < EightBoxes::count; ++lane) {
                const double x = random.real(-1, 1), y = random.real(-1, 1);
                boxes.low[axis][lane] = static_cast<float>(std::min(x, y));
                boxes.high[axis][lane] = static_cast<float>(std::max(x, y));
            }
            boxes.low[axis][7] = std::numeric_limits<float>::infinity();  // absent
            boxes.high[axis][7] = -std::numeric_limits<float>::infinity();
        }
        const std::array<float, 3> p{static_cast<float>(random.real(-1, 1)), static_cast<float>(random.real(-1, 1)),
                                     0.0F};
        BoxDistances one, two;
        find_near(boxes, p, 1e-3F, 0.2F, one);
        portable::find_near(boxes, p, 1e-3F, 0.2F, two);
        EXPECT_EQ(one.near, two.near);
        EXPECT_EQ(one.squared, two.squared);
        EXPECT_EQ(one.near & 0x80U, 0U);
    }
}

/// Points of the family, scaled into the cube that the tree asks for.
std::vector<Vec3> in_cube(const PolygonSoup& soup) {
    double largest = 0;
    for (const Vec3& p : soup.points) largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    const int exponent = largest > 0 ? -std::ilogb(largest) - 1 : 0;
    return delmesh::testing::scaled(soup, exponent).points;
}

TEST(FaceTree, FindsTheMinimumOverAllTrianglesWhateverTheHint) {
    for (const test::NamedSoup& family : test::families()) {
        SCOPED_TRACE(family.name);
        const std::vector<Vec3> points = in_cube(family.soup);
        const FaceTree tree(points, family.soup.corners, nullptr);
        ASSERT_EQ(tree.triangles().size(), family.soup.corners.size() / 3);
        Random random(9);
        const auto count = static_cast<std::uint32_t>(tree.triangles().size());
        for (int i = 0; i < 40; ++i) {
            const Vec3 off{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
            const double size = std::pow(10.0, -(i % 10));
            const Vec3 p = i % 10 == 0 ? off : points[random.bits() % points.size()] + size * off;
            FaceTree::Nearest expected{std::numeric_limits<double>::infinity(), 0};
            double lower = expected.distance2;
            for (std::uint32_t t = 0; t < count; ++t) {
                const double d2 = squared_distance(p, tree.triangles()[t]);
                if (d2 < expected.distance2) expected = {d2, t};
                lower = std::min(lower, lower_distance(p, tree.triangles()[t]));
            }
            for (int k = 0; k < 2; ++k) {
                const auto hint = static_cast<std::uint32_t>(random.bits() % count);
                const FaceTree::Nearest found = tree.nearest(p, hint);
                EXPECT_EQ(found.distance2, expected.distance2);
                EXPECT_EQ(found.triangle, expected.triangle);
                EXPECT_NEAR(tree.lower_distance(p, hint), lower, 1e-15);
            }
        }
    }
}

TEST(FaceTree, OrderDoesNotDependOnTheNumberOfThreads) {
    const PolygonSoup soup = delmesh::testing::torus_soup(200, 150, 0.01);
    Context one({}, 1), three({}, 3);
    const FaceTree a(soup.points, soup.corners, &one), b(soup.points, soup.corners, &three);
    EXPECT_TRUE(std::equal(a.faces().begin(), a.faces().end(), b.faces().begin(), b.faces().end()));
}

}  // namespace
}  // namespace delmesh::measure
