#include "simplify/sweeper.hpp"

#include "delmesh/mesh/edits.hpp"
#include "simplify/edge_cost.hpp"
#include "simplify/sweep_tools.hpp"
#include "simplify/walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

/// After so many sweeps that hardly collapsed anything, others must go on.
constexpr int poor_in_a_row = 3;

/// As `move_down`, for three items a face.
template <class Item>
void move_sides_down(std::vector<Item>& items, const std::vector<FaceId>& map) {
    std::size_t count = 0;
    for (std::size_t f = 0; f < map.size(); ++f) {
        if (!map[f].valid()) continue;
        for (std::size_t k = 0; k < 3; ++k) items[count++] = items[3 * f + k];
    }
    items.resize(count);
    items.shrink_to_fit();
}

const Mesh& reordered(Mesh& mesh, Numbering& numbering, double scale) {
    numbering.renumber(mesh, in_order_of_place(mesh, scale));
    return mesh;
}

}  // namespace

Sweeper::Sweeper(Mesh& mesh, const Tuning& tuning, Precision precision, Numbering& numbering)
    : mesh_(mesh),
      tuning_(sweeps::without_search(tuning)),
      scale_(local_scale(mesh)),
      precision_(precision),
      numbering_(numbering),
      placer_(mesh, tuning_),
      weights_(reordered(mesh, numbering, scale_), scale_, tuning_, VertexWeights::Kept::changed),
      vertices_(mesh.vertex_count()),
      key_(mesh.halfedge_count(), -1),
      waits_(mesh.halfedge_count()),
      watches_(mesh.vertex_count()),
      far_at_(mesh.vertex_count(), none),
      parent_(numbering.vertex_names()) {
    for (std::size_t v = 0; v < parent_.size(); ++v) parent_[v] = VertexId(v);
}

void Sweeper::run(std::size_t vertices, const Context* context) {
    const std::size_t start = vertices_;
    int poor = 0;
    while (vertices_ > vertices && !is_cancelled(context)) {
        merged_.assign(mesh_.vertex_count(), false);
        const std::size_t before = vertices_;
        sweep(vertices, choose_limit(), context);
        if (before - vertices_ <= vertices_ / 256) {
            if (++poor == poor_in_a_row) break;
            continue;  // what was blocked waits now, and others have their turn
        }
        poor = 0;
        const double usual2 = drift_sum_ / static_cast<double>(before - vertices_);
        drift_limit2_ = std::max(tuning_.sweep_reach * tuning_.sweep_reach * usual2, sweeps::rounding2);
        drift_sum_ = 0;
        if (static_cast<double>(vertices_) < sweeps::sparse * static_cast<double>(mesh_.vertex_count())) tidy();
        report_progress(context, "simplify",
                        static_cast<double>(start - vertices_) / static_cast<double>(start - vertices));
    }
    tidy();
}

/// A quantile of the costs of the edges that do not wait.
float Sweeper::choose_limit() {
    some_keys_.clear();
    const std::size_t stride = 1 + mesh_.halfedge_count() / sweeps::keys_looked_at;
    for (std::size_t i = 0; i < mesh_.halfedge_count(); i += stride) {
        const HalfedgeId h(i);
        if (mesh_.origin(h).valid() && mesh_.names_edge(h) && !waits_[i]) some_keys_.push_back(key_of(h));
    }
    return sweeps::quantile(some_keys_, tuning_.sweep_part);
}

/// At most one edge is merged into each vertex, so that no place gets ahead of the others.
void Sweeper::sweep(std::size_t vertices, float limit, const Context* context) {
    for (std::size_t i = 0; i < mesh_.halfedge_count() && vertices_ > vertices; ++i) {
        if (i % sweeps::report_interval == 0 && is_cancelled(context)) return;
        const HalfedgeId h(i);
        const VertexId u = mesh_.origin(h);
        if (!u.valid() || waits_[i] || merged_[u.index()] || !mesh_.names_edge(h)) continue;
        if (merged_[mesh_.target(h).index()]) continue;
        if (key_of(h) <= limit) visit(h, limit);
    }
}

float Sweeper::key_of(HalfedgeId h) {
    float& key = key_[h.index()];
    if (key < 0) key = static_cast<float>(lowest_cost(edge_cost(mesh_, weights_, h, scale_, tuning_)));
    return key;
}

void Sweeper::wait(HalfedgeId h, VertexId witness) {
    waits_[h.index()] = true;
    watches_.add(witness, h);
}

/// The faces around v have changed.
void Sweeper::wake(VertexId v) {
    woken_.clear();
    watches_.take(v, woken_);
    for (const HalfedgeId h : woken_) waits_[h.index()] = false;
}

