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

/// Replaces the model's points by those of `other` (a solution, sorted) in each region where the model has an edge of
/// `open` or more points. Regions are connected sets of facets that either solution touches; solutions of different
/// regions do not depend on each other. Returns the number of regions that changed.
std::size_t take_better_regions(SplitModel& model, std::span<const std::uint32_t> open,
                                std::span<const PlacedPoint> other);

}  // namespace delmesh
