#pragma once
// The allowable region of section 5 of the paper: half-spaces that stand in for the Delaunay conditions.

#include "delmesh/base/vec3.hpp"
#include "delmesh/simplify/quadric_program.hpp"
#include "simplify/star.hpp"

#include <array>
#include <optional>
#include <vector>

namespace delmesh {

/// For a ring edge pq on the boundary: tangent to the sphere with diameter pq, on the side of `towards`.
[[nodiscard]] std::optional<HalfSpace> outside_diametral_sphere(const Vec3& p, const Vec3& q, const Vec3& towards);

/// For an inner ring edge pq with the vertex `other` behind it: tangent to the chordal spheroid (the points that see pq
/// under pi minus the angle at `other`) where it is widest, on the side of `towards`.
[[nodiscard]] std::optional<HalfSpace> outside_chordal_spheroid(const Vec3& p, const Vec3& q, const Vec3& other,
                                                                const Vec3& towards);

/// For an edge [w,p] between the ring vertices o and q: H1 and H2, through [q,r] and [o,r], upright on the plane of
/// o, p, q, where r halves the arc from o to q that p is not on. The paper's claim that both lie in the feasible region
/// fails where the triangle is obtuse at o or q (docs/simplify.md). Nothing if the three points lie on a line.
[[nodiscard]] std::optional<std::array<HalfSpace, 2>> between_neighbours(const Vec3& o, const Vec3& p, const Vec3& q);

/// For a boundary edge [w,p] with apex q: exactly the feasible region.
[[nodiscard]] HalfSpace right_angle_at(const Vec3& q, const Vec3& p);

/// All half-spaces of a star, local. False if one of them does not exist (a degenerate triangle).
[[nodiscard]] bool find_paper_region(const Star& star, const Vec3& middle, std::vector<HalfSpace>& out);

}  // namespace delmesh
