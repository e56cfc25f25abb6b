#pragma once
// Which edges are not planar only because coordinates were rounded?

#include "delaunay/unit_frame.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"

namespace delmesh {

/// The tolerance, in the frame, within which the rounding of the coordinates makes no edge of a plane facet physical:
/// 16 times the largest error of a coordinate. Facets may use half of it (caps the other half): 8 errors. A plane that
/// an axis meets at its steepest has the points rounded off it within 3 errors along that axis, on either side: 6 in
/// all, and 2 to spare, as the plane that is found is not the best one.
[[nodiscard]] double stored_tolerance(const Mesh& mesh, const UnitFrame& frame);

/// True if at least half of the edges that are physical and not Delaunay have faces that lie within the tolerance of
/// one plane, or a face no higher than that: then rounding is what makes the mesh fail. Parallel.
[[nodiscard]] bool is_mostly_rounding(const Mesh& mesh, const UnitFrame& frame, double tolerance,
                                      const Context* context);

/// True if two planes may lie at most `width` apart (in the frame) and hold both faces at the edge between them. Never
/// false where they can; may be true where they can not.
[[nodiscard]] bool is_nearly_planar(const Mesh& mesh, const UnitFrame& frame, double width, HalfedgeId h);

}  // namespace delmesh
