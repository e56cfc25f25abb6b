#pragma once

#include <cstdint>

namespace delmesh {

/// SplitMix64: the same numbers everywhere. Source: Steele, Lea, Flood 2014.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
    /// In [0,1).
    double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
    /// In 0 ... count-1; count > 0.
    std::uint32_t below(std::size_t count) {
        return static_cast<std::uint32_t>(((next() >> 32) * static_cast<std::uint64_t>(count)) >> 32);
    }
    bool chance(double probability) { return uniform() < probability; }

private:
    std::uint64_t state_;
};

}  // namespace delmesh
