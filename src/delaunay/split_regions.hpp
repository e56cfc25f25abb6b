#pragma once
// Two solutions side by side: the better one of each region.

#include "delaunay/split_model.hpp"

#include <span>
#include <utility>
#include <vector>

namespace delmesh {

/// Points on an edge of the model.
struct PlacedPoint {
    std::uint32_t edge = 0;
    double at = 0;
    friend bool operator<(const PlacedPoint& a, const PlacedPoint& b) {
        return a.edge != b.edge ? a.edge < b.edge : a.at < b.at;
    }
};

/// The points of the model, sorted.
[[nodiscard]] std::vector<PlacedPoint> placed_points(const SplitModel& model);

/// Adds points, sorted, to edges that have none.
void add_points(SplitModel& model, std::span<const PlacedPoint> points);

/// Replaces the model's points by those of `theirs` in each region where that has fewer than `ours`, or where an edge
/// of `open` lies. Both are sorted; `ours` is what the model's points come to. Regions are connected sets of facets
/// that any of the solutions touches; what happens in one does not depend on another. Returns how many regions changed.
std::size_t take_better_regions(SplitModel& model, std::span<const std::uint32_t> open,
                                std::span<const PlacedPoint> ours, std::span<const PlacedPoint> theirs);

}  // namespace delmesh
