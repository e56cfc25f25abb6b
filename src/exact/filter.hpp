#pragma once
// Tier 1: signs in plain doubles, each with a proved error bound, inline for hot loops. "No value" means: not proved
// here. docs/exact.md derives every bound; u is the unit roundoff 2^-53. Assumes IEEE doubles, rounding to nearest,
// gradual underflow. Never wrong for finite input: where something overflows or underflows, the filter does not decide.

#include "delmesh/base/vec3.hpp"
#include "delmesh/exact/sign.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace delmesh::exact {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53);

inline constexpr double unit_roundoff = 0x1p-53;
/// More than all that underflow can add to a sum of a few products; itself a normal number, since processors are slow
/// with others.
inline constexpr double underflow_allowance = 0x1p-1000;
/// Squared lengths in this range neither overflow nor underflow in polynomials of degree 8.
inline constexpr double smallest_square = 0x1p-200;
inline constexpr double largest_square = 0x1p200;

/// A value computed in doubles and a bound of its error; infinity or NaN where nothing is known.
struct Estimate {
    double value;
    double error;

    /// The sign of the exact value, if the estimate proves it.
    std::optional<Sign> sign() const {
        if (value > error) return Sign::positive;
        if (value < -error) return Sign::negative;
        return std::nullopt;
    }
    bool is_nonzero() const { return std::fabs(value) > error; }
};

inline constexpr Estimate nothing_known{0, std::numeric_limits<double>::infinity()};

/// Sum of |a_i b_i|.
inline double absolute_dot(const Vec3& a, const Vec3& b) {
    return std::fabs(a.x * b.x) + std::fabs(a.y * b.y) + std::fabs(a.z * b.z);
}

/// True if each product a_i b_i has a factor zero. A difference of doubles is zero only if it is so exactly: hence the
/// exact a.b is zero as well.
inline bool is_structurally_orthogonal(const Vec3& a, const Vec3& b) {
    return (a.x == 0 || b.x == 0) && (a.y == 0 || b.y == 0) && (a.z == 0 || b.z == 0);
}

/// True if all differences lie in one coordinate plane: their determinant is zero exactly.
inline bool are_structurally_coplanar(const Vec3& a, const Vec3& b, const Vec3& c) {
    return (a.x == 0 && b.x == 0 && c.x == 0) || (a.y == 0 && b.y == 0 && c.y == 0) ||
           (a.z == 0 && b.z == 0 && c.z == 0);
}

/// delaunay_sign for the rounded differences a = p-u, b = q-u, c = p-v, d = q-v.
///
/// With A = |a|^2 |b|^2, C = |c|^2 |d|^2 and D1 = a.b, D2 = c.d the sign is that of D1/sqrt(A) + D2/sqrt(C), hence
/// (x|x| grows with x) that of F = D1|D1| C + D2|D2| A. Its error is below 49 u A C.
inline Estimate delaunay_estimate(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double aa = squared_norm(a), bb = squared_norm(b), cc = squared_norm(c), dd = squared_norm(d);
    const double smallest = std::min(std::min(aa, bb), std::min(cc, dd));
    const double largest = std::max(std::max(aa, bb), std::max(cc, dd));
    if (!(smallest > smallest_square && largest < largest_square)) return nothing_known;
    const double d1 = dot(a, b), d2 = dot(c, d);
    const double square1 = aa * bb, square2 = cc * dd;
    const double value = d1 * std::fabs(d1) * square2 + d2 * std::fabs(d2) * square1;
    return {value, 50 * unit_roundoff * (square1 * square2)};
}

/// The sign of a.b for rounded differences; error below 5.01 u sum |a_i b_i|.
inline Estimate dot_estimate(const Vec3& a, const Vec3& b) {
    return {dot(a, b), 6 * unit_roundoff * absolute_dot(a, b) + underflow_allowance};
}

/// The sign of det(a, b, c) for rounded differences; error below 8.01 u times the permanent of absolute values.
inline Estimate orientation_estimate(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double yz = b.y * c.z, zy = b.z * c.y, zx = b.z * c.x, xz = b.x * c.z, xy = b.x * c.y, yx = b.y * c.x;
    const double ax = std::fabs(a.x), ay = std::fabs(a.y), az = std::fabs(a.z);
    const double det = a.x * (yz - zy) + a.y * (zx - xz) + a.z * (xy - yx);
    const double permanent = ax * (std::fabs(yz) + std::fabs(zy)) + ay * (std::fabs(zx) + std::fabs(xz)) +
                             az * (std::fabs(xy) + std::fabs(yx));
    return {det, 9 * unit_roundoff * permanent + underflow_allowance * (1 + (ax + ay + az))};
}

/// One component a1 b2 - a2 b1 of a x b for rounded differences; error below 4.01 u (|a1 b2| + |a2 b1|).
inline Estimate cross_estimate(double a1, double a2, double b1, double b2) {
    const double s = a1 * b2, t = a2 * b1;
    return {s - t, 5 * unit_roundoff * (std::fabs(s) + std::fabs(t)) + underflow_allowance};
}

/// True if the rounded differences are proved not to be parallel.
inline bool are_clearly_independent(const Vec3& a, const Vec3& b) {
    return cross_estimate(a.x, a.y, b.x, b.y).is_nonzero() || cross_estimate(a.y, a.z, b.y, b.z).is_nonzero() ||
           cross_estimate(a.z, a.x, b.z, b.x).is_nonzero();
}

/// dihedral_sign for the rounded differences e = q-p, a = u-p, c = v-p: n1.n2 - cosine |n1||n2| with n1 = e x a,
/// n2 = c x e; error below 35 u |e|^2 |a||c|.
inline Estimate dihedral_estimate(const Vec3& e, const Vec3& a, const Vec3& c, double cosine) {
    const double ee = squared_norm(e), aa = squared_norm(a), cc = squared_norm(c);
    const double smallest = std::min(ee, std::min(aa, cc)), largest = std::max(ee, std::max(aa, cc));
    if (!(smallest > smallest_square && largest < largest_square)) return nothing_known;
    const Vec3 n1 = cross(e, a), n2 = cross(c, e);
    const double lengths = std::sqrt(squared_norm(n1)) * std::sqrt(squared_norm(n2));
    return {dot(n1, n2) - cosine * lengths, 40 * unit_roundoff * (ee * std::sqrt(aa * cc))};
}

}  // namespace delmesh::exact
