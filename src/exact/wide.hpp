#pragma once
// Signed integers of a fixed number of 64-bit words, on the stack. A product is as wide as both factors together, so it
// is never cut; who adds must have left a bit for the carry (docs/exact.md has the budget of bits).

#include <array>
#include <cstddef>
#include <cstdint>

namespace delmesh::exact {

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 Uint128;

/// Two's complement, the least significant word first.
template <std::size_t words>
struct Wide {
    std::array<std::uint64_t, words> word{};

    bool is_negative() const { return static_cast<std::int64_t>(word[words - 1]) < 0; }
    /// -1, 0 or 1.
    int sign() const {
        std::uint64_t any = 0;
        for (const std::uint64_t w : word) any |= w;
        return is_negative() ? -1 : static_cast<int>(any != 0);
    }

    friend Wide operator+(const Wide& a, const Wide& b) {
        Wide sum;
        Uint128 carry = 0;
        for (std::size_t i = 0; i < words; ++i) {
            carry += static_cast<Uint128>(a.word[i]) + b.word[i];
            sum.word[i] = static_cast<std::uint64_t>(carry);
            carry >>= 64;
        }
        return sum;
    }
    friend Wide operator-(const Wide& a, const Wide& b) {
        Wide difference;
        Uint128 carry = 1;  // a - b = a + ~b + 1
        for (std::size_t i = 0; i < words; ++i) {
            carry += static_cast<Uint128>(a.word[i]) + ~b.word[i];
            difference.word[i] = static_cast<std::uint64_t>(carry);
            carry >>= 64;
        }
        return difference;
    }
};

template <>
struct Wide<1> {
    std::int64_t value = 0;

    int sign() const { return static_cast<int>(value > 0) - static_cast<int>(value < 0); }
    /// Modulo 2^64: right whenever the true difference fits, even if a and b are known modulo 2^64 only.
    friend Wide operator-(Wide a, Wide b) {
        return {static_cast<std::int64_t>(static_cast<std::uint64_t>(a.value) - static_cast<std::uint64_t>(b.value))};
    }
};

template <>
struct Wide<2> {
    Int128 value = 0;

    int sign() const { return static_cast<int>(value > 0) - static_cast<int>(value < 0); }
    friend Wide operator+(Wide a, Wide b) { return {a.value + b.value}; }
    /// Modulo 2^128, likewise.
    friend Wide operator-(Wide a, Wide b) {
        return {static_cast<Int128>(static_cast<Uint128>(a.value) - static_cast<Uint128>(b.value))};
    }
};

inline std::array<std::uint64_t, 1> words_of(Wide<1> a) {
    return {static_cast<std::uint64_t>(a.value)};
}
inline std::array<std::uint64_t, 2> words_of(Wide<2> a) {
    return {static_cast<std::uint64_t>(a.value), static_cast<std::uint64_t>(a.value >> 64)};
}
template <std::size_t words>
const std::array<std::uint64_t, words>& words_of(const Wide<words>& a) {
    return a.word;
}

/// The product of the words, taken as numbers without sign.
template <std::size_t m, std::size_t n>
std::array<std::uint64_t, m + n> unsigned_product(const std::array<std::uint64_t, m>& a,
                                                  const std::array<std::uint64_t, n>& b) {
    std::array<std::uint64_t, m + n> product;
    product.fill(0);
    for (std::size_t i = 0; i < m; ++i) {
        std::uint64_t carry = 0;
        for (std::size_t j = 0; j < n; ++j) {
            const Uint128 sum = static_cast<Uint128>(a[i]) * b[j] + product[i + j] + carry;
            product[i + j] = static_cast<std::uint64_t>(sum);
            carry = static_cast<std::uint64_t>(sum >> 64);
        }
        product[i + n] = carry;
    }
    return product;
}

/// Subtracts (b and mask) from the words of `a` that start at `from`, where b fills the rest of them.
template <std::size_t from, std::size_t m, std::size_t n>
void subtract_above(std::array<std::uint64_t, m>& a, const std::array<std::uint64_t, n>& b, std::uint64_t mask) {
    static_assert(from + n == m);
    Uint128 carry = 1;
    for (std::size_t i = 0; i < n; ++i) {
        carry += static_cast<Uint128>(a[from + i]) + ~(b[i] & mask);
        a[from + i] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
    }
}

/// All ones if the number is negative, else zero.
template <std::size_t n>
std::uint64_t sign_mask(const std::array<std::uint64_t, n>& a) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(a[n - 1]) >> 63);
}

inline Wide<2> operator*(Wide<1> a, Wide<1> b) {
    return {static_cast<Int128>(a.value) * b.value};
}

/// As two's complement, a negative factor counts as 2^(64 words) too much: taken off where that shows.
template <std::size_t m, std::size_t n>
Wide<m + n> operator*(const Wide<m>& a, const Wide<n>& b) {
    const auto x = words_of(a);
    const auto y = words_of(b);
    auto product = unsigned_product(x, y);
    const std::uint64_t x_negative = sign_mask(x), y_negative = sign_mask(y);
    // Long factors are nearly always squares and lengths, hence a branch; the signs of short ones cannot be predicted.
    if (m + n > 4 && (x_negative | y_negative) == 0) return {product};
    subtract_above<m>(product, y, x_negative);
    subtract_above<n>(product, x, y_negative);
    return {product};
}

inline Wide<2> square(Wide<1> a) {
    return a * a;
}

/// From the magnitude: no sign to put right.
template <std::size_t n>
Wide<n + n> square(const Wide<n>& a) {
    const auto magnitude = words_of(a.sign() < 0 ? Wide<n>{} - a : a);
    return {unsigned_product(magnitude, magnitude)};
}

}  // namespace delmesh::exact
