#pragma once
// Vertices at the same place: what a format without indices (STL) can not tell apart.

#include "delmesh/mesh/polygon_soup.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace delmesh {

/// Pairs (kept, other) of points that lie at the same place (-0 equals +0) and are corners of faces; `kept` is the
/// first of its place. In the order of `other`. Cost: O(n log n).
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> find_coincident(const PolygonSoup& soup);

/// Joins points at the same place: faces use the first of them. Points stay in the soup. Returns how many were
/// replaced.
std::size_t weld_coincident(PolygonSoup& soup);

/// Moves points at the same place apart, by as few steps of single precision as it takes: for surfaces that touch
/// themselves. Requires that all points are floats. Returns how many moved.
std::size_t part_coincident(PolygonSoup& soup);

}  // namespace delmesh
