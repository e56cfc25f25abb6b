#include "delaunay/flip_queue.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

struct Angle {
    double cosine;
    double sine;
};

/// Scaled to about unit length where squares could leave the range of doubles.
Vec3 tamed(const Vec3& a) {
    const double largest = std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
    if (largest > 1e-70 && largest < 1e70) return a;
    if (!(largest > 0)) return a;
    const int exponent = std::ilogb(largest);
    return {std::scalbn(a.x, -exponent), std::scalbn(a.y, -exponent), std::scalbn(a.z, -exponent)};
}

Angle angle_at(const Vec3& apex, const Vec3& p, const Vec3& q) {
    const Vec3 a = tamed(p - apex);
    const Vec3 b = tamed(q - apex);
    const double lengths = std::sqrt(squared_norm(a) * squared_norm(b));
    return {dot(a, b) / lengths, std::sqrt(squared_norm(cross(a, b))) / lengths};
}

std::uint64_t pack(FlipQueue::Entry entry) {
    return (std::uint64_t{entry.urgency} << 32) | (0xffffffffu - entry.h.value());
}

FlipQueue::Entry unpack(std::uint64_t item) {
    return {HalfedgeId(0xffffffffu - static_cast<std::uint32_t>(item)), static_cast<std::uint32_t>(item >> 32)};
}

}  // namespace

std::uint32_t urgency(const Mesh& mesh, HalfedgeId h) {
    const Vec3& p = mesh.point(mesh.origin(h));
    const Vec3& q = mesh.point(mesh.target(h));
    const Angle u = angle_at(mesh.point(mesh.apex(h)), p, q);
    const HalfedgeId t = mesh.twin(h);
    const Angle v = t.valid() ? angle_at(mesh.point(mesh.apex(t)), p, q) : u;
    // The cosine of the sum grows with the sum between pi and 2 pi.
    const double cosine = std::clamp(u.cosine * v.cosine - u.sine * v.sine, -1.0, 1.0);
    return static_cast<std::uint32_t>((cosine + 1) * 0x1p31 * (1 - 0x1p-30));
}

HalfedgeId FlipQueue::upcoming(std::size_t place) const {
    if (place >= size()) return {};
    return unpack(items_[order_ == FlipOrder::lifo ? items_.size() - 1 - place : first_ + place]).h;
}

void FlipQueue::fill(const std::vector<Entry>& entries) {
    items_.reserve(items_.size() + entries.size() + entries.size() / 2);
    for (const Entry& entry : entries) items_.push_back(pack(entry));
    if (order_ == FlipOrder::worst) std::make_heap(items_.begin(), items_.end());
}

void FlipQueue::push(Entry entry) {
    items_.push_back(pack(entry));
    if (order_ == FlipOrder::worst) std::push_heap(items_.begin(), items_.end());
}

FlipQueue::Entry FlipQueue::pop() {
    if (order_ == FlipOrder::fifo) {
        const Entry entry = unpack(items_[first_++]);
        if (first_ > 4096 && first_ > items_.size() / 2) {
            items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(first_));
            first_ = 0;
        }
        return entry;
    }
    if (order_ == FlipOrder::worst) std::pop_heap(items_.begin(), items_.end());
    const Entry entry = unpack(items_.back());
    items_.pop_back();
    return entry;
}

}  // namespace delmesh
