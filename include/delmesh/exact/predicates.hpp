#pragma once
// The signs that decide everything: exact for all finite doubles, including denormals, 1e+300 and mixed scales.
// docs/exact.md derives the error bounds and describes the tiers.

#include "delmesh/base/vec3.hpp"
#include "delmesh/exact/sign.hpp"

namespace delmesh {

/// Which tier decided a sign.
enum class Tier : unsigned char {
    filter,  ///< plain doubles with a proved error bound
    fixed,   ///< exact, in a fixed small number of machine words or doubles
    big,     ///< exact, with big integers of any size
};

/// The sign of pi - (angle at u + angle at v), where u and v are opposite to the edge pq: negative means that the edge
/// is not locally Delaunay, zero that the four points are "co-circular" (which *is* Delaunay).
///
/// Laws: unchanged when p and q are exchanged, when u and v are exchanged, and when all coordinates are scaled by the
/// same power of two (as far as that is exact) or mirrored. A zero-area face has the angles 0, 0, pi of its limit.
/// Requires finite coordinates, and u and v different from p and q.
/// Source: Dyer, Zhang, Moeller 2007, section 3; degree 8 in the coordinates' differences.
[[nodiscard]] Sign delaunay_sign(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier = nullptr);

/// The sign of pi/2 - (angle at u), for a boundary edge pq with opposite vertex u: negative means not Delaunay.
[[nodiscard]] Sign right_angle_sign(const Vec3& p, const Vec3& q, const Vec3& u, Tier* tier = nullptr);

/// The sign of det(b - a, c - a, d - a).
[[nodiscard]] Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Tier* tier = nullptr);

/// True if the three points lie on a line (the triangle has no area).
[[nodiscard]] bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c, Tier* tier = nullptr);

/// The sign of cos(deviation) - cosine, where the deviation from flat (0 to 180 degrees) at the edge pq is the angle
/// between the normals of the faces (p,q,u) and (q,p,v). `cosine` in [-1,1] is taken as the exact real number it is.
/// cosine == 1: zero exactly where the two faces are coplanar and not folded over, else negative.
/// cosine == 0: negative where the fold is sharper than 90 degrees. cosine == -1: never negative.
/// A zero-area face has no normal: the result is then zero.
[[nodiscard]] Sign dihedral_sign(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, double cosine,
                                 Tier* tier = nullptr);

/// True if the faces (p,q,u) and (q,p,v) lie in one plane, on different sides of pq: flipping pq keeps the surface, as
/// far as the quadrilateral is convex. False if one of the faces has no area.
[[nodiscard]] bool is_planar_edge(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, Tier* tier = nullptr);

}  // namespace delmesh
