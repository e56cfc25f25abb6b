#include "delmesh/mesh/rounding.hpp"

#include "delmesh/base/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace delmesh {

std::span<const std::string_view> choices(Precision) {
    static constexpr std::string_view names[] = {"float", "double"};
    return names;
}

// Kept out of line: GCC 12 takes a vectorised double -> float -> double for nothing to do and leaves the value as it
// is.
[[gnu::noinline]] double round_to_float(double x) {
    return static_cast<double>(static_cast<float>(x));
}

Vec3 round_to_float(const Vec3& p) {
    return {round_to_float(p.x), round_to_float(p.y), round_to_float(p.z)};
}

double round_to_float(PolygonSoup& soup) {
    for (std::size_t i = 0; i < soup.points.size(); ++i) {
        if (is_finite(soup.points[i]) && !is_finite(round_to_float(soup.points[i])))
            throw Error(
                ErrorCode::not_finite,
                fmt::format("vertex {} is too large for single precision; write a format that stores doubles", i), {i},
                1);
    }
    double furthest = 0;
    for (Vec3& p : soup.points) {
        const Vec3 rounded = round_to_float(p);
        if (is_finite(p)) furthest = std::max(furthest, norm(rounded - p));
        p = rounded;
    }
    soup.stored = Precision::float32;
    return furthest;
}

}  // namespace delmesh
