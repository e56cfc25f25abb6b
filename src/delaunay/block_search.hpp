#pragma once
// The search on several threads: each block of facets has a model of its own, in which only what lies within it moves.

#include "delaunay/split_model.hpp"
#include "delmesh/base/context.hpp"

#include <cstdint>

namespace delmesh {

struct BlockSearchOptions {
    std::uint64_t seed = 1;
    double work = 0;                  ///< for each point,
    bool polishes = false;            ///< the angles, instead of taking points away
    std::size_t block_points = 2000;  ///< at most in a block
    std::uint64_t patience = 1;       ///< of the search in a block
};

/// One round of what SplitSearch::improve does; tries to close edges that were given up, where they lie within a block.
/// Makes no other edge bad. Results do not depend on the number of threads. Memory: a model of a block for each thread.
std::uint64_t improve_in_blocks(SplitModel& model, int round, const BlockSearchOptions& options,
                                const Context* context);

}  // namespace delmesh
