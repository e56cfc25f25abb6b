#include "delaunay/flip_queue.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

/// Scaled to about unit length.
Vec3 tamed(const Vec3& a) {
    const double largest = std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
    if (!(largest > 0)) return a;
    const int exponent = std::ilogb(largest);
    return {std::scalbn(a.x, -exponent), std::scalbn(a.y, -exponent), std::scalbn(a.z, -exponent)};
}

/// Twice the two sides of an angle.
struct Corner {
    Vec3 a;
    Vec3 b;
    [[nodiscard]] double squared_lengths() const { return squared_norm(a) * squared_norm(b); }
};

/// The cosine of the sum of two angles, and the scale that it is multiplied with, squared.
struct ScaledCosine {
    double value;
    double squared_scale;
};

ScaledCosine cosine_of_sum(const Corner& u, const Corner& v) {
    const double lengths_u = u.squared_lengths();
    const double lengths_v = v.squared_lengths();
    const double dot_u = dot(u.a, u.b);
    const double dot_v = dot(v.a, v.b);
    // |a x b|^2 = |a|^2 |b|^2 - (a.b)^2 (Lagrange)
    const double crosses = (lengths_u - dot_u * dot_u) * (lengths_v - dot_v * dot_v);
    return {dot_u * dot_v - std::sqrt(std::max(crosses, 0.0)), lengths_u * lengths_v};
}

}  // namespace

Urgency urgency(const Mesh& mesh, HalfedgeId h) {
    const Vec3& p = mesh.point(mesh.origin(h));
    const Vec3& q = mesh.point(mesh.target(h));
    const HalfedgeId t = mesh.twin(h);
    const Vec3& apex_u = mesh.point(mesh.apex(h));
    const Vec3& apex_v = t.valid() ? mesh.point(mesh.apex(t)) : apex_u;
    const Corner u{p - apex_u, q - apex_u};
    const Corner v{p - apex_v, q - apex_v};
    ScaledCosine cosine = cosine_of_sum(u, v);
    if (!(cosine.squared_scale > 1e-200 && cosine.squared_scale < 1e200))
        cosine = cosine_of_sum({tamed(u.a), tamed(u.b)}, {tamed(v.a), tamed(v.b)});
    // It grows with the sum between pi and 2 pi.
    const double cosine_itself = cosine.value / std::sqrt(cosine.squared_scale);
    // Sides that under- or overflow give no number; such an edge waits longest.
    if (!(cosine_itself > -1)) return 0;
    return static_cast<Urgency>((std::min(cosine_itself, 1.0) + 1) / 2 * most_urgent);
}

HalfedgeId FlipQueue::upcoming(std::size_t place) const {
    const Lane& lane = lanes_[top_];
    if (place >= lane.edges.size() - lane.first) return {};
    return lane.edges[order_ == FlipOrder::lifo ? lane.edges.size() - 1 - place : lane.first + place];
}

void FlipQueue::push(Entry entry) {
    const std::size_t place = uses_urgency() ? entry.urgency : 0;
    lanes_[place].edges.push_back(entry.h);
    top_ = std::max(top_, place);
    ++size_;
}

FlipQueue::Entry FlipQueue::pop() {
    while (lanes_[top_].empty()) --top_;
    Lane& lane = lanes_[top_];
    --size_;
    Entry entry{lane.edges.back(), static_cast<Urgency>(top_)};
    if (order_ == FlipOrder::lifo) {
        lane.edges.pop_back();
        return entry;
    }
    entry.h = lane.edges[lane.first++];
    if (lane.empty() || (lane.first > 4096 && lane.first > lane.edges.size() / 2)) {
        lane.edges.erase(lane.edges.begin(), lane.edges.begin() + static_cast<std::ptrdiff_t>(lane.first));
        lane.first = 0;
    }
    return entry;
}

}  // namespace delmesh
