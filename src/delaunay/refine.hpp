#pragma once
// Algorithm 1 of the paper: planar edges flip, physical and boundary edges are split at concentric shells.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/delaunay/remesh.hpp"

#include <functional>
#include <span>
#include <vector>

namespace delmesh {

/// Chooses points for physical edges: `bad` are those that are not Delaunay, in order, while all planar ones are.
/// Ordered by edge and parameter.
using SplitPlanner = std::function<std::vector<SplitPoint>(const MarkedMesh& marked, std::span<const EdgeId> bad)>;

/// Runs until every edge is Delaunay or a reason to stop turns up. Fills everything of the report but the provenance.
/// With a planner, its points are put in first; what is not Delaunay after that is split at shells.
void refine(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report,
            const SplitPlanner& planner = {});

}  // namespace delmesh
