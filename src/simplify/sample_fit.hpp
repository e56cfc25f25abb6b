#pragma once
// The squared distances of samples to a star, as a function of where its centre lies.

#include "simplify/edge_cost.hpp"
#include "simplify/samples.hpp"
#include "simplify/star.hpp"

namespace delmesh {

/// The squared distances of the samples in hand, as far as they depend on the place of the centre, to first order, and
/// a pull of the part `regular` of them to where it is now. Each sample must be attached to its face of the star. False
/// if none says anything.
[[nodiscard]] bool fit_to_samples(const Star& star, const SurfaceSamples& samples, const Vec3& centre, double regular,
                                  EdgeCost& cost);

}  // namespace delmesh
