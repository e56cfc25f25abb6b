#include "simplify/decimator.hpp"

#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "simplify/polish.hpp"
#include "simplify/tangle.hpp"
#include "simplify/walk.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace delmesh {
namespace {

/// An edge is not queued again for a cost that has grown by less than this part.
constexpr double cost_tolerance = 1e-3;
/// Collapses between two looks at the context.
constexpr std::size_t report_interval = 1024;
/// A squared distance, local unit, that may be all rounding.
constexpr double rounding2 = 1e-14;
/// When nothing else is left, the allowed squared distance grows to this much more than the smallest one asked for.
constexpr double raise = 1.1;

std::size_t count_used(const Mesh& mesh) {
    std::size_t used = 0;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) used += mesh.halfedge(VertexId(v)).valid() ? 1 : 0;
    return used;
}

}  // namespace

Decimator::Decimator(Mesh& mesh, const Tuning& tuning, const DecimatorLimits& limits, Recorder* recorder)
    : mesh_(mesh),
      tuning_(tuning),
      limits_(limits),
      recorder_(recorder),
      scale_(local_scale(mesh)),
      placer_(mesh, tuning_),
      weights_(mesh, scale_, tuning_),
      vertices_(count_used(mesh)) {}

void Decimator::enqueue_all() {
    is_outdated_ = false;
    queue_.reset(mesh_.halfedge_count());
    parked_.clear();
    blocked_.resize(mesh_.halfedge_count());
    stamp_.resize(mesh_.halfedge_count());
    watches_.reset(mesh_.vertex_count());
    raised2_ = 0;
    // Where handles have run out of vertices nearly all edges are like that, and all are asked again after each shake.
    const std::vector<VertexId> third = shaken_ ? find_tangles(mesh_) : std::vector<VertexId>();
    for (std::size_t i = 0; i < mesh_.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        forget(h);
        if (!mesh_.origin(h).valid() || !mesh_.names_edge(h)) continue;
        ++counts_.asked;
        if (shaken_ && third[i].valid())
            watches_.add(third[i], wait(h, Blocker::topology));
        else
            queue_.append(key_of(h), h.value());
    }
    queue_.heapify();
}

void Decimator::continue_from(std::unique_ptr<Sweeper> sweeper, std::vector<VertexId> merged_before) {
    for (std::size_t v = 0; v < mesh_.vertex_count(); ++v)
        weights_.set_history(VertexId(v), sweeper->weights().history(VertexId(v)));
    worst_error_ = sweeper->worst_error();
    std::vector<VertexId> now = sweeper->merged_into();
    for (VertexId& v : merged_before)
        if (v.valid()) v = now[v.index()];
    if (!merged_before.empty()) now.swap(merged_before);
    sweeper.reset();  // the samples need its room
    samples_->reattach(mesh_, scale_, now);
}

/// v is about to move.
void Decimator::move_history(VertexId v, const Vec3& to) {
    if (recorder_ != nullptr) recorder_->moved(v, mesh_.point(v));
    weights_.set_history(v, weights_.history(v).moved_to((to - mesh_.point(v)) * scale_));
}

/// Any vertex may have moved.
void Decimator::refresh_weights() {
    for (std::size_t v = 0; v < mesh_.vertex_count(); ++v)
        if (mesh_.halfedge(VertexId(v)).valid()) weights_.refresh(VertexId(v));
}

void Decimator::start_afresh() {
    refresh_weights();
    leave_queue();
}

/// Nothing waits for anything any more: the next run asks for all keys afresh.
void Decimator::leave_queue() {
    is_outdated_ = true;
    raised2_ = 0;
    std::fill(blocked_.begin(), blocked_.end(), Blocker::none);
}

