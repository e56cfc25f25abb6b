#pragma once
// The flipping of Algorithm 2 and of section 6 of the paper.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/delaunay/remesh.hpp"

namespace delmesh {

/// Flips edges that are not Delaunay, in the order of the options, and splits those that are marked physical as they
/// come up (`split_physical`) or leaves them. With FlipFinish::keep_flipping, what can not be flipped is then split and
/// flipping goes on, for a bounded number of rounds. What is left over is a matter for `refine`.
void flip_edges(MarkedMesh& marked, bool split_physical, const RemeshOptions& options, const Context* context,
                RemeshReport& report);

}  // namespace delmesh
