#pragma once
// Algorithm 1 of the paper: planar edges flip, physical and boundary edges are split at concentric shells.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/delaunay/remesh.hpp"

namespace delmesh {

/// Runs until every edge is Delaunay or a reason to stop turns up. Fills everything of the report but the provenance.
void refine(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report);

}  // namespace delmesh
