#pragma once
// Numbers points in the order of their first appearance; equal points get one number.

#include "delmesh/base/vec3.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delmesh::io {

/// Open addressing over 32-bit slots, at most half full: 8 to 16 bytes a point, O(1) each. Points are equal where their
/// coordinates are, -0 and +0 too; NaNs of the same bits are equal, so that many of them do no harm. The hash is
/// seeded anew in each process, so that no file can be made to collide; the numbers do not depend on it.
class PointIndex {
public:
    /// Points are kept in `points`, which must only grow by `add`; room is made for `expected` of them.
    explicit PointIndex(std::vector<Vec3>& points, std::size_t expected = 0);
    std::uint32_t add(const Vec3& point) { return add(point, hash_of(point)); }
    /// Appends the numbers of all the points. Faster than one by one where there are many points in all: their memory
    /// is asked for ahead. A few dozen at a time are best.
    void add(std::span<const Vec3> points, std::vector<std::uint32_t>& numbers);

private:
    [[nodiscard]] std::uint64_t hash_of(const Vec3& point) const;
    std::uint32_t add(const Vec3& point, std::uint64_t hash);
    void grow();

    static constexpr std::uint32_t empty = 0xffffffffu;

    std::vector<Vec3>& points_;
    std::vector<std::uint32_t> slots_;
    std::vector<std::uint64_t> hashes_;
    int shift_;
    std::uint64_t seed_;
};

}  // namespace delmesh::io
