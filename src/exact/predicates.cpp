// The public predicates: the filter, then the tiers that are exact.

#include "delmesh/exact/predicates.hpp"

#include "exact/inline.hpp"
#include "exact/lattice.hpp"
#include "exact/tiers.hpp"

#include <cassert>

namespace delmesh {
namespace exact {
namespace {

/// Within 2^-this and 2^this the filters meet neither overflow nor underflow.
constexpr int ordinary_exponent = 64;

double largest_coordinate(const Vec3& a) {
    return std::max(std::fabs(a.x), std::max(std::fabs(a.y), std::fabs(a.z)));
}

Vec3 times_power_of_two(const Vec3& a, int exponent) {
    return {std::scalbn(a.x, exponent), std::scalbn(a.y, exponent), std::scalbn(a.z, exponent)};
}

/// A second try of a filter for very long or very short differences: in a unit of their own size.
template <class Estimator, class... Differences>
std::optional<Sign> rescaled(Estimator estimate, const Differences&... differences) {
    const int exponent = exponent_above(std::max({largest_coordinate(differences)...}));
    if (std::abs(exponent) <= ordinary_exponent) return std::nullopt;
    return estimate(times_power_of_two(differences, -exponent)...).sign();
}

}  // namespace

Sign delaunay_sign_unfiltered(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier) {
    const Vec3 a = p - u, b = q - u, c = p - v, d = q - v;
    if (is_structurally_orthogonal(a, b) && is_structurally_orthogonal(c, d))
        return decided(Sign::zero, Tier::filter, tier);
    if (const auto sign = rescaled(delaunay_estimate, a, b, c, d)) return decided(*sign, Tier::filter, tier);
    if (const auto sign = delaunay_fixed(p, q, u, v)) return decided(*sign, Tier::fixed, tier);
    return decided(delaunay_big(p, q, u, v), Tier::big, tier);
}

Sign right_angle_sign_unfiltered(const Vec3& p, const Vec3& q, const Vec3& u, Tier* tier) {
    const Vec3 a = p - u, b = q - u;
    if (is_structurally_orthogonal(a, b)) return decided(Sign::zero, Tier::filter, tier);
    if (const auto sign = rescaled(dot_estimate, a, b)) return decided(*sign, Tier::filter, tier);
    if (const auto sign = right_angle_fixed(p, q, u)) return decided(*sign, Tier::fixed, tier);
    return decided(right_angle_big(p, q, u), Tier::big, tier);
}

Sign orientation_unfiltered(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Tier* tier) {
    const Vec3 ab = b - a, ac = c - a, ad = d - a;
    if (are_structurally_coplanar(ab, ac, ad)) return decided(Sign::zero, Tier::filter, tier);
    if (const auto sign = rescaled(orientation_estimate, ab, ac, ad)) return decided(*sign, Tier::filter, tier);
    if (const auto sign = orientation_fixed(a, b, c, d)) return decided(*sign, Tier::fixed, tier);
    return decided(orientation_big(a, b, c, d), Tier::big, tier);
}

bool are_collinear_unfiltered(const Vec3& a, const Vec3& b, const Vec3& c, Tier* tier) {
    if (const auto answer = are_collinear_fixed(a, b, c)) return decided(*answer, Tier::fixed, tier);
    return decided(are_collinear_big(a, b, c), Tier::big, tier);
}

bool is_planar_edge_unfiltered(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier) {
    const Vec3 e = q - p, a = u - p, c = v - p;
    if (rescaled(orientation_estimate, e, a, c)) return decided(false, Tier::filter, tier);
    const auto side = dihedral_estimate(e, a, c, 0).sign();
    if (side == Sign::negative) return decided(false, Tier::filter, tier);
    if (side == Sign::positive && are_structurally_coplanar(e, a, c)) return decided(true, Tier::filter, tier);
    if (const auto answer = is_planar_edge_fixed(p, q, u, v)) return decided(*answer, Tier::fixed, tier);
    return decided(is_planar_edge_big(p, q, u, v), Tier::big, tier);
}

}  // namespace exact

Sign delaunay_sign(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier) {
    return exact::delaunay_sign_inline(p, q, u, v, tier);
}

Sign right_angle_sign(const Vec3& p, const Vec3& q, const Vec3& u, Tier* tier) {
    return exact::right_angle_sign_inline(p, q, u, tier);
}

Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Tier* tier) {
    return exact::orientation_inline(a, b, c, d, tier);
}

bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c, Tier* tier) {
    return exact::are_collinear_inline(a, b, c, tier);
}

Sign dihedral_sign(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, double cosine, Tier* tier) {
    assert(std::fabs(cosine) <= 1);
    using exact::decided;
    const Vec3 e = q - p, a = u - p, c = v - p;
    if (std::fabs(cosine) == 1) {  // what is not coplanar is neither flat nor folded over
        if (exact::orientation_estimate(e, a, c).is_nonzero())
            return decided(cosine > 0 ? Sign::negative : Sign::positive, Tier::filter, tier);
    } else if (const auto sign = exact::dihedral_estimate(e, a, c, cosine).sign()) {
        return decided(*sign, Tier::filter, tier);
    }
    const auto estimate = [=](const Vec3& s, const Vec3& t, const Vec3& w) {
        return exact::dihedral_estimate(s, t, w, cosine);
    };
    if (const auto sign = exact::rescaled(estimate, e, a, c)) return decided(*sign, Tier::filter, tier);
    if (const auto sign = exact::dihedral_fixed(p, q, u, v, cosine)) return decided(*sign, Tier::fixed, tier);
    return decided(exact::dihedral_big(p, q, u, v, cosine), Tier::big, tier);
}

bool is_planar_edge(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier) {
    return exact::is_planar_edge_inline(p, q, u, v, tier);
}

}  // namespace delmesh
