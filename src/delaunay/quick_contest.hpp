#pragma once
// Effort 0: see docs/fewest.md.

#include "delaunay/refine.hpp"

namespace delmesh {

/// Shells finish what a quick construction leaves open. Alone they are run only for as long as they need fewer splits
/// than that. Promises what `preserve_with_fewest` does.
void preserve_quickly(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report,
                      const RefineStart& start);

}  // namespace delmesh
