#include "delaunay/split_bound.hpp"

#include "delaunay/core_packing.hpp"
#include "delaunay/edge_need.hpp"

#include <vector>

namespace delmesh {
namespace {

std::vector<bool> mark_open(const MarkedMesh& marked, std::span<const EdgeId> bad) {
    std::vector<bool> is_open(marked.mesh().halfedge_count(), false);
    for (const EdgeId e : bad) is_open[e.index()] = true;
    return is_open;
}

std::vector<EdgeNeed> study_edges(BoundView& view, std::span<const EdgeId> bad, const std::vector<bool>& is_open,
                                  const Context* context) {
    EdgeStudy study(view);
    std::vector<EdgeNeed> needs;
    needs.reserve(bad.size());
    for (const EdgeId e : bad) {
        if (is_cancelled(context)) {
            needs.emplace_back().edge = e.value();
        } else {
            needs.push_back(study.study(e, is_open));
        }
    }
    return needs;
}

CorePacking pack(std::vector<EdgeNeed> needs, std::size_t& points) {
    for (const EdgeNeed& need : needs) points += need.points;
    CorePacking packing(std::move(needs));
    points += packing.run();
    return packing;
}

}  // namespace

SplitBoundOptions bound_options(const RemeshOptions& options) {
    SplitBoundOptions bound;
    bound.exact_facets = options.flat_tolerance_rel.number == 0;
    if (options.precision == Precision::float32) bound.rounding = 0x1p-21;
    return bound;
}

SplitBound::SplitBound(const MarkedMesh& marked, std::span<const EdgeId> bad, const SplitBoundOptions& options,
                       const Context* context)
    : is_open_(mark_open(marked, bad)),
      view_(marked, options.exact_facets, options.rounding),
      packing_(pack(study_edges(view_, bad, is_open_, context), points_)),
      clusters_(view_, packing_, is_open_) {
    points_ += clusters_.run(context);
}

std::size_t strong_lower_bound(const MarkedMesh& marked, std::span<const EdgeId> bad, const SplitBoundOptions& options,
                               const Context* context) {
    return SplitBound(marked, bad, options, context).points();
}

}  // namespace delmesh
