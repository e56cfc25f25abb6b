#pragma once
// The lowest point of a quadric inside an intersection of half-spaces: the inner problem of constrained decimation.

#include "delmesh/simplify/quadric.hpp"

#include <optional>
#include <span>

namespace delmesh {

/// The points x with normal.x >= offset.
struct HalfSpace {
    Vec3 normal;
    double offset = 0;
};

/// The factors of a strictly convex quadric, so that several programs can share them.
struct QuadricFactors {
    Vec3 lowest;                                                  ///< the unconstrained minimum
    double l00 = 0, l10 = 0, l20 = 0, l11 = 0, l21 = 0, l22 = 0;  ///< A = L L', L lower triangular
};

/// Factorises; nothing if A is not positive definite in double precision (add a little to the diagonal first).
[[nodiscard]] std::optional<QuadricFactors> factorise(const Quadric& quadric);

/// The point of least value in the intersection of the half-spaces; nothing if that is empty.
///
/// Tolerance: a point counts as inside a half-space when it violates it by at most 1e-12 (1 + |offset|) after the space
/// is transformed so that the quadric becomes the squared distance to its lowest point; thinner empty gaps count as
/// touching, and intersections thinner than that may be found or not. Half-spaces with a zero normal hold everywhere
/// (offset <= 0) or nowhere. The half-spaces are transformed in place and reordered. No allocation.
///
/// Method: the incremental one for linear programs of fixed dimension (Seidel 1991), here for the smallest norm, with
/// the most violated half-space first. Cost: O(n) for the usual few active ones, O(n^3) at worst.
[[nodiscard]] std::optional<Vec3> minimise(const QuadricFactors& factors, std::span<HalfSpace> half_spaces);

}  // namespace delmesh
