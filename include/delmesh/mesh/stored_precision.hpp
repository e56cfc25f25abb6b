#pragma once
// With which precision were the coordinates of a mesh stored?

#include "delmesh/base/vec3.hpp"

#include <span>

namespace delmesh {

/// The most that rounding may have moved a coordinate when the points were stored, judged by the numbers themselves, so
/// that it does not matter through which files they went since:
/// - numbers that all have at most s decimal digits, 6 <= s <= 8, as a text file with "%g" or "%f" leaves them: half a
///   unit of the last digit of the largest number that has s digits (fewer than 6 digits are taken for exact: such
///   numbers are designed, not measured);
/// - floats, or floats times a power of two: 2^-24 of the largest coordinate; where both fit, the larger;
/// - else 2^-53 of the largest coordinate.
/// 0 for no points or nothing but zeros. Requires finite points. Cost: O(points).
[[nodiscard]] double stored_rounding(std::span<const Vec3> points);

}  // namespace delmesh
