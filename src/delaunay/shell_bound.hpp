#pragma once
// How many points shells need at least, at a fraction of what it takes to put them in.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/delaunay/remesh.hpp"

#include <cstddef>
#include <span>

namespace delmesh {

/// True if Algorithm 1, were it run from here, would put more than `count` points on physical edges, or stop short.
/// `bad`: the physical edges that are not Delaunay, while planar edges are. It may be false where that is so: only a
/// part of these points is followed. Deterministic. Cost: O(bad + count), and little of it.
[[nodiscard]] bool shells_need_more_than(const MarkedMesh& marked, std::span<const EdgeId> bad,
                                         const RemeshOptions& options, std::size_t count);

}  // namespace delmesh
