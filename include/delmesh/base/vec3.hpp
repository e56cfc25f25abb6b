#pragma once
// Three doubles and the few operations that geometry needs. No SIMD, no templates: the compiler does that well.

#include <array>
#include <cmath>

namespace delmesh {

struct Vec3 {
    double x = 0;
    double y = 0;
    double z = 0;

    /// Bitwise in effect but for -0 == +0; NaN differs from itself.
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;

    constexpr double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(Vec3 a) {
    return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(Vec3 a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
constexpr Vec3 operator*(double s, Vec3 a) {
    return a * s;
}
constexpr double dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double squared_norm(Vec3 a) {
    return dot(a, a);
}

/// Euclidean length. Neither overflows nor underflows where the result is a double. A few ulps.
inline double norm(Vec3 a) {
    const double largest = std::fmax(std::fabs(a.x), std::fmax(std::fabs(a.y), std::fabs(a.z)));
    if (largest > 1e-140 && largest < 1e140) return std::sqrt(squared_norm(a));
    if (!(largest > 0) || std::isinf(largest)) return largest;
    const int exponent = std::ilogb(largest);
    const Vec3 scaled{std::scalbn(a.x, -exponent), std::scalbn(a.y, -exponent), std::scalbn(a.z, -exponent)};
    return std::scalbn(std::sqrt(squared_norm(scaled)), exponent);
}

inline bool is_finite(Vec3 a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace delmesh
