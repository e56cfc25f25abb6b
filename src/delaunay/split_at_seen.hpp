#pragma once
// Where to split a bad part for what it sees.

#include "delaunay/split_model.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace delmesh {

/// Points keep this distance, as a share of their edge: what lies closer together is hard to tell apart.
constexpr double room_between_points = 1e-10;

/// The place that `place(side, contact)` gives for what the part sees under the larger angle, or at the other side if
/// that does not lie within the part. Negative if neither does.
template <class Place>
[[nodiscard]] double split_at_what_is_seen(const SplitModel& model, std::uint32_t e, std::size_t part, Place&& place) {
    const double a = model.part_start(e, part);
    const double b = model.parts(e)[part].end;
    double least = std::numeric_limits<double>::infinity();
    double at = -1;
    for (const std::uint32_t s : model.layout().edge(e).side) {
        if (s == SplitModel::none) continue;
        const Contact seen = model.nearest(s, a, b);
        if (seen.cot >= least) continue;
        const double x = place(s, seen);
        if (!(x > a + room_between_points) || !(x < b - room_between_points)) continue;
        least = seen.cot;
        at = x;
    }
    return at;
}

}  // namespace delmesh
