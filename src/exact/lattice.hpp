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

/// Without branches: which coordinates are zero or negative cannot be predicted.
inline Dyadic decompose(double value) {
    constexpr std::uint64_t leading = std::uint64_t{1} << 52;
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const int biased = static_cast<int>(bits >> 52) & 0x7ff;
    const std::uint64_t magnitude = (bits & (leading - 1)) | (biased == 0 ? 0 : leading);
    const int zeros = std::countr_zero(magnitude | leading << 1);
    const auto odd = static_cast<std::int64_t>(magnitude >> zeros);
    const std::int64_t negative = static_cast<std::int64_t>(bits) >> 63;
    return {(odd ^ negative) - negative, magnitude == 0 ? Dyadic::no_exponent : std::max(biased, 1) - 1075 + zeros};
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
