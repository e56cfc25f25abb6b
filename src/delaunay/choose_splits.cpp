#include "delaunay/choose_splits.hpp"

#include "delaunay/split_model.hpp"
#include "delaunay/split_regions.hpp"
#include "delaunay/split_search.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

/// A unit of work takes about 10 ns.
constexpr double work_per_edge = 25'000;
constexpr double least_work = 150e6;
constexpr int default_effort = 3;

std::vector<PlacedPoint> place(SplitModel& model, std::span<const SplitPoint> splits) {
    const Mesh& mesh = model.layout().marked().mesh();
    std::vector<PlacedPoint> points;
    points.reserve(splits.size());
    HalfedgeId h;
    for (std::size_t i = 0; i < splits.size(); ++i) {
        if (i == 0 || splits[i].a != splits[i - 1].a || splits[i].b != splits[i - 1].b) {
            h = mesh.find_halfedge(splits[i].a, splits[i].b);
            if (!h.valid()) h = mesh.find_halfedge(splits[i].b, splits[i].a);
        }
        if (h.valid() && !model.layout().marked().is_planar(h)) points.push_back({model.edge_of(h), splits[i].t});
    }
    std::sort(points.begin(), points.end());
    return points;
}

std::vector<SplitPoint> splits_of(const SplitModel& model) {
    const Mesh& mesh = model.layout().marked().mesh();
    std::vector<SplitPoint> splits;
    splits.reserve(model.point_count());
    for (std::uint32_t e = 0; e < model.edge_count(); ++e) {
        const HalfedgeId h = model.layout().edge(e).halfedge;
        const VertexId a = std::min(mesh.origin(h), mesh.target(h));
        const VertexId b = std::max(mesh.origin(h), mesh.target(h));
        for (std::uint32_t i = 0; i < model.point_count(e); ++i) splits.push_back({a, b, model.parts(e)[i].end});
    }
    return splits;
}

}  // namespace

std::vector<SplitPoint> choose_splits(const MarkedMesh& marked, std::span<const EdgeId> bad,
                                      std::span<const SplitPoint> baseline, const SplitSearchOptions& options,
                                      const Context* context) {
    SplitModel model(marked);
    std::vector<std::uint32_t> open;
    open.reserve(bad.size());
    for (const EdgeId e : bad) {
        open.push_back(model.edge_of(Mesh::halfedge(e)));
        model.prepare(open.back());
    }
    SplitSearch search(model, options.seed);
    search.construct(open);
    if (options.effort > 0) {
        const double full = std::max(work_per_edge * static_cast<double>(bad.size()), least_work);
        search.improve(static_cast<std::uint64_t>(std::ldexp(full, options.effort - default_effort)), context);
    }
    if (is_cancelled(context)) return {};
    if (!baseline.empty()) take_better_regions(model, search.open(), place(model, baseline));
    return splits_of(model);
}

}  // namespace delmesh
