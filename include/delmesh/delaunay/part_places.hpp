#pragma once
// Vertices of a Delaunay mesh that lie at one place, for formats without indices (STL): they are told apart by steps of
// single precision.

#include "delmesh/mesh/mesh.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace delmesh {

struct Parting {
    std::size_t moved = 0;
    double furthest = 0;  ///< how far any of them moved
    /// Pairs that could not be parted.
    std::vector<std::array<VertexId, 2>> left;
};

/// Moves one of two vertices at one place (-0 equals +0), the younger one if it can, by at most `most_steps` float
/// steps of its largest coordinate along each axis, the shortest move first, such that all edges of its faces are
/// Delaunay and no other vertex is there. Requires floats. A Delaunay mesh stays one. Deterministic. Cost: O(vertices)
/// and the moves that are tried.
Parting part_places(Mesh& mesh);

}  // namespace delmesh
