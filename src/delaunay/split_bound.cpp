#include "delaunay/split_bound.hpp"

#include "delaunay/cluster_cores.hpp"
#include "delaunay/core_packing.hpp"
#include "delaunay/edge_need.hpp"

#include <vector>

namespace delmesh {

std::size_t strong_lower_bound(const MarkedMesh& marked, std::span<const EdgeId> bad, const SplitBoundOptions& options,
                               const Context* context) {
    std::vector<bool> is_open(marked.mesh().halfedge_count(), false);
    for (const EdgeId e : bad) is_open[e.index()] = true;
    BoundView view(marked, options.exact_facets, options.rounding);
    EdgeStudy study(view);
    std::vector<EdgeNeed> needs;
    needs.reserve(bad.size());
    std::size_t points = 0;
    for (const EdgeId e : bad) {
        if (is_cancelled(context)) return bad.size();
        needs.push_back(study.study(e, is_open));
        points += needs.back().points;
    }
    CorePacking packing(std::move(needs));
    points += packing.run();
    return points + ClusterCores(view, packing, is_open).run(context);
}

}  // namespace delmesh
