#pragma once
// Cuts what a model knows of a mesh into blocks of facets that lie together.

#include "delaunay/split_model.hpp"

#include <cstdint>
#include <vector>

namespace delmesh {

struct FacetBlocks {
    static constexpr std::uint32_t none = SplitModel::none;

    std::vector<std::uint32_t> block_of;             ///< by facet
    std::vector<std::vector<std::uint32_t>> facets;  ///< of each block, ascending
    std::vector<bool> is_inner;                      ///< by facet: all facets beside it are of its block
};

/// Halves the facets at a plane across their longest extent, again and again, until no block has more than
/// `most_points` points. Other `round`s cut at other places. O(n log n) for n facets; the same for the same model.
[[nodiscard]] FacetBlocks cut_into_blocks(const SplitModel& model, std::size_t most_points, int round);

}  // namespace delmesh
