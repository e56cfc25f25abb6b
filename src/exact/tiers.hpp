#pragma once
// Tiers 2 and 3, each visible to the tests. Tier 1 is in filter.hpp.

#include "delmesh/base/vec3.hpp"
#include "delmesh/exact/sign.hpp"

#include <optional>

namespace delmesh::exact {

// Tier 2: exact in one or two machine words for each difference of coordinates, products as wide as needed; no value
// where the coordinates spread over too many bits (over 126 from the finest bit to the largest difference).
std::optional<Sign> delaunay_fixed(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v);
std::optional<Sign> right_angle_fixed(const Vec3& p, const Vec3& q, const Vec3& u);
std::optional<Sign> orientation_fixed(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
std::optional<bool> are_collinear_fixed(const Vec3& a, const Vec3& b, const Vec3& c);
/// Also no value where cosine^2 needs a denominator over 2^126 (|cosine| under 2^-10 with all bits in use).
std::optional<Sign> dihedral_fixed(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, double cosine);
std::optional<bool> is_planar_edge_fixed(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v);

// Tier 3: any finite doubles, in big integers. About a microsecond where exponents are close, more where they spread.
Sign delaunay_big(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v);
Sign right_angle_big(const Vec3& p, const Vec3& q, const Vec3& u);
Sign orientation_big(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
bool are_collinear_big(const Vec3& a, const Vec3& b, const Vec3& c);
Sign dihedral_big(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, double cosine);
bool is_planar_edge_big(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v);

}  // namespace delmesh::exact
