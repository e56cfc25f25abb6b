#pragma once
// Doubles are integers times a power of two: a common exponent turns a handful of points into integers.

#include "delmesh/base/vec3.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace delmesh::exact {

/// mantissa * 2^exponent, the mantissa odd or zero (then the exponent is `no_exponent`).
struct Dyadic {
    static constexpr int no_exponent = 4096;  // above that of any double

    std::int64_t mantissa = 0;
    int exponent = no_exponent;
};

inline Dyadic decompose(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const int biased = static_cast<int>(bits >> 52) & 0x7ff;
    const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
    const std::uint64_t magnitude = biased == 0 ? fraction : fraction | (std::uint64_t{1} << 52);
    if (magnitude == 0) return {};
    const int zeros = std::countr_zero(magnitude);
    const auto odd = static_cast<std::int64_t>(magnitude >> zeros);
    return {std::signbit(value) ? -odd : odd, std::max(biased, 1) - 1075 + zeros};
}

/// The least e with |value| < 2^e, for a normal value or infinity; for others, an upper bound of it.
inline int exponent_above(double value) {
    const auto biased = static_cast<int>(std::bit_cast<std::uint64_t>(value) >> 52) & 0x7ff;
    return std::max(biased, 1) - 1022;
}

struct DyadicPoint {
    Dyadic x, y, z;

    int exponent() const { return std::min(x.exponent, std::min(y.exponent, z.exponent)); }
};

inline DyadicPoint decompose(const Vec3& point) {
    return {decompose(point.x), decompose(point.y), decompose(point.z)};
}

}  // namespace delmesh::exact