std::size_t Decimator::refit(const RefitTuning& tuning, const Context* context) {
    const auto settle = [this](const Vec3& w) { return settled(w); };
    const auto moved = [this](VertexId v, const Vec3& w) { move_history(v, w); };
    samples_->freshen(mesh_, scale_);
    Refitter refitter(mesh_, *samples_, placer_, scale_, settle, moved);
    const std::size_t moves = refitter.run(tuning, allowed2(), context);
    // Large flat parts say nothing about what is usual elsewhere.
    constexpr double usually_busy = 0.8;
    quiet_ = std::max(1.0, usually_busy / samples_->busy_part());
    start_afresh();
    return moves;
}

void Decimator::close_gaps(Numbering& numbering) {
    drop_isolated(mesh_);
    follow(numbering.close_gaps(mesh_));
}

/// The mesh has been renumbered.
void Decimator::follow(const CompactMap& map) {
    weights_.renumber(map.vertex);
    if (samples_) samples_->renumber(map.face, mesh_.face_count());
    leave_queue();
}

namespace {

/// Around what a change has left.
constexpr RefitTuning nearby{.rounds = 2, .least_gain = 0.002};

/// Ids for the living ones: the same below `count`; those beyond get the ids of dead ones.
template <class Id>
std::vector<Id> fill_gaps(const Mesh& mesh, std::size_t all, std::size_t count) {
    std::vector<Id> ids(all);
    std::size_t gap = 0;
    for (std::size_t i = 0; i < all; ++i) {
        if (!mesh.is_live(Id(i))) continue;
        if (i >= count)
            while (mesh.is_live(Id(gap))) ++gap;
        ids[i] = Id(i < count ? i : gap++);
    }
    return ids;
}

}  // namespace

void Decimator::reduce(std::size_t vertices, const Context* context) {
    const auto settle = [this](const Vec3& w) { return settled(w); };
    samples_->freshen(mesh_, scale_);
    Polisher polisher(mesh_, *samples_, placer_, weights_, tuning_, scale_, settle);
    const auto moved = [&](VertexId v, const Vec3& w) { move_history(v, w), polisher.touch(v); };
    Refitter refitter(mesh_, *samples_, placer_, scale_, settle, moved);
    while (vertices_ > vertices && !is_cancelled(context)) {
        const std::size_t wanted = std::min(vertices_ - vertices, vertices / 25 + 1);
        const std::size_t done = polisher.reduce(wanted, allowed2(), context);
        vertices_ -= done;
        counts_.collapses += done;
        (void)refitter.run(nearby, allowed2(), polisher.changed(), context);
        refresh_weights();
        if (done <= wanted / 2) break;
    }
    worst_error_ = std::max(worst_error_, std::sqrt(polisher.worst_error2()) / scale_);
    leave_queue();
}

std::size_t Decimator::polish(const Context* context) {
    const std::size_t vertices = mesh_.vertex_count();
    const std::size_t faces = mesh_.face_count();
    const auto settle = [this](const Vec3& w) { return settled(w); };
    samples_->freshen(mesh_, scale_);
    Polisher polisher(mesh_, *samples_, placer_, weights_, tuning_, scale_, settle);
    const auto moved = [&](VertexId v, const Vec3& w) { move_history(v, w), polisher.touch(v); };
    Refitter refitter(mesh_, *samples_, placer_, scale_, settle, moved);
    std::size_t moves = 0;
    const std::size_t most = std::clamp(tuning_.polish_work / vertices, tuning_.polish_few, tuning_.polish_most);
    for (int round = 0; round < tuning_.polish_rounds && !is_cancelled(context); ++round) {
        const double before = samples_->mean2();
        moves += polisher.exchange(most, tuning_.polish_reach2 * allowed2(), context);
        moves += refitter.run(nearby, allowed2(), polisher.changed(), context);
        refresh_weights();
        if (!(samples_->mean2() < (1 - tuning_.polish_gain) * before)) break;
    }
    worst_error_ = std::max(worst_error_, std::sqrt(polisher.worst_error2()) / scale_);
    const CompactMap map{fill_gaps<VertexId>(mesh_, mesh_.vertex_count(), vertices),
                         fill_gaps<FaceId>(mesh_, mesh_.face_count(), faces)};
    renumber(mesh_, map);
    follow(map);
    return moves;
}

