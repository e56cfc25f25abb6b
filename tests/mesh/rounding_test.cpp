#include "delmesh/mesh/rounding.hpp"

#include "delmesh/base/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace delmesh {
namespace {

/// Without a conversion that a compiler might take for nothing: 29 bits of the significand are cut off, ties to even.
double rounded_by_hand(double x) {
    int exponent = 0;
    const double significand = std::frexp(x, &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(significand, 24)), exponent - 24);
}

TEST(RoundToFloat, EveryCoordinateIsRounded) {
    for (int i = 1; i < 500; ++i) {
        const Vec3 p{1.0 / (3 * i), -0.7 * i, 0.9 / (7 * i)};
        const Vec3 expected{rounded_by_hand(p.x), rounded_by_hand(p.y), rounded_by_hand(p.z)};
        ASSERT_EQ(round_to_float(p), expected);
        PolygonSoup soup;
        soup.points.assign(5, p);
        EXPECT_DOUBLE_EQ(round_to_float(soup), norm(p - expected));
        for (const Vec3& q : soup.points) ASSERT_EQ(q, expected);
        EXPECT_EQ(soup.stored, Precision::float32);
    }
}

TEST(RoundToFloat, TooLargeIsAnErrorAndChangesNothing) {
    PolygonSoup soup;
    soup.points = {{0.1, 0, 0}, {0, 1e39, 0}};
    const auto before = soup.points;
    try {
        round_to_float(soup);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::not_finite);
        EXPECT_EQ(error.elements(), (std::vector<std::size_t>{1}));
    }
    EXPECT_EQ(soup.points, before);
}

}  // namespace
}  // namespace delmesh
