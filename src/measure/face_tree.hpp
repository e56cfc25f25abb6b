#pragma once
// A search tree over triangles: which one is nearest to a point?

#include "base/box.hpp"
#include "delmesh/base/context.hpp"
#include "measure/eight_boxes.hpp"
#include "measure/triangle.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delmesh::measure {

/// Triangles in boxes of boxes, eight in each, ordered by repeated median splits along the longest axis.
///
/// Boxes are floats about the centre of their node, rounded outward, so that eight are tested at once and precision
/// follows the size of the node; triangles and distances are doubles. All loops over the tree are conservative: the
/// result is the minimum over *all* triangles of what `squared_distance` computes, so it depends neither on the
/// order of the search nor on the hint. Coordinates must be at most 2 in size. Memory: 72 + 32 + 4 bytes a triangle.
class FaceTree {
public:
    /// Cost: O(n log n). The order of the triangles depends on their coordinates and their order only.
    FaceTree(std::span<const Vec3> points, std::span<const std::uint32_t> corners, const Context* context);

    /// Triangles in the order of the tree: near ones are near each other.
    [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
    /// The face each of them was.
    [[nodiscard]] std::span<const std::uint32_t> faces() const { return faces_; }

    struct Nearest {
        double distance2 = 0;
        std::uint32_t triangle = 0;  ///< in the order of the tree; the first of equals
    };
    /// The nearest triangle; `hint` is one that may be near, as the answer for a point close by. Requires a triangle.
    [[nodiscard]] Nearest nearest(const Vec3& p, std::uint32_t hint) const;

    /// A proved lower bound of the distance from p to the surface, but for the rounding of coordinates.
    [[nodiscard]] double lower_distance(const Vec3& p, std::uint32_t hint) const;

private:
    static constexpr std::size_t width = EightBoxes::count;
    struct Node {
        EightBoxes boxes;  ///< of the children, relative to `origin`
        Vec3 origin;
        float radius;  ///< half the largest extent
    };
    class Builder;

    void make_nodes(const Context* context);
    void set_child(Node& node, std::size_t lane, const Box& box) const;
    static void find_near_children(const Node& node, const Vec3& p, float limit, BoxDistances& result);
    template <class Value>
    Nearest search(const Vec3& p, std::uint32_t hint, const Value& value) const;

    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> faces_;
    /// Level 0 holds triangles, level k+1 nodes of level k: children of node i are 8i ... 8i+7.
    std::vector<std::vector<Node>> levels_;
};

}  // namespace delmesh::measure
