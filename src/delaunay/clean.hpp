#pragma once
// Takes away what the rounding of split points has flattened: edges without length and faces without area.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/base/context.hpp"

#include <optional>

namespace delmesh {

struct Cleaning {
    std::size_t changes = 0;
    /// An edge of a face that could not be taken away.
    std::optional<EdgeId> left;
};

/// Merges vertices that are joined and lie at the same place, then flips zero-area faces away. The surface stays where
/// it is. Vertices of the input stay, as no two of them are ever joined at the same place. Parallel search, sequential
/// changes.
[[nodiscard]] Cleaning clean_up(MarkedMesh& marked, const Context* context);

}  // namespace delmesh
