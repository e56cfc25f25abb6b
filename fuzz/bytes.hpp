#pragma once
// Random bytes as numbers and meshes: small grids, values a last place apart, and any double at all, because that is
// where exact signs and degenerate surfaces live.

#include "delmesh/base/vec3.hpp"
#include "delmesh/mesh/polygon_soup.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace delmesh::fuzz {

/// The bytes of an input from the front; zeros when they are used up.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

    [[nodiscard]] bool empty() const { return left_.empty(); }
    std::uint8_t byte() {
        if (left_.empty()) return 0;
        const std::uint8_t value = left_.front();
        left_ = left_.subspan(1);
        return value;
    }
    std::uint32_t below(std::uint32_t n) { return byte() % n; }
    std::uint64_t bits() {
        std::uint64_t value = 0;
        for (int i = 0; i < 8; ++i) value = value << 8 | byte();
        return value;
    }

private:
    std::span<const std::uint8_t> left_;
};

enum class Style : std::uint8_t { grid, near_grid, floats, wide, any };
inline constexpr std::uint32_t styles = 5;

/// One coordinate. Only `any` gives infinities and NaNs.
inline double coordinate(Bytes& bytes, Style style) {
    const auto small = static_cast<double>(static_cast<std::int8_t>(bytes.byte()) % 4);
    switch (style) {
        case Style::grid:
            return small;
        case Style::near_grid: {
            const std::uint8_t places = bytes.byte();
            const double away = places & 1 ? 1e9 : -1e9;
            double value = small;
            for (int i = 0; i < places % 8; i += 2) value = std::nextafter(value, away);
            return value;
        }
        case Style::floats:
            return small + static_cast<double>(static_cast<float>(bytes.byte()) / 300.0F);
        case Style::wide:
            return std::ldexp(small, (static_cast<int>(bytes.byte()) - 128) * 4);
        case Style::any:
            break;
    }
    return bytes.byte() % 4 == 0 ? std::bit_cast<double>(bytes.bits()) : small;
}

inline Vec3 point(Bytes& bytes, Style style) {
    Vec3 p;
    for (const int axis : {0, 1, 2}) p[axis] = coordinate(bytes, style);
    return p;
}

/// Up to 24 points, and polygons over them as long as there are bytes.
inline PolygonSoup soup(Bytes& bytes) {
    PolygonSoup result;
    const auto style = static_cast<Style>(bytes.below(styles));
    const std::uint32_t points = 3 + bytes.below(22);
    const double scale = std::ldexp(1.0, (static_cast<int>(bytes.below(9)) - 4) * 120);
    const bool wild_indices = bytes.below(8) == 0;
    for (std::uint32_t i = 0; i < points; ++i) {
        Vec3 p = point(bytes, style);
        if (style != Style::any && style != Style::wide) p = {p.x * scale, p.y * scale, p.z * scale};
        result.points.push_back(p);
    }
    while (!bytes.empty()) {
        std::array<std::uint32_t, 6> polygon{};
        const std::uint32_t kind = bytes.below(16);
        const std::size_t corners = kind == 0 ? 4 : kind == 1 ? bytes.below(7) : 3;
        for (std::size_t i = 0; i < corners; ++i) polygon[i] = bytes.below(points + (wild_indices ? 1 : 0));
        result.add_face(std::span(polygon.data(), corners));
    }
    return result;
}

}  // namespace delmesh::fuzz
