#include "simplify/weights.hpp"

#include "simplify/frame.hpp"
#include "simplify/numbering.hpp"
#include "simplify/walk.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

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

VertexWeights::VertexWeights(const Mesh& mesh, double scale, const Tuning& tuning)
    : mesh_(mesh),
      scale_(scale),
      tuning_(tuning),
      history_at_(mesh.vertex_count(), none),
      rest_at_(mesh.vertex_count(), none),
      current_(mesh.vertex_count()) {
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const Quadric q = planes_at(VertexId(i));
        current_[i] = {q.xx, q.xy, q.xz, q.yy, q.yz, q.zz};
    }
}

Quadric VertexWeights::history(VertexId v) const {
    const std::uint32_t own = history_at_[v.index()];
    const Planes& planes = own == none ? current_[v.index()] : history_[own];
    Quadric q;
    q.xx = planes.xx, q.xy = planes.xy, q.xz = planes.xz, q.yy = planes.yy, q.yz = planes.yz, q.zz = planes.zz;
    if (const std::uint32_t at = rest_at_[v.index()]; at != none) q.b = rest_[at].b, q.c = rest_[at].c;
    return q;
}

namespace {

template <class Item>
std::uint32_t take_room(std::deque<Item>& items, std::vector<std::uint32_t>& free) {
    if (free.empty()) {
        items.emplace_back();
        return static_cast<std::uint32_t>(items.size() - 1);
    }
    const std::uint32_t at = free.back();
    free.pop_back();
    return at;
}

}  // namespace

VertexWeights::Planes& VertexWeights::own_history(VertexId v) {
    std::uint32_t& at = history_at_[v.index()];
    if (at == none) at = take_room(history_, history_free_);
    return history_[at];
}

VertexWeights::Planes& VertexWeights::changing(VertexId v) {
    Planes& current = current_[v.index()];
    if (history_at_[v.index()] == none) own_history(v) = current;
    return current;
}

void VertexWeights::set_history(VertexId v, const Quadric& merged) {
    own_history(v) = {merged.xx, merged.xy, merged.xz, merged.yy, merged.yz, merged.zz};
    std::uint32_t& at = rest_at_[v.index()];
    if (at == none) at = take_room(rest_, rest_free_);
    rest_[at] = {merged.b, merged.c};
}

void VertexWeights::forget_history(VertexId v) {
    const auto give_back = [v](std::vector<std::uint32_t>& at, std::vector<std::uint32_t>& free) {
        if (at[v.index()] != none) free.push_back(at[v.index()]);
        at[v.index()] = none;
    };
    give_back(history_at_, history_free_);
    give_back(rest_at_, rest_free_);
}

Quadric VertexWeights::merged_history(const Star& star, const Vec3& w) const {
    Quadric merged = history(star.u).moved_to(w);
    merged += history(star.v).moved_to(w - star.v_point);
    return merged;
}

void VertexWeights::renumber(const std::vector<VertexId>& ids) {
    std::vector<std::uint32_t> history_at(mesh_.vertex_count(), none);
    std::vector<std::uint32_t> rest_at(mesh_.vertex_count(), none);
    std::vector<Planes> current(mesh_.vertex_count());
    for (std::size_t v = 0; v < ids.size(); ++v) {
        if (!ids[v].valid()) continue;
        history_at[ids[v].index()] = history_at_[v];
        rest_at[ids[v].index()] = rest_at_[v];
        current[ids[v].index()] = current_[v];
    }
    history_at_.swap(history_at);
    rest_at_.swap(rest_at);
    current_.swap(current);
}

void VertexWeights::close_gaps(const std::vector<VertexId>& ids) {
    move_down(history_at_, ids);
    move_down(rest_at_, ids);
    move_down(current_, ids);
}

void VertexWeights::resize() {
    history_at_.resize(mesh_.vertex_count(), none);
    rest_at_.resize(mesh_.vertex_count(), none);
    current_.resize(mesh_.vertex_count());
}

void VertexWeights::refresh(VertexId v) {
    if (tuning_.paper) return;
    const Quadric q = planes_at(v);
    changing(v) = {q.xx, q.xy, q.xz, q.yy, q.yz, q.zz};
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
    Planes& centre = changing(star.u);
    centre = {};
    changing(left).add(star.dying[0], -weight);
    if (right.valid()) changing(right).add(star.dying[1], -weight);
    for (std::size_t i = 0; i < star.ring.size(); ++i) {
        const Star::Corner& corner = star.ring[i];
        const Star::Corner& next = star.ring[star.after(i)];
        Planes change;
        change.add(cross(corner.point - w, next.point - w), weight);
        centre += change;
        change.add(corner.old_normal, -weight);
        largest2 = std::max(largest2, squared_norm(corner.old_normal));
        changing(corner.vertex) += change;
        changing(next.vertex) += change;
    }
    for (const Star::Corner& corner : star.ring)
        if (mesh_.is_boundary(corner.vertex) || !(current_[corner.vertex.index()].trace() > cancelled * largest2))
            refresh(corner.vertex);
}

Quadric VertexWeights::of_edge(VertexId u, VertexId v, const Vec3& to_v) const {
    if (tuning_.paper) {
        Quadric q = history(v).moved_to(-to_v);
        q += history(u);
        return q;
    }
    const Planes& at_u = current_[u.index()];
    const Planes& at_v = current_[v.index()];
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
