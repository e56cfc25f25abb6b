#include "measure/surface.hpp"

#include "base/box.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh::measure {
namespace {

Vec3 times_power_of_two(const Vec3& p, int exponent) {
    return {std::scalbn(p.x, exponent), std::scalbn(p.y, exponent), std::scalbn(p.z, exponent)};
}

void add(Box& box, const TriangleView& view) {
    for (const std::uint32_t v : view.corners) box.add(view.points[v]);
}

double largest(const Vec3& p) {
    return std::max(std::fabs(p.x), std::max(std::fabs(p.y), std::fabs(p.z)));
}

std::vector<Vec3> local_points(const TriangleView& view, const Frame& frame, const Context* context) {
    std::vector<Vec3> points(view.points.size());
    parallel_blocks(points.size(), context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) points[i] = frame.to_local(view.points[i]);
    });
    return points;
}

}  // namespace

Frame::Frame(const TriangleView& a, const TriangleView& b) {
    Box range;
    add(range, a);
    const Box range_a = range;
    add(range, b);
    if (std::max(largest(range.low), largest(range.high)) > 0x1p1000) shrink_ = -30;
    const auto shrunk = [this](const Vec3& p) { return times_power_of_two(p, shrink_); };
    const Vec3 size = shrunk(range.high) - shrunk(range.low);
    centre_ = shrunk(range.low) + 0.5 * size;
    if (largest(size) > 0) scale_ = -std::ilogb(largest(size));
    diagonal_ = norm(times_power_of_two(shrunk(range_a.high) - shrunk(range_a.low), scale_));
}

Vec3 Frame::to_local(const Vec3& p) const {
    const Vec3 shrunk = shrink_ == 0 ? p : times_power_of_two(p, shrink_);
    return times_power_of_two(shrunk - centre_, scale_);
}

Vec3 Frame::to_world(const Vec3& p) const {
    return times_power_of_two(times_power_of_two(p, -scale_) + centre_, -shrink_);
}

double Frame::distance_to_world(double distance) const {
    return std::scalbn(distance, -scale_ - shrink_);
}

Surface::Surface(const TriangleView& view, const Frame& frame, const Context* context)
    : Surface(view.corners, local_points(view, frame, context), context) {}

Surface::Surface(std::span<const std::uint32_t> corners, const std::vector<Vec3>& points, const Context* context)
    : tree(points, corners, context) {
    std::vector<bool> seen(points.size());
    for (const std::uint32_t face : tree.faces()) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t v = corners[3 * static_cast<std::size_t>(face) + i];
            if (seen[v]) continue;
            seen[v] = true;
            vertices.push_back(points[v]);
        }
    }
}

}  // namespace delmesh::measure
