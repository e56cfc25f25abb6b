#pragma once
// Which edges of the input may not be flipped.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/delaunay/remesh.hpp"

#include <array>
#include <span>
#include <vector>

namespace delmesh {

/// The cosine of an angle in degrees, 0 to 180, to an ulp or so; exact at 0, 60, 90, 120 and 180, the same on every
/// system.
[[nodiscard]] double cosine_of_degrees(double degrees);

/// Marks as physical the boundary, the edges whose dihedral angle deviates from flat by more than `angle_deg` (exactly,
/// as compared with the double nearest to its cosine) and the edges that are listed. All other edges are marked planar:
/// they may be flipped. Listed pairs that no edge joins are passed over.
[[nodiscard]] std::vector<Mark> mark_features(const Mesh& mesh, double angle_deg,
                                              std::span<const std::array<VertexId, 2>> listed, const Context* context);

}  // namespace delmesh
