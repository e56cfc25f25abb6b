#pragma once
// Algorithm 1 of the paper: planar edges flip, physical and boundary edges are split at concentric shells.

#include "delaunay/marked_mesh.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/delaunay/remesh.hpp"

#include <span>
#include <vector>

namespace delmesh {

/// What is left to do once planar edges are Delaunay, but for those that can not be flipped.
struct RefineStart {
    std::vector<HalfedgeId> queue;  ///< what has to be split; may name edges that are Delaunay, or one twice
    std::vector<EdgeId> bad;        ///< the physical edges among them, sorted: each must be split by any method
};

/// The first step: flips planar edges. Fills the report's flips and lower bound.
RefineStart flip_planar_edges(MarkedMesh& marked, const RemeshOptions& options, const Context* context,
                              RemeshReport& report);

/// Splits physical edges at these points, which are ordered by edge and parameter, and flips planar edges. Returns the
/// edges that are not Delaunay after that.
[[nodiscard]] std::vector<HalfedgeId> carry_out(MarkedMesh& marked, const RemeshOptions& options,
                                                const Context* context, RemeshReport& report, const RefineStart& start,
                                                std::span<const SplitPoint> plan);

/// Where sheets of a surface lie on each other, two facets may want an edge between the same two vertices, and only one
/// can have it. A vertex inside that one makes room for the other. `left`: edges that are not Delaunay, planar ones
/// among them as nothing else is in the way of their flips. Returns those that are not after that, some twice.
[[nodiscard]] std::vector<HalfedgeId> part_sheets(MarkedMesh& marked, const RemeshOptions& options,
                                                  RemeshReport& report, std::vector<HalfedgeId> left);

/// The second step: splits at shells and flips, until every edge is Delaunay or a reason to stop turns up.
void split_rest(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report,
                std::vector<HalfedgeId> queue);

/// The same; where rounding has made edges without length or faces without area, these are taken away. Fills everything
/// of the report but the provenance.
void refine_and_clean(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report,
                      std::vector<HalfedgeId> queue);

}  // namespace delmesh
