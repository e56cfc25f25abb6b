#pragma once
// Random numbers that are the same on every system (the standard library's distributions are not).

#include "delmesh/base/vec3.hpp"

#include <concepts>
#include <cstdint>

namespace delmesh::test {

/// splitmix64 (Steele, Lea, Flood 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31U);
    }
    /// Uniform in 0 ... n-1, for n > 0 far below 2^64.
    template <std::integral Integer>
    Integer below(Integer n) {
        return static_cast<Integer>(bits() % static_cast<std::uint64_t>(n));
    }
    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
    /// Uniform in [low, high), or at `high` by rounding.
    double real(double low, double high) { return low + (high - low) * unit(); }
    /// Each coordinate in [-reach, reach).
    Vec3 vec(double reach) {
        const double x = real(-reach, reach);
        const double y = real(-reach, reach);
        const double z = real(-reach, reach);
        return {x, y, z};
    }

private:
    std::uint64_t state_;
};

}  // namespace delmesh::test
