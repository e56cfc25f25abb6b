// The public predicates: the filter, then the tiers that are exact.

#include "delmesh/exact/predicates.hpp"

#include "exact/filter.hpp"
#include "exact/tiers.hpp"

namespace delmesh {
namespace {

/// Notes the tier for the caller who asked for it and passes the result on.
template <class Result>
Result decided(Result result, Tier by, Tier* tier) {
    if (tier != nullptr) *tier = by;
    return result;
}

}  // namespace

Sign delaunay_sign(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier) {
    const Vec3 a = p - u, b = q - u, c = p - v, d = q - v;
    if (const auto sign = exact::delaunay_filter(a, b, c, d)) return decided(*sign, Tier::filter, tier);
    if (exact::is_structurally_orthogonal(a, b) && exact::is_structurally_orthogonal(c, d))
        return decided(Sign::zero, Tier::filter, tier);
    if (const auto sign = exact::delaunay_fixed(p, q, u, v)) return decided(*sign, Tier::fixed, tier);
    return decided(exact::delaunay_big(p, q, u, v), Tier::big, tier);
}

Sign right_angle_sign(const Vec3& p, const Vec3& q, const Vec3& u, Tier* tier) {
    const Vec3 a = p - u, b = q - u;
    if (const auto sign = exact::dot_filter(a, b)) return decided(*sign, Tier::filter, tier);
    if (exact::is_structurally_orthogonal(a, b)) return decided(Sign::zero, Tier::filter, tier);
    if (const auto sign = exact::right_angle_fixed(p, q, u)) return decided(*sign, Tier::fixed, tier);
    return decided(exact::right_angle_big(p, q, u), Tier::big, tier);
}

Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Tier* tier) {
    if (const auto sign = exact::orientation_filter(b - a, c - a, d - a)) return decided(*sign, Tier::filter, tier);
    if (const auto sign = exact::orientation_fixed(a, b, c, d)) return decided(*sign, Tier::fixed, tier);
    return decided(exact::orientation_big(a, b, c, d), Tier::big, tier);
}

bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c, Tier* tier) {
    if (exact::are_clearly_independent(b - a, c - a)) return decided(false, Tier::filter, tier);
    if (const auto answer = exact::are_collinear_fixed(a, b, c)) return decided(*answer, Tier::fixed, tier);
    return decided(exact::are_collinear_big(a, b, c), Tier::big, tier);
}

Sign dihedral_sign(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, double cosine, Tier* tier) {
    if (const auto sign = exact::dihedral_filter(q - p, u - p, v - p, cosine))
        return decided(*sign, Tier::filter, tier);
    if (const auto sign = exact::dihedral_fixed(p, q, u, v, cosine)) return decided(*sign, Tier::fixed, tier);
    return decided(exact::dihedral_big(p, q, u, v, cosine), Tier::big, tier);
}

bool is_planar_edge(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier) {
    if (exact::orientation_filter(q - p, u - p, v - p)) return decided(false, Tier::filter, tier);
    Tier first{}, second{};
    const bool planar =
        orientation(p, q, u, v, &first) == Sign::zero && dihedral_sign(p, q, u, v, 0, &second) == Sign::positive;
    return decided(planar, std::max(first, second), tier);
}

}  // namespace delmesh
