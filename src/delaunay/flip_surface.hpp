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

/// What of that can be had by flips alone, for a mesh that is going to change anyhow: faces that only rounding has made
/// go first, under the conditions above; afterwards features and what can not be flipped are not Delaunay. Needs hardly
/// more room than the mesh. Throws as `remove_caps`. Returns the number of flips.
std::size_t flip_alone(Mesh& mesh, const RemeshOptions& options, const Context* context);

}  // namespace delmesh
