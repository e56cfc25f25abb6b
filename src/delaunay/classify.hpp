#pragma once
// Reads the input's geometry once: takes zero-area faces away, tells planar edges from physical ones, finds facets.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <vector>

namespace delmesh {

/// Flips the long edge of every zero-area face (a cap) until none is left; the surface stays as it is. A cap at the
/// boundary is taken off. Returns the number of flips and removals. Ends, since each flip replaces an edge by a shorter
/// one. Throws `Error` (zero_length_edge, degenerate_geometry).
std::size_t remove_caps(Mesh& mesh, const Context* context);

/// True if the face has no area, exactly, though its corners are apart.
[[nodiscard]] bool is_cap(const Mesh& mesh, FaceId f);

/// The half-edge to flip so that the zero-area face f, or one that has to go before it, is gone: it is the longest side
/// of its face and of every zero-area face beside it, so that the new edge is shorter.
[[nodiscard]] HalfedgeId side_to_flip(const Mesh& mesh, FaceId f);

/// A mark for each half-edge: planar where the two faces are coplanar and not folded over, exactly. Parallel.
[[nodiscard]] std::vector<Mark> mark_edges(const Mesh& mesh, const Context* context);

/// For each face the smallest face that it is joined to across planar edges.
[[nodiscard]] std::vector<FaceId> find_facets(const Mesh& mesh, const std::vector<Mark>& marks);

}  // namespace delmesh
