#include "delmesh/mesh/stored_precision.hpp"

#include "delmesh/mesh/rounding.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace delmesh {
namespace {

std::vector<Vec3> random_points(std::size_t count, double reach) {
    test::Random random(7);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(random.vec(reach));
    return points;
}

/// As if written with a format of printf and read again.
std::vector<Vec3> through_text(std::vector<Vec3> points, const char* format) {
    for (Vec3& p : points) {
        for (const int axis : {0, 1, 2}) {
            char text[64];
            std::snprintf(text, sizeof text, format, p[axis]);
            p[axis] = std::strtod(text, nullptr);
        }
    }
    return points;
}

double largest(const std::vector<Vec3>& points) {
    double result = 0;
    for (const Vec3& p : points)
        for (const int axis : {0, 1, 2}) result = std::fmax(result, std::fabs(p[axis]));
    return result;
}

TEST(StoredRounding, OfFloatsAndDoublesIsHalfAnUlpOfTheLargestAtAnyScale) {
    for (const double reach : {1e-9, 3.0, 7e5}) {
        std::vector<Vec3> points = random_points(200, reach);
        EXPECT_EQ(stored_rounding(points), largest(points) * 0x1p-53);
        for (Vec3& p : points) p = round_to_float(p);
        EXPECT_EQ(stored_rounding(points), largest(points) * 0x1p-24);
        const double before = stored_rounding(points);
        for (Vec3& p : points) p = 0x1p300 * p;
        EXPECT_EQ(stored_rounding(points), 0x1p300 * before);
    }
}

TEST(StoredRounding, OfTextIsHalfAUnitOfTheLastDigitWritten) {
    const std::vector<Vec3> points = random_points(500, 40);
    EXPECT_DOUBLE_EQ(stored_rounding(through_text(points, "%.6g")), 0.5e-4);
    EXPECT_DOUBLE_EQ(stored_rounding(through_text(points, "%.7g")), 0.5e-5);
    EXPECT_DOUBLE_EQ(stored_rounding(through_text(points, "%.8g")), 0.5e-6);
    EXPECT_DOUBLE_EQ(stored_rounding(through_text(points, "%.6f")), 0.5e-6);
    EXPECT_DOUBLE_EQ(stored_rounding(through_text(points, "%.5f")), 0.5e-5);
    const std::vector<Vec3> full = through_text(points, "%.17g");
    EXPECT_EQ(stored_rounding(full), largest(full) * 0x1p-53);
}

TEST(StoredRounding, SeesTextThroughFloats) {
    std::vector<Vec3> points = through_text(random_points(500, 40), "%.6g");
    for (Vec3& p : points) p = round_to_float(p);
    EXPECT_DOUBLE_EQ(stored_rounding(points), 0.5e-4);
}

TEST(StoredRounding, DesignedNumbersAreNotTakenForRoundedOnes) {
    // Few digits: a tolerance of half a unit would swallow the shape.
    const std::vector<Vec3> designed{{0, 0, 1}, {12.5, 0.1, 0.25}, {100, 99.9, -3.125}};
    EXPECT_EQ(stored_rounding(designed), 100 * 0x1p-53);
    EXPECT_EQ(stored_rounding(std::vector<Vec3>{{1, 2, 3}}), 3 * 0x1p-24);
    EXPECT_EQ(stored_rounding({}), 0);
    EXPECT_EQ(stored_rounding(std::vector<Vec3>{{0, 0, 0}}), 0);
}

}  // namespace
}  // namespace delmesh
