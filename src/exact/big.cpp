// Tier 3: the formulas in integers of any size.

#include "exact/lattice.hpp"
#include "exact/polynomials.hpp"
#include "exact/tiers.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <array>

namespace delmesh::exact {
namespace {

using BigInteger =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;

BigInteger scaled(const Dyadic& value, int exponent) {
    if (value.mantissa == 0) return 0;
    return BigInteger(value.mantissa) << static_cast<unsigned>(value.exponent - exponent);
}

/// The points in units of the largest power of two that divides all their coordinates.
template <std::size_t count>
std::array<Difference<BigInteger>, count> to_integers(const std::array<Vec3, count>& points) {
    int exponent = Dyadic::no_exponent;
    std::array<DyadicPoint, count> parts;
    for (std::size_t i = 0; i < count; ++i) {
        parts[i] = decompose(points[i]);
        exponent = std::min(exponent, parts[i].exponent());
    }
    std::array<Difference<BigInteger>, count> integers;
    for (std::size_t i = 0; i < count; ++i)
        integers[i] = {scaled(parts[i].x, exponent), scaled(parts[i].y, exponent), scaled(parts[i].z, exponent)};
    return integers;
}

}  // namespace

Sign delaunay_big(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v) {
    const auto i = to_integers<4>({p, q, u, v});
    return delaunay_polynomial(i[0] - i[2], i[1] - i[2], i[0] - i[3], i[1] - i[3]);
}

Sign right_angle_big(const Vec3& p, const Vec3& q, const Vec3& u) {
    const auto i = to_integers<3>({p, q, u});
    return sign_of(dot(i[0] - i[2], i[1] - i[2]));
}

Sign orientation_big(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto i = to_integers<4>({a, b, c, d});
    return orientation_polynomial(i[1] - i[0], i[2] - i[0], i[3] - i[0]);
}

bool are_collinear_big(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto i = to_integers<3>({a, b, c});
    return are_parallel(i[1] - i[0], i[2] - i[0]);
}

Sign dihedral_big(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, double cosine) {
    const auto i = to_integers<4>({p, q, u, v});
    const Dyadic ratio = decompose(cosine);
    BigInteger numerator = BigInteger(ratio.mantissa) * ratio.mantissa, denominator = 1;
    if (ratio.mantissa != 0) (ratio.exponent < 0 ? denominator : numerator) <<= 2 * std::abs(ratio.exponent);
    const Sign s = static_cast<Sign>((cosine > 0) - (cosine < 0));
    return dihedral_polynomial(i[1] - i[0], i[2] - i[0], i[3] - i[0], s, numerator, denominator);
}

bool is_planar_edge_big(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v) {
    const auto i = to_integers<4>({p, q, u, v});
    return is_planar_edge_polynomial(i[1] - i[0], i[2] - i[0], i[3] - i[0]);
}

}  // namespace delmesh::exact
