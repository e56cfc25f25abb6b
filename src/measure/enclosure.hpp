#pragma once
// A proved interval around the Hausdorff distance of two surfaces, by branch and bound on pieces of their triangles.

#include "delmesh/base/context.hpp"
#include "measure/surface.hpp"

#include <cstddef>
#include <cstdint>

namespace delmesh::measure {

struct Enclosure {
    double lower = 0;
    double upper = 0;
    std::size_t pieces = 0;
};

/// More than all rounding adds up to, in the units of the frame: derived in docs/distance.md.
inline constexpr double enclosure_margin = 0x1p-41;

/// Encloses the larger of the two one-sided distances, in the units of the frame, rounding included. Stops when the
/// interval is at most `width` wide, or after about `max_pieces` pieces beyond the triangles themselves, or when the
/// context is cancelled; the interval is valid all the same. The same for any number of threads. `lower` is a distance
/// that is known to be attained, or 0; a good one saves most of the work.
[[nodiscard]] Enclosure enclose_hausdorff(const Surface& a, const Surface& b, double lower, double width,
                                          std::size_t max_pieces, const Context* context);

}  // namespace delmesh::measure
