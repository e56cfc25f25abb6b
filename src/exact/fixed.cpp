// Tier 2: the formulas in a fixed number of machine words.

#include "exact/lattice.hpp"
#include "exact/polynomials.hpp"
#include "exact/tiers.hpp"
#include "exact/wide.hpp"

#include <array>

namespace delmesh::exact {
namespace {

/// The widest differences that one and two words can hold so that no sum of the formulas overflows.
constexpr int one_word_bits = 62;
constexpr int two_words_bits = 126;

/// A few points on their common lattice: their coordinates are integers times 2^exponent, and no difference of two
/// coordinates has more than `bits` bits.
template <std::size_t count>
struct Lattice {
    std::array<DyadicPoint, count> points;
    int exponent = Dyadic::no_exponent;
    int bits = 0;

    explicit Lattice(const std::array<Vec3, count>& positions) {
        Vec3 low = positions[0], high = positions[0];
        for (std::size_t i = 0; i < count; ++i) {
            points[i] = decompose(positions[i]);
            exponent = std::min(exponent, points[i].exponent());
            low = {std::min(low.x, positions[i].x), std::min(low.y, positions[i].y), std::min(low.z, positions[i].z)};
            high = {std::max(high.x, positions[i].x), std::max(high.y, positions[i].y),
                    std::max(high.z, positions[i].z)};
        }
        const Vec3 extent = high - low;
        bits = exponent_above(std::max(extent.x, std::max(extent.y, extent.z))) - exponent;
    }
};

template <std::size_t words>
Wide<words> scaled(const Dyadic& value, int exponent);

/// Modulo 2^64, which is all that a difference needs that fits.
template <>
Wide<1> scaled(const Dyadic& value, int exponent) {
    const int shift = value.exponent - exponent;
    const auto mantissa = static_cast<std::uint64_t>(value.mantissa);
    return {static_cast<std::int64_t>(shift < 64 ? mantissa << shift : 0)};
}

template <>
Wide<2> scaled(const Dyadic& value, int exponent) {
    const int shift = value.exponent - exponent;
    const auto mantissa = static_cast<Uint128>(static_cast<Int128>(value.mantissa));
    return {static_cast<Int128>(shift < 128 ? mantissa << shift : 0)};
}

template <std::size_t words, std::size_t count>
std::array<Difference<Wide<words>>, count> to_integers(const Lattice<count>& lattice) {
    std::array<Difference<Wide<words>>, count> integers;
    for (std::size_t i = 0; i < count; ++i)
        integers[i] = {scaled<words>(lattice.points[i].x, lattice.exponent),
                       scaled<words>(lattice.points[i].y, lattice.exponent),
                       scaled<words>(lattice.points[i].z, lattice.exponent)};
    return integers;
}

/// formula(integer points), in as few words as will do; no value if two are too few.
template <std::size_t count, class Formula>
auto evaluate(const std::array<Vec3, count>& points, Formula formula)
    -> std::optional<decltype(formula(to_integers<1>(Lattice<count>(points))))> {
    const Lattice<count> lattice(points);
    if (lattice.bits <= one_word_bits) return formula(to_integers<1>(lattice));
    if (lattice.bits <= two_words_bits) return formula(to_integers<2>(lattice));
    return std::nullopt;
}

}  // namespace

std::optional<Sign> delaunay_fixed(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v) {
    return evaluate<4>({p, q, u, v}, [](const auto& i) {
        return delaunay_polynomial(i[0] - i[2], i[1] - i[2], i[0] - i[3], i[1] - i[3]);
    });
}

std::optional<Sign> right_angle_fixed(const Vec3& p, const Vec3& q, const Vec3& u) {
    return evaluate<3>({p, q, u}, [](const auto& i) { return sign_of(dot(i[0] - i[2], i[1] - i[2])); });
}

std::optional<Sign> orientation_fixed(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return evaluate<4>({a, b, c, d},
                       [](const auto& i) { return orientation_polynomial(i[1] - i[0], i[2] - i[0], i[3] - i[0]); });
}

std::optional<bool> are_collinear_fixed(const Vec3& a, const Vec3& b, const Vec3& c) {
    return evaluate<3>({a, b, c}, [](const auto& i) { return are_parallel(i[1] - i[0], i[2] - i[0]); });
}

std::optional<Sign> dihedral_fixed(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, double cosine) {
    const Dyadic ratio = decompose(cosine);
    const int scale = ratio.mantissa == 0 ? 0 : -2 * ratio.exponent;  // cosine^2 = mantissa^2 / 2^scale
    if (scale < 0 || scale > two_words_bits) return std::nullopt;
    const Wide<2> numerator{static_cast<Int128>(ratio.mantissa) * ratio.mantissa};
    const Wide<2> denominator{static_cast<Int128>(Uint128{1} << scale)};
    const Sign s = static_cast<Sign>((cosine > 0) - (cosine < 0));
    return evaluate<4>({p, q, u, v}, [&](const auto& i) {
        return dihedral_polynomial(i[1] - i[0], i[2] - i[0], i[3] - i[0], s, numerator, denominator);
    });
}

std::optional<bool> is_planar_edge_fixed(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v) {
    return evaluate<4>({p, q, u, v},
                       [](const auto& i) { return is_planar_edge_polynomial(i[1] - i[0], i[2] - i[0], i[3] - i[0]); });
}

}  // namespace delmesh::exact
