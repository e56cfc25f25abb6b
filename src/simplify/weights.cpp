#include "simplify/weights.hpp"

#include "simplify/frame.hpp"
#include "simplify/numbering.hpp"
#include "simplify/walk.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

/// Planes that were computed lately: neighbours ask for them one after another. A power of two.
constexpr std::size_t recent_count = 4096;

/// Where so small a part is left of what was taken away, rounding may have eaten it.
constexpr double cancelled = 1e-8;

/// Adds planes through the origin.
class PlaneAdder {
public:
    PlaneAdder(const Tuning& tuning, Quadric& out) : tuning_(tuning), out_(out) {}

    void add_face(const Vec3& normal) {
        const double n2 = squared_norm(normal);
        // Weight area^2 for power 2, area for power 1; the normal is twice the area long.
        if (n2 > 0) out_.add_plane_through_origin(normal, tuning_.area_power == 2 ? 0.25 : 0.5 / std::sqrt(n2));
    }
    /// A plane through the edge, upright on a face.
    void add_upright(const Vec3& along, const Vec3& face_normal, double weight) {
        const Vec3 n = cross(along, face_normal);
        const double n2 = squared_norm(n);
        const double length2 = squared_norm(along);
        if (n2 > 0)
            out_.add_plane_through_origin(n, weight * (tuning_.area_power == 2 ? length2 * length2 : length2) / n2);
    }

private:
    const Tuning& tuning_;
    Quadric& out_;
};

}  // namespace

double mean_square(const Quadric& planes) {
    const double trace = planes.trace();
    return trace > 0 ? std::max(0.0, planes.c) / trace : 0;
}

VertexWeights::VertexWeights(const Mesh& mesh, double scale, const Tuning& tuning, Kept kept)
    : mesh_(mesh),
      scale_(scale),
      tuning_(tuning),
      at_(kept == Kept::none ? 0 : mesh.vertex_count(), none),
      rest_at_(at_) {
    if (kept != Kept::all)
        recent_.resize(recent_count);
    else
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) keep(VertexId(v), computed(VertexId(v)));
}

VertexWeights::Planes VertexWeights::computed(VertexId v) const {
    const Quadric q = planes_at(v);
    return {q.xx, q.xy, q.xz, q.yy, q.yz, q.zz};
}

/// From now on the planes of v are kept.
void VertexWeights::keep(VertexId v, const Planes& planes) {
    const std::uint32_t at = at_[v.index()] = current_.take();
    (void)history_.take();
    current_[at] = history_[at] = planes;
}

const VertexWeights::Planes& VertexWeights::current(VertexId v) const {
    if (const std::uint32_t at = at_.empty() ? none : at_[v.index()]; at != none) return current_[at];
    Recent& recent = recent_[v.index() % recent_count];
    if (recent.vertex != v) recent = {v, computed(v)};
    return recent.planes;
}

void VertexWeights::prepare(const Star& star) {
    const auto keep_one = [this](VertexId v) {
        if (at_[v.index()] == none) keep(v, current(v));
    };
    keep_one(star.u);
    for (const Star::Corner& corner : star.ring) keep_one(corner.vertex);
}

void VertexWeights::changed(const Star& star) {
    const auto forget_one = [this](VertexId v) {
        Recent& recent = recent_[v.index() % recent_count];
        if (recent.vertex == v) recent.vertex = VertexId();
    };
    forget_one(star.u);
    forget_one(star.v);
    for (const Star::Corner& corner : star.ring) forget_one(corner.vertex);
}

Quadric VertexWeights::history(VertexId v) const {
    const std::uint32_t at = at_[v.index()];
    const Planes& planes = at == none ? current(v) : history_[at];
    Quadric q;
    q.xx = planes.xx, q.xy = planes.xy, q.xz = planes.xz, q.yy = planes.yy, q.yz = planes.yz, q.zz = planes.zz;
    if (const std::uint32_t more = rest_at_[v.index()]; more != none) q.b = rest_[more].b, q.c = rest_[more].c;
    return q;
}

void VertexWeights::set_history(VertexId v, const Quadric& merged) {
    history_[at_[v.index()]] = {merged.xx, merged.xy, merged.xz, merged.yy, merged.yz, merged.zz};
    std::uint32_t& at = rest_at_[v.index()];
    if (at == none && merged.b == Vec3() && merged.c == 0) return;
    if (at == none) at = rest_.take();
    rest_[at] = {merged.b, merged.c};
}

void VertexWeights::forget(VertexId v) {
    if (std::uint32_t& at = at_[v.index()]; at != none) {
        current_.give_back(at);
        history_.give_back(at);
        at = none;
    }
    if (std::uint32_t& at = rest_at_[v.index()]; at != none) {
        rest_.give_back(at);
        at = none;
    }
}

