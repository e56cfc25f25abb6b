#include "simplify/thinner.hpp"

#include "delmesh/mesh/edits.hpp"
#include "simplify/edge_cost.hpp"
#include "simplify/numbering.hpp"
#include "simplify/sweep_tools.hpp"

#include <algorithm>

namespace delmesh {
namespace {

/// By so much more of the edges are tried where hardly any of the cheapest could be collapsed.
constexpr double wider = 0.2;

/// The old ids of what has a new one, in the order of these.
std::vector<VertexId> living(const std::vector<VertexId>& map) {
    std::vector<VertexId> old;
    old.reserve(map.size() - static_cast<std::size_t>(std::count(map.begin(), map.end(), VertexId())));
    for (std::size_t v = 0; v < map.size(); ++v)
        if (map[v].valid()) old.emplace_back(v);
    return old;
}

}  // namespace

Thinner::Thinner(Mesh& mesh, const Tuning& tuning, Precision precision)
    : mesh_(mesh),
      tuning_(sweeps::without_search(tuning)),
      scale_(local_scale(mesh)),
      precision_(precision),
      placer_(mesh, tuning_),
      weights_(mesh, scale_, tuning_, VertexWeights::Kept::none),
      vertices_(mesh.vertex_count()),
      parent_(mesh.vertex_count()) {
    for (std::size_t v = 0; v < parent_.size(); ++v) parent_[v] = VertexId(v);
}

void Thinner::run(std::size_t vertices, const Context* context) {
    const std::size_t start = vertices_;
    double part = tuning_.sweep_part;
    while (vertices_ > vertices && part < 1 && !is_cancelled(context)) {
        merged_.assign(mesh_.vertex_count(), false);
        const std::size_t before = vertices_;
        sweep(vertices, choose_limit(part), context);
        report_progress(context, "thin",
                        static_cast<double>(start - vertices_) / static_cast<double>(start - vertices));
        if (before - vertices_ <= vertices_ / 256) {
            part += wider;  // what was cheap is blocked
            continue;
        }
        const double usual2 = drift_sum_ / static_cast<double>(before - vertices_);
        drift_limit2_ = std::max(tuning_.sweep_reach * tuning_.sweep_reach * usual2, sweeps::rounding2);
        drift_sum_ = 0;
        if (static_cast<double>(vertices_) < sweeps::sparse * static_cast<double>(mesh_.vertex_count())) close_gaps();
    }
    close_gaps();
}

/// A quantile of the costs.
float Thinner::choose_limit(double part) {
    some_keys_.clear();
    const std::size_t stride = 1 + mesh_.halfedge_count() / sweeps::keys_looked_at;
    for (std::size_t i = 0; i < mesh_.halfedge_count(); i += stride) {
        const HalfedgeId h(i);
        if (mesh_.origin(h).valid() && mesh_.names_edge(h)) some_keys_.push_back(static_cast<float>(key_of(h)));
    }
    return sweeps::quantile(some_keys_, part);
}

/// At most one edge is merged into each vertex, so that no place gets ahead of the others.
void Thinner::sweep(std::size_t vertices, float limit, const Context* context) {
    for (std::size_t i = 0; i < mesh_.halfedge_count() && vertices_ > vertices; ++i) {
        if (i % sweeps::report_interval == 0 && is_cancelled(context)) return;
        const HalfedgeId h(i);
        const VertexId u = mesh_.origin(h);
        if (!u.valid() || merged_[u.index()] || !mesh_.names_edge(h) || merged_[mesh_.target(h).index()]) continue;
        if (key_of(h) <= limit) visit(h, limit);
    }
}

double Thinner::key_of(HalfedgeId h) const {
    return lowest_cost(edge_cost(mesh_, weights_, h, scale_, tuning_));
}

void Thinner::visit(HalfedgeId h, float limit) {
    if (!gather(mesh_, h, scale_, star_)) return;
    EdgeCost cost = edge_cost(mesh_, weights_, h, scale_, tuning_);
    add_volume(star_, tuning_, cost);
    const auto place = placer_.best(star_, cost);
    if (!place || place->cost > tuning_.slack * limit) return;
    Vec3 w = star_.frame.to_mesh(place->point);
    if (precision_ == Precision::float32) w = round_to_float(w);
    if (!(tuning_.constrained ? keeps_delaunay(mesh_, star_, w) : keeps_area(mesh_, star_, w))) return;
    const double drift2 = find_drift2(star_.frame.to_local(w));
    if (drift2 > drift_limit2_) return;
    drift_sum_ += drift2;
    accept(h, w);
}

/// Of the ends of the edge, how far the one is from the star that comes to lie farther from it.
double Thinner::find_drift2(const Vec3& w) const {
    const double of_u = sweeps::find_distance2(star_, w, star_.u_point, 0);
    return std::max(of_u, sweeps::find_distance2(star_, w, star_.v_point, of_u));
}

void Thinner::accept(HalfedgeId h, const Vec3& w) {
    const VertexId kept = star_.u;
    const VertexId gone = star_.v;
    collapse(mesh_, h, w);
    weights_.changed(star_);
    parent_[name(gone).index()] = name(kept);
    --vertices_;
    ++collapses_;
    merged_[kept.index()] = true;
}

void Thinner::close_gaps() {
    const std::vector<VertexId> map = compact_vertices(mesh_);
    if (name_.empty())
        name_ = living(map);
    else
        move_down(name_, map);
    weights_.close_gaps(map);
    (void)compact_faces(mesh_);
    shrink(mesh_);
}

std::vector<VertexId> Thinner::merged_into() const {
    std::vector<VertexId> ids(parent_.size());
    for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) ids[name(VertexId(v)).index()] = VertexId(v);
    return sweeps::merged_into(parent_, ids);
}

}  // namespace delmesh
