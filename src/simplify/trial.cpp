#include "simplify/trial.hpp"

#include "delmesh/mesh/edits.hpp"
#include "exact/inline.hpp"
#include "simplify/diagonal.hpp"
#include "simplify/sample_fit.hpp"
#include "simplify/walk.hpp"

#include <algorithm>
#include <iterator>

namespace delmesh {
namespace {

/// Mostly two or three are enough; a chain of many has gone astray.
constexpr int most_flips = 16;
/// Moves of the new vertex towards the samples.
constexpr int most_moves = 1;
constexpr double least_gain = 0.01;
constexpr double regular = 1e-3;

SampleError sum_up(const SurfaceSamples& samples, std::span<const SurfaceSamples::Place> places) {
    SampleError error;
    for (const SurfaceSamples::Place& place : places) {
        error.sum += samples.weight(place) * static_cast<double>(place.distance2);
        error.forward = std::max<double>(error.forward, place.distance2);
    }
    return error;
}

}  // namespace

void Trial::push_sides(FaceId f) {
    const HalfedgeId h = Mesh::halfedge(f);
    stack_.insert(stack_.end(), {h, Mesh::next(h), Mesh::prev(h)});
}

/// Flips what is not Delaunay among the edges of the changed faces, and what that makes so.
bool Trial::make_delaunay() {
    stack_.clear();
    for (const FaceId f : log_.changed())
        if (mesh_.is_live(f)) push_sides(f);
    for (int flips = 0; !stack_.empty();) {
        const HalfedgeId h = stack_.back();
        stack_.pop_back();
        const HalfedgeId t = mesh_.twin(h);
        const Vec3& p = mesh_.point(mesh_.origin(h));
        const Vec3& q = mesh_.point(mesh_.target(h));
        const Vec3& u = mesh_.point(mesh_.apex(h));
        if (!t.valid()) {
            if (exact::right_angle_sign_inline(p, q, u) == Sign::negative) return false;
            continue;
        }
        if (exact::delaunay_sign_inline(p, q, u, mesh_.point(mesh_.apex(t))) != Sign::negative) continue;
        if (++flips > most_flips || !can_flip(mesh_, h) || turns_over(mesh_, scale_, h)) return false;
        log_.flip(h);
        push_sides(Mesh::face(h));
        push_sides(Mesh::face(t));
    }
    return std::none_of(log_.changed().begin(), log_.changed().end(), [this](FaceId f) {
        const HalfedgeId h = Mesh::halfedge(f);
        return mesh_.is_live(f) &&
               exact::are_collinear_inline(mesh_.point(mesh_.origin(h)), mesh_.point(mesh_.target(h)),
                                           mesh_.point(mesh_.apex(h)));
    });
}

void Trial::fit(VertexId v, double allowed2) {
    for (int i = 0; i < most_moves; ++i) {
        gather(mesh_, v, scale_, star_);
        samples_.gather(star_);
        EdgeCost cost;
        if (!fit_to_samples(star_, samples_, {}, regular, cost)) return;
        const auto place = placer_.improve(star_, cost, {});
        if (!place) return;
        const Vec3 w = settle_(star_.frame.to_mesh(place->point));
        if (w == mesh_.point(v) || !keeps_delaunay(mesh_, star_, w)) return;
        const Vec3 there = star_.frame.to_local(w);
        const double most = std::max(samples_.present().forward, allowed2);
        SampleError after = samples_.measure_forward(star_, there);
        if (!(after.sum < (1 - least_gain) * samples_.present().sum)) return;
        after.backward = samples_.measure_backward(star_, there);
        if (after.worst() > most && after.worst() > std::max(most, samples_.measure_backward(star_, {}))) return;
        log_.set_point(v, w);
        samples_.commit(star_);
    }
}

/// The faces at the ring have samples that may move as well.
void Trial::take_faces_around() {
    const std::size_t known = changed_.size();
    for (const VertexId w : ring_)
        each_outgoing(mesh_, w, [&](HalfedgeId h) {
            const FaceId f = Mesh::face(h);
            const auto end = changed_.begin() + static_cast<std::ptrdiff_t>(known);
            if (!std::binary_search(changed_.begin(), end, f)) changed_.push_back(f);
        });
    const auto added = changed_.begin() + static_cast<std::ptrdiff_t>(known);
    std::sort(added, changed_.end());
    changed_.erase(std::unique(added, changed_.end()), changed_.end());
    const std::span<const FaceId> faces = std::span(changed_).subspan(known);
    living_.insert(living_.end(), faces.begin(), faces.end());
    samples_.gather(faces, beside_);
    before_.insert(before_.end(), beside_.begin(), beside_.end());
}

void Trial::fit_around(VertexId v, double allowed2) {
    ring_.clear();
    each_outgoing(mesh_, v, [&](HalfedgeId h) { ring_.push_back(mesh_.target(h)); });
    take_faces_around();
    for (const VertexId w : ring_)
        if (!mesh_.is_boundary(w)) fit(w, allowed2);
    fit(v, allowed2);
}

/// From the samples of the changed faces to those, and back.
double Trial::worst_around(VertexId v) {
    gather(mesh_, v, scale_, star_);
    samples_.gather(star_);
    samples_.gather(living_, after_);
    const double flipped = samples_.measure_backward(mesh_, scale_, living_, after_, v);
    return std::max({samples_.measure_backward(star_, {}), flipped, sum_up(samples_, after_).forward});
}

bool Trial::judge(VertexId v, const TrialLimits& limits) {
    // What fits may still take back: a vertex that has moved is worth a try at more than the limit.
    constexpr double hope = 3;
    constexpr double hope_around = 2;
    samples_.gather(changed_, before_);
    const SampleError before = sum_up(samples_, before_);
    const double most = limits.most > 0 ? before.sum + hope * limits.most : hope * before.sum;
    after_ = before_;
    const SampleError after = samples_.find_places(mesh_, scale_, living_, most, after_);
    if (after.sum > most) return false;
    samples_.put(changed_, after_);
    has_moved_samples_ = true;
    const double unfitted = samples_.sum();
    const auto change = [&] { return after.sum - before.sum + (samples_.sum() - unfitted); };
    fit(v, limits.allowed2);
    if (limits.fits_around && change() < limits.most * (limits.most > 0 ? hope_around : 1 / hope_around))
        fit_around(v, limits.allowed2);
    change_ = change();
    return change_ < limits.most && worst_around(v) <= std::max(sum_up(samples_, before_).forward, limits.allowed2);
}

bool Trial::finish(VertexId v, const TrialLimits& limits) {
    if (make_delaunay()) {
        changed_ = log_.changed();
        std::sort(changed_.begin(), changed_.end());
        changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
        living_.clear();
        std::copy_if(changed_.begin(), changed_.end(), std::back_inserter(living_),
                     [this](FaceId f) { return mesh_.is_live(f); });
        samples_.set_faces(mesh_.face_count());
        if (judge(v, limits)) return true;
    }
    undo();
    return false;
}

bool Trial::collapse(const Star& star, HalfedgeId h, const Vec3& w, const TrialLimits& limits) {
    if (turns_over(star, w)) return false;
    const VertexId kept = mesh_.origin(h);
    log_.keep();
    log_.collapse(h, settle_(star.frame.to_mesh(w)));
    return finish(kept, limits);
}

bool Trial::insert(HalfedgeId h, const TrialLimits& limits) {
    if (!can_split(mesh_, h)) return false;
    const Vec3 middle = mesh_.point(mesh_.origin(h)) * 0.5 + mesh_.point(mesh_.target(h)) * 0.5;
    log_.keep();
    return finish(log_.split_edge(h, settle_(middle)), limits);
}

void Trial::keep() {
    has_moved_samples_ = false;
    log_.keep();
}

void Trial::undo() {
    if (has_moved_samples_) samples_.put(changed_, before_);
    has_moved_samples_ = false;
    log_.undo();
    samples_.set_faces(mesh_.face_count());
    original_.clear();
    std::copy_if(changed_.begin(), changed_.end(), std::back_inserter(original_),
                 [this](FaceId f) { return f.index() < mesh_.face_count(); });
}

}  // namespace delmesh