Quadric VertexWeights::merged_history(const Star& star, const Vec3& w) const {
    Quadric merged = history(star.u).moved_to(w);
    merged += history(star.v).moved_to(w - star.v_point);
    return merged;
}

void VertexWeights::renumber(const std::vector<VertexId>& ids) {
    std::vector<std::uint32_t> at(mesh_.vertex_count(), none);
    std::vector<std::uint32_t> rest_at(mesh_.vertex_count(), none);
    for (std::size_t v = 0; v < ids.size(); ++v) {
        if (!ids[v].valid()) {
            forget(VertexId(v));
            continue;
        }
        at[ids[v].index()] = at_[v];
        rest_at[ids[v].index()] = rest_at_[v];
    }
    at_.swap(at);
    rest_at_.swap(rest_at);
}

void VertexWeights::close_gaps(const std::vector<VertexId>& ids) {
    for (Recent& recent : recent_)
        if (recent.vertex.valid()) recent.vertex = VertexId();
    if (at_.empty()) return;
    move_down(at_, ids);
    move_down(rest_at_, ids);
}

void VertexWeights::resize() {
    const std::size_t before = at_.size();
    at_.resize(mesh_.vertex_count(), none);
    rest_at_.resize(mesh_.vertex_count(), none);
    for (std::size_t v = before; v < at_.size(); ++v) keep(VertexId(v), {});
}

void VertexWeights::refresh(VertexId v) {
    if (tuning_.paper) return;
    kept_current(v) = computed(v);
}

void VertexWeights::replace_star(const Star& star, const Vec3& w, VertexId left, VertexId right) {
    if (tuning_.paper) return;
    if (!star.closed || tuning_.crease_cosine > -1) {
        refresh(star.u);
        for (const Star::Corner& corner : star.ring) refresh(corner.vertex);
        return;
    }
    constexpr double weight = 0.25;
    double largest2 = 0;
    Planes& centre = kept_current(star.u);
    centre = {};
    kept_current(left).add(star.dying[0], -weight);
    if (right.valid()) kept_current(right).add(star.dying[1], -weight);
    for (std::size_t i = 0; i < star.ring.size(); ++i) {
        const Star::Corner& corner = star.ring[i];
        const Star::Corner& next = star.ring[star.after(i)];
        Planes change;
        change.add(cross(corner.point - w, next.point - w), weight);
        centre += change;
        change.add(corner.old_normal, -weight);
        largest2 = std::max(largest2, squared_norm(corner.old_normal));
        kept_current(corner.vertex) += change;
        kept_current(next.vertex) += change;
    }
    for (const Star::Corner& corner : star.ring)
        if (mesh_.is_boundary(corner.vertex) || !(kept_current(corner.vertex).trace() > cancelled * largest2))
            refresh(corner.vertex);
}

Quadric VertexWeights::of_edge(VertexId u, VertexId v, const Vec3& to_v) const {
    if (tuning_.paper) {
        Quadric q = history(v).moved_to(-to_v);
        q += history(u);
        return q;
    }
    const Planes at_u = current(u);  // a copy: the next call may take its place
    const Planes& at_v = current(v);
    Quadric q;
    q.xx = at_v.xx, q.xy = at_v.xy, q.xz = at_v.xz, q.yy = at_v.yy, q.yz = at_v.yz, q.zz = at_v.zz;
    q.b = -q.apply(to_v);
    q.c = -dot(to_v, q.b);
    q.xx += at_u.xx, q.xy += at_u.xy, q.xz += at_u.xz, q.yy += at_u.yy, q.yz += at_u.yz, q.zz += at_u.zz;
    return q;
}

Quadric VertexWeights::planes_at(VertexId v) const {
    const Frame frame{scale_, 1 / scale_, mesh_.point(v)};
    Quadric q;
    PlaneAdder adder(tuning_, q);
    each_outgoing(mesh_, v, [&](HalfedgeId h) {
        const Vec3 a = frame.to_local(mesh_.point(mesh_.target(h)));
        const Vec3 b = frame.to_local(mesh_.point(mesh_.apex(h)));
        const Vec3 n = cross(a, b);
        adder.add_face(n);
        if (mesh_.is_boundary(Mesh::prev(h))) adder.add_upright(b, n, tuning_.boundary);
        const HalfedgeId t = mesh_.twin(h);
        if (!t.valid()) return adder.add_upright(a, n, tuning_.boundary);
        if (tuning_.crease_cosine <= -1) return;
        const Vec3 m = cross(frame.to_local(mesh_.point(mesh_.apex(t))), a);
        if (dot(n, m) >= tuning_.crease_cosine * std::sqrt(squared_norm(n) * squared_norm(m))) return;
        adder.add_upright(a, n, tuning_.boundary);
        adder.add_upright(a, m, tuning_.boundary);
    });
    return q;
}

}  // namespace delmesh
