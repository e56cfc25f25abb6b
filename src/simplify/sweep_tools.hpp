#pragma once
// What all ways of collapsing in sweeps share.

#include "delmesh/base/vec3.hpp"
#include "simplify/star.hpp"
#include "simplify/tuning.hpp"

#include <cstddef>
#include <vector>

namespace delmesh::sweeps {

/// So many keys are enough to tell how they are distributed.
constexpr std::size_t keys_looked_at = 100'000;
/// Half-edges between two looks at the context.
constexpr std::size_t report_interval = 1 << 16;
/// A squared distance, local unit, that may be all rounding.
constexpr double rounding2 = 1e-14;
/// Gaps are closed when less than this part of the vertices is left.
constexpr double sparse = 0.6;

/// Only minimum, middle and ends are tried.
[[nodiscard]] Tuning without_search(Tuning tuning);

/// The key that a part of them lies below; 0 if there are none. Changes their order.
[[nodiscard]] float quantile(std::vector<float>& keys, double part);

/// The squared distance of p from the star with its centre at w, or anything that is not above `enough`; all local.
[[nodiscard]] double find_distance2(const Star& star, const Vec3& w, const Vec3& p, double enough);

/// `parent` says by name what each was merged into, or names itself; `ids` the present id of what is left.
[[nodiscard]] std::vector<VertexId> merged_into(std::vector<VertexId> parent, const std::vector<VertexId>& ids);

}  // namespace delmesh::sweeps
