#pragma once
// What it costs to merge the two ends of an edge, as a function of where they merge to.

#include "delmesh/mesh/mesh.hpp"
#include "delmesh/simplify/quadric.hpp"
#include "simplify/star.hpp"
#include "simplify/tuning.hpp"
#include "simplify/weights.hpp"

namespace delmesh {

/// Local to the frame of the edge's star: the origin is the place of u.
struct EdgeCost {
    Quadric steered;   ///< the error, with what picks one of many equal places
    double trace = 0;  ///< of the error alone
    Vec3 middle;
};

[[nodiscard]] EdgeCost edge_cost(const Mesh& mesh, const VertexWeights& weights, HalfedgeId h, double scale,
                                 const Tuning& tuning);

/// The lowest value of that cost anywhere: not more than what any place costs, before `add_volume`.
[[nodiscard]] double lowest_cost(const EdgeCost& cost);

/// The volume under the star is kept where normal.w = offset. Where the faces look in many directions that says little
/// about w, and counts less.
void add_volume(const Star& star, const Tuning& tuning, EdgeCost& cost);

}  // namespace delmesh
