#include "simplify/polish.hpp"

#include "simplify/walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

/// A vertex goes elsewhere if it costs less than this part of what it brings there.
constexpr double margin = 0.8;
/// The part of the error of two faces that a vertex between them takes away, as a rule.
constexpr double usual_gain = 0.75;
/// So many places in a row where no vertex is worth more than elsewhere end the exchange.
constexpr int patience = 200;
/// So many edges are measured for each vertex that is to go.
constexpr std::size_t choice = 4;

constexpr auto smaller = [](const auto& a, const auto& b) {
    return a.value < b.value || (a.value == b.value && a.edge < b.edge);
};
constexpr auto larger = [](const auto& a, const auto& b) {
    return a.value > b.value || (a.value == b.value && a.edge < b.edge);
};

/// Keeps the first `most` by that order, sorted.
template <class Chances, class Order>
void keep_first(Chances& chances, std::size_t most, Order&& order) {
    const std::size_t kept = std::min(most, chances.size());
    std::partial_sort(chances.begin(), chances.begin() + static_cast<std::ptrdiff_t>(kept), chances.end(), order);
    chances.resize(kept);
}

}  // namespace

Polisher::Polisher(Mesh& mesh, SurfaceSamples& samples, Placer& placer, VertexWeights& weights, const Tuning& tuning,
                   double scale, const std::function<Vec3(const Vec3&)>& settle)
    : mesh_(mesh),
      samples_(samples),
      placer_(placer),
      weights_(weights),
      tuning_(tuning),
      scale_(scale),
      insertion_(mesh, samples, placer, scale, settle),
      collapse_(mesh, samples, placer, scale, settle) {}

bool Polisher::is_inside(HalfedgeId h) const {
    return mesh_.origin(h).valid() && !mesh_.is_boundary(h);
}

/// The faces have changed, maybe for a while only.
void Polisher::refresh(std::span<const FaceId> faces) {
    weights_.resize();
    for (const FaceId f : faces)
        for (const VertexId v : mesh_.corners().subspan(3 * f.index(), 3)) weights_.refresh(v);
}

/// The faces have changed for good.
void Polisher::mark(std::span<const FaceId> faces) {
    changed_.resize(mesh_.vertex_count());
    for (const FaceId f : faces) {
        if (!mesh_.is_live(f)) continue;
        for (const VertexId v : mesh_.corners().subspan(3 * f.index(), 3)) {
            changed_[v.index()] = true;
            touch(v);
        }
    }
}

void Polisher::touch(VertexId v) {
    touched_.resize(mesh_.vertex_count(), true);
    touched_[v.index()] = true;
}

bool Polisher::is_hopeless(HalfedgeId h) const {
    if (!hopeless_[h.index()]) return false;
    bool is_touched = false;
    for (const VertexId v : {mesh_.origin(h), mesh_.target(h)})
        each_outgoing(mesh_, v, [&](HalfedgeId out) {
            is_touched = is_touched || touched_[v.index()] || touched_[mesh_.target(out).index()];
        });
    return !is_touched;
}

bool Polisher::try_collapse(HalfedgeId h, const TrialLimits& limits) {
    if (mesh_.is_boundary(mesh_.origin(h)) || mesh_.is_boundary(mesh_.target(h))) return false;
    if (!gather(mesh_, h, scale_, star_)) return false;
    kept_ = star_.u, kept_at_ = mesh_.point(kept_);
    gone_ = star_.v, gone_at_ = mesh_.point(gone_);
    EdgeCost cost = edge_cost(mesh_, weights_, h, scale_, tuning_);
    add_volume(star_, tuning_, cost);
    if (const auto place = placer_.best(star_, cost)) return collapse_.collapse(star_, h, place->point, limits);
    // With flips, any place may do.
    const auto factors = factorise(cost.steered);
    return (factors && collapse_.collapse(star_, h, factors->lowest, limits)) ||
           collapse_.collapse(star_, h, star_.u_point, limits) || collapse_.collapse(star_, h, star_.v_point, limits);
}

void Polisher::keep_collapse() {
    collapse_.keep();
    const Vec3& now = mesh_.point(kept_);
    Quadric merged = weights_.history(kept_).moved_to((now - kept_at_) * scale_);
    merged += weights_.history(gone_).moved_to((now - gone_at_) * scale_);
    weights_.set_history(kept_, merged);
    worst_error2_ = std::max(worst_error2_, mean_square(merged));
    refresh(collapse_.faces());
    mark(collapse_.faces());
}

