#include "simplify/loosen.hpp"

#include "delmesh/mesh/edits.hpp"
#include "simplify/diagonal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

/// How far apart the two diagonals are that a flip exchanges, on the lines through them.
double height_of_flip(const Star& star) {
    const Vec3& p = star.ring[0].point;
    const Vec3& q = star.ring[2].point;
    const Vec3 n = cross(q - p, star.ring[1].point);
    const double length2 = squared_norm(n);
    return length2 > 0 ? std::abs(dot(p, n)) / std::sqrt(length2) : std::numeric_limits<double>::infinity();
}

/// Samples slide as long as half of what is allowed is not reached: the surface has to stay near them, too.
double least_watched(double allowed2) {
    return 0.5 * std::sqrt(allowed2);
}

}  // namespace

bool Loosener::flip_edge(HalfedgeId h, double allowed2) {
    if (!can_flip_delaunay(mesh_, scale_, h)) return false;
    if (samples_ != nullptr) {
        gather_flipped(mesh_, h, scale_, star_);
        if (samples_->let_slide(star_, height_of_flip(star_), least_watched(allowed2))) return flip(mesh_, h), true;
        samples_->freshen(mesh_, scale_, star_);
        samples_->gather(star_);
        const double before = samples_->present().forward;
        if (samples_->measure(star_, {}).forward > std::max(before, allowed2)) return false;
    }
    flip(mesh_, h);
    if (samples_ != nullptr) samples_->commit(star_);
    return true;
}

/// Towards a neighbour and another one, mostly not far.
Vec3 Loosener::draw_place() {
    const auto neighbour = [this] {
        return star_.ring[static_cast<std::size_t>(random_.uniform() * static_cast<double>(star_.ring.size()))].point;
    };
    const double part = random_.uniform();
    const double far = 0.5 * part * part * part;
    const Vec3 first = neighbour();
    const Vec3 second = neighbour();
    return first * far + second * (far * random_.uniform());
}

void Loosener::move(VertexId v, const Vec3& to) {
    moved_(v, to);
    mesh_.set_point(v, to);
}

bool Loosener::move_vertex(VertexId v, double allowed2) {
    gather(mesh_, v, scale_, star_);
    const Vec3 w = draw_place();
    std::size_t first = 0;
    if (find_blocker(mesh_, star_, w, first) != Blocker::none) return false;
    const Vec3 to = settle_(star_.frame.to_mesh(w));
    if (to == mesh_.point(v) || !delmesh::keeps_delaunay(mesh_, star_, to)) return false;
    if (samples_ == nullptr) return move(v, to), true;
    const Vec3 there = star_.frame.to_local(to);
    if (samples_->let_slide(star_, std::sqrt(squared_norm(there)), least_watched(allowed2))) return move(v, to), true;
    samples_->freshen(mesh_, scale_, star_);
    samples_->gather(star_);
    const double before = std::max(samples_->present().forward, samples_->measure_backward(star_, {}));
    if (samples_->measure(star_, there).worst() > std::max(before, allowed2)) return false;
    move(v, to);
    samples_->commit(star_);
    return true;
}

std::size_t Loosener::run(const Pass& pass) {
    random_ = Random(pass.seed);
    std::size_t changes = 0;
    for (std::size_t i = 0; i < mesh_.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (!mesh_.origin(h).valid() || !mesh_.names_edge(h) || mesh_.is_boundary(h) || random_.uniform() < 0.5)
            continue;
        changes += flip_edge(h, pass.allowed2) ? 1 : 0;
    }
    for (std::size_t i = 0; i < mesh_.vertex_count(); ++i) {
        const VertexId v(i);
        if (mesh_.halfedge(v).valid() && (pass.boundary || !mesh_.is_boundary(v)))
            changes += move_vertex(v, pass.allowed2) ? 1 : 0;
    }
    return changes;
}

}  // namespace delmesh
