#pragma once
// Modes flip and feature: flips across the surface, then splits for what is left.

#include "delmesh/base/context.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/mesh.hpp"

namespace delmesh {

/// Algorithm 2 and section 6 of the paper. With placement `fewest` a second way is tried as well, if that needs splits:
/// first flips alone, then the surface stays, features with it, and a search places the splits. The way with fewer
/// splits is taken. Where neither ends in mode feature, and most of what fails is flat but for rounding, faces as flat
/// as that lose their longest side to a flip before it (FlatRule::automatic; not if features are listed).
void flip_surface(Mesh& mesh, const RemeshOptions& options, const Context* context, RemeshReport& report);

}  // namespace delmesh
