#include "io/point_index.hpp"

#include "base/prefetch.hpp"

#include <algorithm>
#include <bit>
#include <random>

namespace delmesh::io {

namespace {

constexpr std::size_t least_slots = 1024;

/// The bits of a coordinate, those of +0 for -0.
std::uint64_t bits_of(double coordinate) {
    return std::bit_cast<std::uint64_t>(coordinate + 0.0);
}

std::uint64_t mix(std::uint64_t hash, std::uint64_t bits) {
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ hash >> 32) * 0xd6e8feb86659fd93u;
    return hash ^ hash >> 32;
}

std::uint64_t fresh_seed() {
    std::random_device device;
    return std::uint64_t{device()} << 32 | device();
}

bool same(const Vec3& a, const Vec3& b) {
    return bits_of(a.x) == bits_of(b.x) && bits_of(a.y) == bits_of(b.y) && bits_of(a.z) == bits_of(b.z);
}

}  // namespace

PointIndex::PointIndex(std::vector<Vec3>& points, std::size_t expected)
    : points_(points),
      slots_(std::bit_ceil(std::max(2 * expected, least_slots)), empty),
      shift_(64 - std::countr_zero(slots_.size())),
      seed_(fresh_seed()) {
    points_.reserve(expected);
}

std::uint64_t PointIndex::hash_of(const Vec3& point) const {
    return mix(mix(mix(seed_, bits_of(point.x)), bits_of(point.y)), bits_of(point.z));
}

void PointIndex::add(std::span<const Vec3> points, std::vector<std::uint32_t>& numbers) {
    hashes_.clear();
    for (const Vec3& point : points) {
        hashes_.push_back(hash_of(point));
        prefetch(&slots_[hashes_.back() >> shift_]);
    }
    for (const std::uint64_t hash : hashes_) {
        const std::uint32_t number = slots_[hash >> shift_];
        if (number != empty) prefetch(&points_[number]);
    }
    for (std::size_t i = 0; i < points.size(); ++i) numbers.push_back(add(points[i], hashes_[i]));
}

std::uint32_t PointIndex::add(const Vec3& point, std::uint64_t hash) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash >> shift_;
    for (; slots_[slot] != empty; slot = (slot + 1) & mask) {
        if (same(points_[slots_[slot]], point)) return slots_[slot];
    }
    const auto number = static_cast<std::uint32_t>(points_.size());
    slots_[slot] = number;
    points_.push_back(point);
    if (2 * points_.size() > slots_.size()) grow();
    return number;
}

void PointIndex::grow() {
    std::vector<std::uint32_t>(2 * slots_.size(), empty).swap(slots_);
    --shift_;
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        std::size_t slot = hash_of(points_[i]) >> shift_;
        while (slots_[slot] != empty) slot = (slot + 1) & mask;
        slots_[slot] = static_cast<std::uint32_t>(i);
    }
}

}  // namespace delmesh::io
