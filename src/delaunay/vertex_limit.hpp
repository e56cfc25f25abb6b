#pragma once
// Attempts that may add fewer vertices than the whole run.

#include "delmesh/delaunay/remesh.hpp"

#include <cstddef>

namespace delmesh {

/// The options with a limit on the number of vertices, unless they have a stricter one. Requires vertices > 0.
[[nodiscard]] inline RemeshOptions with_at_most(RemeshOptions options, std::size_t vertices) {
    if (options.max_vertices == 0 || options.max_vertices > vertices) options.max_vertices = vertices;
    return options;
}

}  // namespace delmesh
