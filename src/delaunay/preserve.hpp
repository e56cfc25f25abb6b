#pragma once
// Mode preserve: Algorithm 1 with a placement of the splits and a flat tolerance.

#include "delmesh/base/context.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/mesh.hpp"

namespace delmesh {

/// Mode preserve on a mesh without zero-area faces.
void preserve(Mesh& mesh, const RemeshOptions& options, const Context* context, RemeshReport& report);

}  // namespace delmesh
