#pragma once
// The proof that a mesh is Delaunay: an exact check of the coordinates as they are.

#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <optional>
#include <vector>

namespace delmesh {

struct Certificate {
    /// True if no edge violates the Delaunay condition and no face has zero area. (That the mesh is a manifold is what
    /// being a `Mesh` means.)
    bool certified = false;
    /// False only if the context was cancelled: the counts then cover a part of the mesh, and nothing is certified.
    bool complete = false;
    std::size_t non_delaunay_edges = 0;     ///< interior edges whose opposite angles sum to more than pi
    std::size_t obtuse_boundary_edges = 0;  ///< boundary edges whose opposite angle exceeds pi/2
    std::size_t degenerate_faces = 0;       ///< faces of exactly zero area
    /// The largest violation in degrees (angle sum - 180 at interior edges, angle - 90 at boundary edges), in floating
    /// point and for reading only; 0 if there is none.
    double worst_excess_deg = 0;
    std::optional<EdgeId> worst_edge;
    /// How many edges the floating-point filter could not decide.
    std::size_t exact_edges = 0;
    /// The first offenders, at most 16, in the order of their ids.
    std::vector<EdgeId> offenders;
};

/// Checks every edge of the mesh, exactly and in parallel; the result does not depend on the number of threads.
///
/// A zero-area face has the angles 0, 0, pi of its limit. Where two of its corners coincide, the angles there have no
/// limit: they are no violation of an edge, but the face is counted in `degenerate_faces`.
/// Cost: O(faces), 30 to 40 ns per edge on one core where the filter decides; see docs/certificate.md.
[[nodiscard]] Certificate certify(const Mesh& mesh, const Context* context = nullptr);

}  // namespace delmesh