void Decimator::loosen(std::uint64_t seed, double freedom) {
    placer_.look_harder();
    shaken_ = true;
    const auto settle = [this](const Vec3& w) { return settled(w); };
    const auto moved = [this](VertexId v, const Vec3& w) { move_history(v, w); };
    Loosener loosener(mesh_, samples_ ? &*samples_ : nullptr, scale_, settle, moved);
    (void)loosener.run({.seed = seed, .boundary = seed % 4 == 3, .allowed2 = samples_ ? freedom * allowed2() : 0});
    start_afresh();
}

double Decimator::key_of(HalfedgeId h) const {
    return lowest_cost(edge_cost(mesh_, weights_, h, scale_, tuning_));
}

void Decimator::enqueue(HalfedgeId h) {
    forget(h);
    queue_.set(key_of(h), h.value());
}

/// h waits for nothing any more.
void Decimator::forget(HalfedgeId h) {
    blocked_[h.index()] = Blocker::none;
    ++stamp_[h.index()];
}

Decimator::Watch Decimator::wait(HalfedgeId h, Blocker why) {
    ++counts_.blocked[static_cast<std::size_t>(why)];
    blocked_[h.index()] = why;
    return {h, ++stamp_[h.index()]};
}

void Decimator::watch_ring(const Watch& watch) {
    for (const Star::Corner& corner : star_.ring) watches_.add(corner.vertex, watch);
}

void Decimator::block(HalfedgeId h, Blocker why) {
    const Watch watch = wait(h, why);
    if (why != Blocker::fold && why != Blocker::subtending && why != Blocker::incident) return watch_ring(watch);
    // Only the vertices of the condition that failed.
    const std::size_t i = placer_.witness();
    const std::size_t j = star_.after(i);
    for (const VertexId v : {star_.ring[i].vertex, star_.ring[j].vertex, star_.ring[star_.after(j)].vertex})
        watches_.add(v, watch);
    if (star_.ring[i].outer.valid()) watches_.add(star_.ring[i].outer, watch);
}

std::array<std::size_t, blocker_count> Decimator::count_blocked() const {
    std::array<std::size_t, blocker_count> counts{};
    for (const Blocker why : blocked_) ++counts[static_cast<std::size_t>(why)];
    return counts;
}

void Decimator::guard_for(std::size_t vertices) {
    guarded_ = static_cast<std::size_t>(std::min(1e18, tuning_.guard * static_cast<double>(vertices)));
}

/// The largest squared distance that a collapse may leave between the samples and the surface.
double Decimator::allowed2() const {
    return std::max({tuning_.reach * tuning_.reach * samples_->mean2() * quiet_, raised2_, rounding2});
}

void Decimator::park(HalfedgeId h, double distance2) {
    ++counts_.parked;
    const Watch watch = wait(h, Blocker::distance);
    watch_ring(watch);
    parked_.push_back({distance2, watch});
    std::push_heap(parked_.begin(), parked_.end(), std::greater<>());
}

/// Puts back into the queue what may be collapsed now.
void Decimator::release_parked() {
    while (!parked_.empty()) {
        const Parked first = parked_.front();
        const bool outdated = stamp_[first.watch.edge.index()] != first.watch.stamp;
        if (!outdated && first.distance2 > allowed2()) {
            if (!queue_.empty()) return;
            raised2_ = first.distance2 * raise;
        }
        std::pop_heap(parked_.begin(), parked_.end(), std::greater<>());
        parked_.pop_back();
        if (!outdated) enqueue(first.watch.edge);
    }
}

/// Watching the condition that failed does not see everything that may help: before giving up, all edges have another
/// turn, unless hardly anything has changed since the last time.
bool Decimator::retry() {
    if (counts_.collapses <= retried_ + vertices_ / 1024) return false;
    retried_ = counts_.collapses;
    enqueue_all();
    return !queue_.empty();
}

