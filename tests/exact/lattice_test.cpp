#include "exact/lattice.hpp"

#include "exact/families.hpp"

#include <gtest/gtest.h>

namespace delmesh::exact {
namespace {

TEST(Lattice, DecompositionIsExactAndOdd) {
    families::Random random(1);
    const double denormal = std::numeric_limits<double>::denorm_min();
    std::vector<double> values{denormal, 3 * denormal, 5e-320, std::numeric_limits<double>::min(),
                               1,        0.1,          1e300,  std::numeric_limits<double>::max()};
    for (int i = 0; i < 20000; ++i) values.push_back(random.any_double());
    for (const double magnitude : values)
        for (const double value : {magnitude, -magnitude}) {
            const Dyadic parts = decompose(value);
            ASSERT_NE(parts.mantissa % 2, 0) << value;
            ASSERT_EQ(std::ldexp(static_cast<double>(parts.mantissa), parts.exponent), value);
        }
}

TEST(Lattice, ZeroHasNoExponent) {
    for (const double zero : {0.0, -0.0}) {
        EXPECT_EQ(decompose(zero).mantissa, 0);
        EXPECT_EQ(decompose(zero).exponent, Dyadic::no_exponent);
    }
}

TEST(Lattice, ExponentAboveIsTightForNormalNumbers) {
    families::Random random(2);
    for (int i = 0; i < 20000; ++i) {
        const double value = random.any_double();
        if (std::fabs(value) < std::numeric_limits<double>::min()) continue;
        ASSERT_EQ(exponent_above(value), std::ilogb(value) + 1) << value;
    }
    EXPECT_EQ(exponent_above(1.0), 1);
    EXPECT_EQ(exponent_above(std::nextafter(1.0, 0.0)), 0);
    EXPECT_EQ(exponent_above(std::numeric_limits<double>::infinity()), 1025);
    EXPECT_LE(exponent_above(0.0), -1021);
    EXPECT_LE(exponent_above(5e-320), -1021);
}

}  // namespace
}  // namespace delmesh::exact
