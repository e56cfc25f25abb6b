#pragma once

#include "repair/complex.hpp"

#include <limits>

namespace delmesh::repairing {

/// A tree of boxes over some faces of a complex, for rays towards larger x.
class TriangleTree {
public:
    TriangleTree(const Complex& complex, std::vector<Index> faces);

    struct Hit {
        Index face = none;
        bool leaves = false;  ///< the face's normal points along the ray
    };

    /// The first face that the ray from p meets beyond p, among those that `counts` accepts; of faces met at the same
    /// place, one. Whether a face is met is decided exactly, in the same way for all faces at an edge, so that a ray
    /// through an edge meets as many faces as one next to it.
    template <class Counts>
    [[nodiscard]] Hit shoot(const Vec3& p, Counts&& counts) const {
        Hit hit;
        double nearest = infinity;
        std::vector<Index> stack;
        if (!nodes_.empty()) stack.push_back(0);
        while (!stack.empty()) {
            const Node& node = nodes_[stack.back()];
            stack.pop_back();
            if (node.misses(p) || node.low.x - p.x > nearest) continue;
            if (node.count == 0) {
                stack.push_back(node.right);
                stack.push_back(static_cast<Index>(&node - nodes_.data()) + 1);
                continue;
            }
            for (Index i = node.first; i < node.first + node.count; ++i)
                if (counts(faces_[i])) meet(p, faces_[i], nearest, hit);
        }
        return hit;
    }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    struct Node {
        Vec3 low{infinity, infinity, infinity};
        Vec3 high{-infinity, -infinity, -infinity};
        Index first = 0;
        Index count = 0;  ///< of faces; 0: a node with two children, the left one being the next
        Index right = 0;

        [[nodiscard]] bool misses(const Vec3& p) const {
            return high.x < p.x || p.y < low.y || p.y > high.y || p.z < low.z || p.z > high.z;
        }
    };

    Index build(std::size_t first, std::size_t last);
    [[nodiscard]] const Vec3& corner(Index f, Index i) const { return complex_.point(complex_.corners[3 * f + i]); }
    void meet(const Vec3& p, Index f, double& nearest, Hit& hit) const;

    const Complex& complex_;
    std::vector<Index> faces_;
    std::vector<Node> nodes_;
};

}  // namespace delmesh::repairing