void Decimator::run(std::size_t vertices, const Context* context) {
    const std::size_t start = vertices_;
    if (is_outdated_ && vertices_ > vertices) enqueue_all();
    while (vertices_ > vertices) {
        if (samples_) release_parked();
        if (queue_.empty() && !retry()) return;
        if (++counts_.popped % report_interval == 0) {
            if (is_cancelled(context)) return;
            report_progress(context, "simplify",
                            static_cast<double>(start - vertices_) / static_cast<double>(start - vertices));
        }
        process(queue_.pop());
    }
}

/// The place as it will be stored.
Vec3 Decimator::settled(const Vec3& w) const {
    return limits_.precision == Precision::float32 ? round_to_float(w) : w;
}

bool Decimator::exceeds_error(const Quadric& merged) {
    const double error = std::sqrt(mean_square(merged)) / scale_;
    if (limits_.error > 0 && error > limits_.error) return true;
    worst_error_ = std::max(worst_error_, error);
    return false;
}

void Decimator::process(const Queue::Entry& entry) {
    const HalfedgeId h(entry.edge);
    if (!gather(mesh_, h, scale_, star_)) return block(h, Blocker::topology);
    EdgeCost cost = edge_cost(mesh_, weights_, h, scale_, tuning_);
    if (tuning_.volume > 0) add_volume(star_, tuning_, cost);
    const auto place = tuning_.paper ? placer_.paper(star_, cost) : placer_.best(star_, cost);
    if (!place) return block(h, placer_.blocker());
    if (!queue_.empty() && place->cost > tuning_.slack * queue_.top().key &&
        place->cost > entry.key * (1 + cost_tolerance)) {
        ++counts_.requeued;
        queue_.set(place->cost, h.value());
        return;
    }
    const Vec3 w = settled(star_.frame.to_mesh(place->point));
    const bool keeps = tuning_.constrained ? keeps_delaunay(mesh_, star_, w) : keeps_area(mesh_, star_, w);
    if (!keeps) return block(h, Blocker::rounding);
    const Vec3 local = star_.frame.to_local(w);
    const Quadric merged = weights_.merged_history(star_, local);
    if (exceeds_error(merged)) return block(h, Blocker::error);
    if (samples_) {
        samples_->freshen(mesh_, scale_, star_);
        samples_->gather(star_);
        const SampleError after = samples_->measure(star_, local);
        const double allowed = std::max(allowed2(), samples_->present().forward);
        if (vertices_ <= guarded_ && after.worst() > allowed) return park(h, after.worst());
    }
    accept(h, w, merged);
}

void Decimator::accept(HalfedgeId h, const Vec3& w, const Quadric& merged) {
    const VertexId kept = star_.u;
    const VertexId gone = star_.v;
    const VertexId left = mesh_.apex(h);
    const auto drop = [&](HalfedgeId at) {
        const HalfedgeId e = Mesh::halfedge(mesh_.edge(at));
        queue_.remove(e.value());
        forget(e);
    };
    const HalfedgeId t = mesh_.twin(h);
    const VertexId right = t.valid() ? mesh_.apex(t) : VertexId();
    drop(Mesh::next(h)), drop(Mesh::prev(h));
    if (t.valid()) drop(Mesh::next(t)), drop(Mesh::prev(t));
    if (recorder_ != nullptr) recorder_->collapsed(kept, gone, left, right, mesh_.point(kept), mesh_.point(gone));
    const Vec3 local = star_.frame.to_local(w);
    collapse(mesh_, h, w);
    if (samples_) samples_->commit(star_);
    --vertices_;
    ++counts_.collapses;
    weights_.set_history(kept, merged);
    weights_.replace_star(star_, local, left, right);
    each_edge(mesh_, kept, [&](HalfedgeId e) { enqueue(e); });
    wake(kept);
    wake(gone);
}

/// What was blocked by a condition on v goes back into the queue.
void Decimator::wake(VertexId v) {
    woken_.clear();
    watches_.take(v, woken_);
    for (const Watch& watch : woken_) {
        if (stamp_[watch.edge.index()] != watch.stamp) continue;
        ++counts_.woken;
        enqueue(watch.edge);
    }
}

}  // namespace delmesh
