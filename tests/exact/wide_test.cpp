#include "exact/wide.hpp"

#include "exact/families.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

namespace delmesh::exact {
namespace {

using boost::multiprecision::cpp_int;

/// Words that carries like: all ones, the sign bit, small numbers; else random.
std::uint64_t any_word(families::Random& random) {
    switch (random.below(6)) {
        case 0:
            return 0;
        case 1:
            return ~std::uint64_t{0};
        case 2:
            return std::uint64_t{1} << 63;
        case 3:
            return static_cast<std::uint64_t>(random.below(3));
        default:
            return random.bits();
    }
}

template <std::size_t n>
Wide<n> any_wide(families::Random& random) {
    if constexpr (n == 1) {
        return {static_cast<std::int64_t>(any_word(random))};
    } else if constexpr (n == 2) {
        const Uint128 high = any_word(random);
        return {static_cast<Int128>(high << 64 | any_word(random))};
    } else {
        Wide<n> result;
        for (auto& word : result.word) word = any_word(random);
        return result;
    }
}

template <std::size_t n>
cpp_int value_of(const Wide<n>& a) {
    const auto words = words_of(a);
    cpp_int result = 0;
    for (std::size_t i = n; i-- > 0;) result = (result << 64) + words[i];
    if (words[n - 1] >> 63 != 0) result -= cpp_int(1) << (64 * n);
    return result;
}

template <std::size_t n>
bool fits(const cpp_int& value) {
    const cpp_int limit = cpp_int(1) << (64 * n - 1);
    return -limit <= value && value < limit;
}

template <std::size_t m, std::size_t n>
void expect_arithmetic() {
    families::Random random(m * 100 + n);
    for (int i = 0; i < 3000; ++i) {
        const auto a = any_wide<m>(random), c = any_wide<m>(random);
        const auto b = any_wide<n>(random);
        const cpp_int x = value_of(a), y = value_of(b), z = value_of(c);
        ASSERT_EQ(a.sign(), x.sign());
        ASSERT_EQ(value_of(a * b), cpp_int(x * y)) << x << " * " << y;
        ASSERT_EQ(value_of(square(a)), cpp_int(x * x)) << x;
        if (fits<m>(cpp_int(x - z))) {
            ASSERT_EQ(value_of(a - c), cpp_int(x - z)) << x << " - " << z;
        }
        if constexpr (m > 1)
            if (fits<m>(cpp_int(x + z))) {
                ASSERT_EQ(value_of(a + c), cpp_int(x + z)) << x << " + " << z;
            }
    }
}

TEST(Wide, AgreesWithBigIntegersAtEveryWidthInUse) {
    expect_arithmetic<1, 1>();
    expect_arithmetic<2, 1>();
    expect_arithmetic<2, 2>();
    expect_arithmetic<4, 2>();
    expect_arithmetic<4, 4>();
    expect_arithmetic<8, 2>();
    expect_arithmetic<8, 8>();
    expect_arithmetic<16, 2>();
}

TEST(Wide, DifferencesWrapAround) {
    // Known modulo 2^64 only, yet the difference fits.
    const Wide<1> a{std::numeric_limits<std::int64_t>::min()}, b{std::numeric_limits<std::int64_t>::max()};
    EXPECT_EQ((a - b).value, 1);
    EXPECT_EQ((b - a).value, -1);
}

}  // namespace
}  // namespace delmesh::exact
