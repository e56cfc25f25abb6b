#pragma once
// Numbers points in the order of their first appearance; equal points get one number.

#include "delmesh/base/vec3.hpp"

#include <cstdint>
#include <vector>

namespace delmesh::io {

/// Open addressing over 32-bit slots, at most half full: 8 to 16 bytes a point, O(1) each. Points are equal where their
/// coordinates are, -0 and +0 too; NaNs of the same bits are equal, so that many of them do no harm. The hash is
/// seeded anew in each process, so that no file can be made to collide; the numbers do not depend on it.
class PointIndex {
public:
    /// Points are kept in `points`, which must only grow by `add`.
    explicit PointIndex(std::vector<Vec3>& points);
    std::uint32_t add(const Vec3& point);

private:
    [[nodiscard]] std::size_t slot_of(const Vec3& point) const;
    void grow();

    static constexpr std::uint32_t empty = 0xffffffffu;

    std::vector<Vec3>& points_;
    std::vector<std::uint32_t> slots_;
    int shift_;
    std::uint64_t seed_;
};

}  // namespace delmesh::io
