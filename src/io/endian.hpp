#pragma once
// Numbers of either byte order from any address.

#include <bit>
#include <cstdint>
#include <cstring>

namespace delmesh::io {

inline std::uint8_t swap_bytes(std::uint8_t v) {
    return v;
}
inline std::uint16_t swap_bytes(std::uint16_t v) {
    return static_cast<std::uint16_t>(v << 8 | v >> 8);
}
inline std::uint32_t swap_bytes(std::uint32_t v) {
    return v << 24 | (v & 0xff00u) << 8 | (v >> 8 & 0xff00u) | v >> 24;
}
inline std::uint64_t swap_bytes(std::uint64_t v) {
    return std::uint64_t{swap_bytes(static_cast<std::uint32_t>(v))} << 32 |
           swap_bytes(static_cast<std::uint32_t>(v >> 32));
}

template <std::size_t size>
struct BitsOf;
template <>
struct BitsOf<1> {
    using type = std::uint8_t;
};
template <>
struct BitsOf<2> {
    using type = std::uint16_t;
};
template <>
struct BitsOf<4> {
    using type = std::uint32_t;
};
template <>
struct BitsOf<8> {
    using type = std::uint64_t;
};

/// The number at `from`, which was written in the byte order `order`.
template <class T, std::endian order>
T load(const char* from) {
    typename BitsOf<sizeof(T)>::type bits;
    std::memcpy(&bits, from, sizeof bits);
    if constexpr (order != std::endian::native) bits = swap_bytes(bits);
    return std::bit_cast<T>(bits);
}

/// Puts a number to `to` in little-endian order; returns the address behind it.
template <class T>
char* store(char* to, T value) {
    auto bits = std::bit_cast<typename BitsOf<sizeof(T)>::type>(value);
    if constexpr (std::endian::native != std::endian::little) bits = swap_bytes(bits);
    std::memcpy(to, &bits, sizeof bits);
    return to + sizeof bits;
}

}  // namespace delmesh::io
