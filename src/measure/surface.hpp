#pragma once
// Two surfaces in one frame, ready to be measured against each other.

#include "delmesh/base/context.hpp"
#include "measure/face_tree.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace delmesh::measure {

struct TriangleView {
    std::span<const Vec3> points;
    std::span<const std::uint32_t> corners;  ///< three for each triangle
};

/// Moves and scales space, by a power of two, so that both surfaces lie in the cube from -1 to 1 and fill at least half
/// of it along some axis. Scaling is exact; moving rounds by at most 2^-53 of the cube. Vertices without faces do not
/// count.
class Frame {
public:
    Frame(const TriangleView& a, const TriangleView& b);

    [[nodiscard]] Vec3 to_local(const Vec3& p) const;
    [[nodiscard]] Vec3 to_world(const Vec3& p) const;
    [[nodiscard]] double distance_to_world(double distance) const;
    /// The diagonal of the bounding box of a, in the units of the frame.
    [[nodiscard]] double diagonal() const { return diagonal_; }

private:
    int shrink_ = 0;  ///< the power of two that avoids overflow
    int scale_ = 0;   ///< the power of two that follows
    Vec3 centre_;
    double diagonal_ = 0;
};

/// A surface in its frame.
class Surface {
public:
    Surface(const TriangleView& view, const Frame& frame, const Context* context);

    FaceTree tree;
    std::vector<Vec3> vertices;  ///< those that have faces, in the order in which the tree meets them

private:
    Surface(std::span<const std::uint32_t> corners, const std::vector<Vec3>& points, const Context* context);
};

}  // namespace delmesh::measure
