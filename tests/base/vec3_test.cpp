#include "delmesh/base/vec3.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace delmesh {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Vec3, CrossProductIsRightHandedAndOrthogonal) {
    EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
    const Vec3 a{3, -5, 7};
    const Vec3 b{-2, 11, 4};
    EXPECT_EQ(dot(cross(a, b), a), 0);
    EXPECT_EQ(dot(cross(a, b), b), 0);
    EXPECT_EQ(squared_norm(cross(a, b)) + dot(a, b) * dot(a, b), squared_norm(a) * squared_norm(b));
}

TEST(Vec3, AxesAreInOrder) {
    Vec3 p{1, 2, 3};
    p[1] = 5;
    EXPECT_EQ(p[0], 1);
    EXPECT_EQ(p.y, 5);
    EXPECT_EQ(p[2], 3);
}

TEST(Vec3, NormHoldsOverTheWholeRangeOfDoubles) {
    // Lengths 13 times a power of two: exact wherever the coordinates are.
    for (int exponent = -1074; exponent <= 1018; ++exponent) {
        const double unit = std::scalbn(1.0, exponent);
        EXPECT_EQ(norm(Vec3{3 * unit, -4 * unit, 12 * unit}), 13 * unit) << exponent;
    }
    EXPECT_EQ(norm(Vec3{1e-300, 1e300, 0}), 1e300);
    EXPECT_EQ(norm(Vec3{0, 0, -0.0}), 0);
}

TEST(Vec3, NormAndIsFiniteSeeInfinityAndNan) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(norm(Vec3{1, -infinity, 2}), infinity);
    EXPECT_TRUE(is_finite(Vec3{1e308, -1e308, 5e-324}));
    EXPECT_FALSE(is_finite(Vec3{1, infinity, 2}));
    EXPECT_FALSE(is_finite(Vec3{1, 2, nan}));
    EXPECT_FALSE(Vec3({nan, 0, 0}) == Vec3({nan, 0, 0}));
    EXPECT_TRUE(Vec3({0, 0, 0}) == Vec3({-0.0, 0, 0}));
}

}  // namespace
}  // namespace delmesh