void Sweeper::visit(HalfedgeId h, float limit) {
    if (!gather(mesh_, h, scale_, star_)) return wait(h, star_.u);
    EdgeCost cost = edge_cost(mesh_, weights_, h, scale_, tuning_);
    add_volume(star_, tuning_, cost);
    const auto place = placer_.best(star_, cost);
    if (!place) return wait(h, star_.ring[star_.after(placer_.witness())].vertex);
    if (place->cost > tuning_.slack * limit) {
        key_[h.index()] = static_cast<float>(place->cost);
        return;
    }
    weights_.prefetch_history(star_.u);
    weights_.prefetch_history(star_.v);
    Vec3 w = star_.frame.to_mesh(place->point);
    if (precision_ == Precision::float32) w = round_to_float(w);
    if (!keeps_delaunay(mesh_, star_, w)) return wait(h, star_.u);
    const Drift drift = find_drift(star_.frame.to_local(w));
    if (drift.distance2 > drift_limit2_) {
        key_[h.index()] = static_cast<float>(place->cost);
        return;
    }
    drift_sum_ += drift.distance2;
    keep_far(star_.u, star_.v, drift.point);
    accept(h, w);
}

/// Of the ends of the edge, and of what was merged into them, the point that comes to lie farthest from the star.
Sweeper::Drift Sweeper::find_drift(const Vec3& w) const {
    Drift worst;
    const auto look_at = [&](const Vec3& p) {
        const double distance2 = sweeps::find_distance2(star_, w, star_.frame.to_local(p), worst.distance2);
        if (distance2 > worst.distance2) worst = {distance2, p};
    };
    for (const VertexId v : {star_.u, star_.v}) {
        look_at(mesh_.point(v));
        const std::uint32_t at = far_at_[v.index()];
        if (at != none && far_[at] != mesh_.point(v)) look_at(far_[at]);
    }
    return worst;
}

void Sweeper::keep_far(VertexId kept, VertexId gone, const Vec3& point) {
    std::uint32_t& at = far_at_[kept.index()];
    const std::uint32_t spare = far_at_[gone.index()];
    if (at == none) {
        at = spare != none ? spare : far_.take();
    } else if (spare != none) {
        far_.give_back(spare);
    }
    far_[at] = point;
}

void Sweeper::accept(HalfedgeId h, const Vec3& w) {
    const VertexId kept = star_.u;
    const VertexId gone = star_.v;
    const HalfedgeId t = mesh_.twin(h);
    const VertexId left = mesh_.apex(h);
    const VertexId right = t.valid() ? mesh_.apex(t) : VertexId();
    const Vec3 local = star_.frame.to_local(w);
    const Quadric merged = weights_.merged_history(star_, local);
    worst_error2_ = std::max(worst_error2_, mean_square(merged));
    weights_.prepare(star_);
    collapse(mesh_, h, w);
    weights_.forget(gone);
    weights_.set_history(kept, merged);
    weights_.replace_star(star_, local, left, right);
    parent_[numbering_.name(gone).index()] = numbering_.name(kept);
    --vertices_;
    ++collapses_;
    merged_[kept.index()] = true;
    wake(kept);
    wake(gone);
    for (const Star::Corner& corner : star_.ring) wake(corner.vertex);
    each_outgoing(mesh_, kept, [&](HalfedgeId at) { key_[at.index()] = key_[Mesh::prev(at).index()] = -1; });
}

void Sweeper::close_vertex_gaps() {
    const std::vector<VertexId> map = numbering_.close_vertex_gaps(mesh_);
    watches_.close_gaps(map);
    weights_.close_gaps(map);
    move_down(far_at_, map);
    shrink(mesh_);
}

/// Closes the gaps between the ids, step by step: what one gives back makes room for the next.
void Sweeper::tidy() {
    close_vertex_gaps();
    const std::vector<FaceId> faces = numbering_.close_face_gaps(mesh_);
    watches_.renumber_items([&faces](HalfedgeId& h) {
        const FaceId face = faces[Mesh::face(h).index()];
        if (face.valid()) h = HalfedgeId(face.value() * 3 + h.value() % 3);
        return face.valid();
    });
    move_sides_down(waits_, faces);
    move_sides_down(key_, faces);
    shrink(mesh_);
}

double Sweeper::worst_error() const {
    return std::sqrt(worst_error2_) / scale_;
}

std::vector<VertexId> Sweeper::merged_into() const {
    return sweeps::merged_into(parent_, numbering_.ids());
}

}  // namespace delmesh
