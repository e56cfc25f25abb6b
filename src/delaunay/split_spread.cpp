// The last step of the search: the same number of points, but farther apart.

#include "delaunay/split_search.hpp"

namespace delmesh {
namespace {

constexpr int spread_passes = 3;

}  // namespace

void SplitSearch::spread(std::uint64_t work) {
    limit_work(work);
    for (int pass = 0; pass < spread_passes; ++pass)
        for (std::uint32_t e = 0; e < model_.edge_count(); ++e)
            for (std::size_t i = 0; i < model_.point_count(e) && !repair_.is_exhausted(); ++i)
                if (model_.is_movable(e)) repair_.spread(e, i);
}

}  // namespace delmesh