void Polisher::rank_errors(std::size_t most) {
    std::vector<double> error(mesh_.face_count());
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) error[f] = samples_.error(FaceId(f));
    errors_.clear();
    for (std::size_t i = 0; i < mesh_.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (is_inside(h) && mesh_.names_edge(h))
            errors_.push_back({error[Mesh::face(h).index()] + error[Mesh::face(mesh_.twin(h)).index()], h});
    }
    keep_first(errors_, most, larger);
}

/// By their quadrics, as if those were the sum.
void Polisher::rank_collapses(std::size_t most) {
    collapses_.clear();
    for (std::size_t i = 0; i < mesh_.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (!is_inside(h) || !mesh_.names_edge(h)) continue;
        const EdgeCost cost = edge_cost(mesh_, weights_, h, scale_, tuning_);
        if (cost.trace > 0) collapses_.push_back({lowest_cost(cost) / std::sqrt(cost.trace), h});
    }
    keep_first(collapses_, most, smaller);
}

void Polisher::measure_collapses(TrialLimits limits, std::size_t wanted) {
    std::size_t kept = 0;
    double worst = std::numeric_limits<double>::min();
    hopeless_.resize(mesh_.halfedge_count());
    touched_.resize(mesh_.vertex_count(), true);
    for (const Chance chance : collapses_) {
        if (is_hopeless(chance.edge)) continue;
        const bool ok = try_collapse(chance.edge, limits);
        hopeless_[chance.edge.index()] = !ok;
        if (!ok) continue;
        collapses_[kept++] = {collapse_.change(), chance.edge};
        collapse_.undo();
        worst = std::max(worst, collapses_[kept - 1].value);
        if (kept == wanted) limits.most = std::min(limits.most, worst);
    }
    touched_.assign(mesh_.vertex_count(), false);
    collapses_.resize(kept);
    std::sort(collapses_.begin(), collapses_.end(), smaller);
    next_collapse_ = 0;
}

std::size_t Polisher::reduce(std::size_t count, double allowed2, const Context* context) {
    changed_.assign(mesh_.vertex_count(), false);
    hopeless_.clear();  // prices rise on the way
    rank_collapses(choice * count);
    measure_collapses({std::numeric_limits<double>::max(), allowed2}, count);
    std::size_t done = 0;
    for (std::size_t i = 0; i < collapses_.size() && done < count && !is_cancelled(context); ++i) {
        const HalfedgeId h = collapses_[i].edge;
        // What has become much dearer by the others has its turn in the next round.
        const double most = collapses_[std::min(collapses_.size() - 1, i + count)].value;
        if (!is_inside(h) || !try_collapse(h, {std::max(most, std::numeric_limits<double>::min()), allowed2})) continue;
        keep_collapse();
        ++done;
    }
    return done;
}

/// A new vertex on the edge of h, for one that costs less.
bool Polisher::exchange_at(HalfedgeId h, double allowed2) {
    const double least = collapses_[next_collapse_].value / margin;
    if (!insertion_.insert(h, {std::min(0.0, -least), allowed2, true})) return false;
    const double most = -margin * insertion_.change();
    refresh(insertion_.faces());
    while (next_collapse_ < collapses_.size() && collapses_[next_collapse_].value < most) {
        const HalfedgeId c = collapses_[next_collapse_++].edge;
        if (!is_inside(c) || !try_collapse(c, {most, allowed2, true})) continue;
        insertion_.keep();
        mark(insertion_.faces());
        keep_collapse();
        return true;
    }
    insertion_.undo();
    refresh(insertion_.faces_before());
    return false;
}

std::size_t Polisher::exchange(std::size_t most, double allowed2, const Context* context) {
    changed_.assign(mesh_.vertex_count(), false);
    rank_errors(std::min(most, mesh_.vertex_count()));
    if (errors_.empty()) return 0;
    rank_collapses(std::min(most, mesh_.vertex_count()));
    measure_collapses({margin * usual_gain * errors_[errors_.size() / 20].value, allowed2, true}, collapses_.size());
    std::size_t exchanged = 0;
    int failed = 0;
    for (const Chance& chance : errors_) {
        if (next_collapse_ >= collapses_.size() || failed > patience || is_cancelled(context)) break;
        if (!is_inside(chance.edge)) continue;
        const bool ok = exchange_at(chance.edge, allowed2);
        failed = ok ? 0 : failed + 1;
        exchanged += ok ? 1 : 0;
    }
    return exchanged;
}

}  // namespace delmesh
