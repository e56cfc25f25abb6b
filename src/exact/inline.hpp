#pragma once
// The predicates with their filter inline, for hot loops: the same results as those of predicates.hpp, which call
// these. Code that includes this must be compiled without -ffast-math.

#include "delmesh/exact/predicates.hpp"

#include "exact/filter.hpp"

namespace delmesh::exact {

/// Notes the tier for the caller who asked for it and passes the result on.
template <class Result>
Result decided(Result result, Tier by, Tier* tier) {
    if (tier != nullptr) *tier = by;
    return result;
}

// What is left when the filter has failed: exact zeros in special position, another unit of length, the exact tiers.
Sign delaunay_sign_unfiltered(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier);
Sign right_angle_sign_unfiltered(const Vec3& p, const Vec3& q, const Vec3& u, Tier* tier);
Sign orientation_unfiltered(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Tier* tier);
bool are_collinear_unfiltered(const Vec3& a, const Vec3& b, const Vec3& c, Tier* tier);
bool is_planar_edge_unfiltered(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier);

inline Sign delaunay_sign_inline(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier = nullptr) {
    if (const auto sign = delaunay_estimate(p - u, q - u, p - v, q - v).sign())
        return decided(*sign, Tier::filter, tier);
    return delaunay_sign_unfiltered(p, q, u, v, tier);
}

inline Sign right_angle_sign_inline(const Vec3& p, const Vec3& q, const Vec3& u, Tier* tier = nullptr) {
    if (const auto sign = dot_estimate(p - u, q - u).sign()) return decided(*sign, Tier::filter, tier);
    return right_angle_sign_unfiltered(p, q, u, tier);
}

inline Sign orientation_inline(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Tier* tier = nullptr) {
    if (const auto sign = orientation_estimate(b - a, c - a, d - a).sign()) return decided(*sign, Tier::filter, tier);
    return orientation_unfiltered(a, b, c, d, tier);
}

inline bool are_collinear_inline(const Vec3& a, const Vec3& b, const Vec3& c, Tier* tier = nullptr) {
    if (are_clearly_independent(b - a, c - a)) return decided(false, Tier::filter, tier);
    return are_collinear_unfiltered(a, b, c, tier);
}

inline bool is_planar_edge_inline(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier = nullptr) {
    if (orientation_estimate(q - p, u - p, v - p).is_nonzero()) return decided(false, Tier::filter, tier);
    return is_planar_edge_unfiltered(p, q, u, v, tier);
}

}  // namespace delmesh::exact
