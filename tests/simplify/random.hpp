#pragma once
// Random numbers that are the same on every system.

#include "delmesh/base/vec3.hpp"

#include <cstdint>

namespace delmesh::test {

class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    /// splitmix64.
    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [low, high).
    double real(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % n); }
    Vec3 vec(double reach) { return {real(-reach, reach), real(-reach, reach), real(-reach, reach)}; }

private:
    std::uint64_t state_;
};

}  // namespace delmesh::test
