#include "delaunay/close_gaps.hpp"

#include <algorithm>

namespace delmesh {
namespace {

constexpr int replace_tries = 6;
constexpr std::size_t least_steps = 12;
/// In units of the model's work, for a corner or line that is looked at.
constexpr std::uint64_t look_work = 2;

}  // namespace

GapCloser::GapCloser(SplitModel& model, std::span<const EdgeId> bad, const SplitBoundOptions& options,
                     std::uint64_t seed, const Context* context)
    : model_(model),
      random_(seed),
      repair_(model, random_),
      bound_(model.layout().marked(), bad, options, context) {
    task_.replace = [this](std::span<const std::uint32_t> edges, std::span<const VaguePoint> places) {
        return replace(edges, places);
    };
}

void GapCloser::run(std::uint64_t work, const Context* context) {
    count_points();
    task_.work = bound_.gap_work() + work / look_work;
    const std::uint64_t before = bound_.gap_work();
    bound_.close_gaps(task_, context);
    model_.count_work(look_work * (bound_.gap_work() - before));
}

void GapCloser::count_points() {
    task_.count.assign(model_.layout().marked().mesh().halfedge_count(), 0);
    for (std::uint32_t e = 0; e < model_.edge_count(); ++e)
        if (model_.point_count(e) > 0) task_.count[id_of(e)] = model_.point_count(e);
}

/// Fewer points by these, with some repair.
bool GapCloser::replace(std::span<const std::uint32_t> edges, std::span<const VaguePoint> places) {
    for (int i = 0; i < replace_tries; ++i) {
        if (!replace_once(edges, places, least_steps << i)) continue;
        count_points();
        return true;
    }
    return false;
}

bool GapCloser::replace_once(std::span<const std::uint32_t> edges, std::span<const VaguePoint> places,
                             std::size_t steps) {
    const std::size_t before = model_.point_count();
    model_.begin();
    for (const std::uint32_t id : edges) {
        const std::uint32_t e = model_.edge_of(Mesh::halfedge(EdgeId(id)));
        model_.prepare(e);
        points_.clear();
        for (const VaguePoint& place : places)
            if (place.edge == id) points_.push_back(along_edge(id, place.at.from));
        std::sort(points_.begin(), points_.end());
        if (model_.is_movable(e)) model_.cut(e, 0, model_.point_count(e), points_);
    }
    task_.broken.clear();
    for (std::size_t i = 0; i < model_.suspect_count(); ++i)
        if (model_.first_bad(model_.suspect(i)) >= 0) task_.broken.push_back(id_of(model_.suspect(i)));
    if (repair_.run(before - 1, steps, random_.chance(0.5))) {
        model_.commit();
        return true;
    }
    model_.rollback();
    return false;
}

std::uint32_t GapCloser::id_of(std::uint32_t e) const {
    return model_.layout().marked().mesh().edge(model_.layout().edge(e).halfedge).value();
}

/// From its smaller vertex.
double GapCloser::along_edge(std::uint32_t id, double t) const {
    const Mesh& mesh = model_.layout().marked().mesh();
    const HalfedgeId h = Mesh::halfedge(EdgeId(id));
    return mesh.origin(h) < mesh.target(h) ? t : 1 - t;
}

}  // namespace delmesh
