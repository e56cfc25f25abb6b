#pragma once
// Faces that are all but flattened: a corner lies next to the opposite side.

#include "delaunay/marked_mesh.hpp"
#include "delaunay/unit_frame.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"

namespace delmesh {

struct FlatCaps {
    std::size_t flips = 0;
    /// No point of either surface is farther than this from the other one; in the frame. At most what was allowed.
    double moved = 0;
};

/// Flips the longest side of every face that is no higher than `allowed` (in the frame), where that side is not
/// Delaunay. Each such flip moves the surface by at most the face's height: the foot of the corner on the side goes to
/// the corner, all else follows linearly. What has moved is added up per face, so that the whole never exceeds
/// `allowed`. Ends, as flips of non-Delaunay edges do. The mesh must not hold zero-area faces, and will not.
FlatCaps flip_flat_caps(Mesh& mesh, const UnitFrame& frame, double allowed, const Context* context);

/// The same between other flips of a marked mesh: the short sides become creases where the long one was. May leave
/// faces without area, where coordinates do not tell their corners from a line; `clean_up` takes them away.
FlatCaps flip_flat_caps(MarkedMesh& marked, const UnitFrame& frame, double allowed, const Context* context);

/// An upper bound, in the frame, of the height of face h/3 over the edge of h; not below it by any rounding.
[[nodiscard]] double height_above(const Mesh& mesh, const UnitFrame& frame, HalfedgeId h);

}  // namespace delmesh
