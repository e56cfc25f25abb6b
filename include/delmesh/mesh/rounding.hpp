#pragma once
// Coordinates in single precision, for files that store floats.

#include "delmesh/mesh/polygon_soup.hpp"

namespace delmesh {

/// The nearest float (ties to even; infinite past the largest one).
[[nodiscard]] double round_to_float(double x);

/// The nearest point whose coordinates are floats (ties to even; infinite past the largest float).
[[nodiscard]] Vec3 round_to_float(const Vec3& p);

/// Rounds every point to floats. Returns the largest distance that a point moved.
/// Throws `Error` (not_finite, naming the points) if one is too large for a float; the soup is then unchanged.
/// Points that were apart may coincide afterwards: remeshing then reports an edge of length zero.
double round_to_float(PolygonSoup& soup);

}  // namespace delmesh
