#pragma once
// Tiers 2 and 3, each visible to the tests. Tier 1 is in filter.hpp.

#include "delmesh/base/vec3.hpp"
#include "delmesh/exact/sign.hpp"

namespace delmesh::exact {

// Tier 3: any finite doubles, in big integers. About a microsecond where exponents are close, more where they spread.
Sign delaunay_big(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v);
Sign right_angle_big(const Vec3& p, const Vec3& q, const Vec3& u);
Sign orientation_big(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
bool are_collinear_big(const Vec3& a, const Vec3& b, const Vec3& c);
Sign dihedral_big(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, double cosine);

}  // namespace delmesh::exact
