#include "repair/triangle_tree.hpp"

#include "delmesh/exact/predicates.hpp"
#include "repair/direction.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh::repairing {
namespace {

/// The sign of det(b - a, c - a) after projection along x.
Sign projected_orientation(const Vec3& a, const Vec3& b, const Vec3& c) {
    return orientation({0, a.y, a.z}, {0, b.y, b.z}, {0, c.y, c.z}, {1, a.y, a.z});
}

/// Seen along x: does a ray from p towards larger y cross the edge ab? Half-open in z, the same for ab and ba.
bool crosses(const Vec3& p, const Vec3& a, const Vec3& b) {
    if ((a.z <= p.z) == (b.z <= p.z)) return false;
    const Vec3& low = a.z <= p.z ? a : b;
    const Vec3& high = a.z <= p.z ? b : a;
    return projected_orientation(low, high, p) == Sign::positive;
}

/// How far from p the ray meets the triangle, in doubles: this only has to tell faces apart.
double distance_along_ray(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    std::array<Vec3, 3> d{difference(p, a), difference(p, b), difference(p, c)};
    const double largest =
        std::fmax(largest_component(d[0]), std::fmax(largest_component(d[1]), largest_component(d[2])));
    const int exponent = largest > 0 ? std::ilogb(largest) : 0;
    for (Vec3& v : d)
        for (int axis = 0; axis < 3; ++axis) v[axis] = std::scalbn(v[axis], -exponent);
    double weights = 0;
    double sum = 0;
    double farthest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& e = d[(i + 1) % 3];
        const Vec3& g = d[(i + 2) % 3];
        const double weight = e.y * g.z - e.z * g.y;
        weights += weight;
        sum += weight * d[i].x;
        farthest = std::fmax(farthest, d[i].x);
    }
    const double distance = weights != 0 ? sum / weights : farthest;
    return std::scalbn(std::fmax(0, std::fmin(distance, farthest)), exponent);
}

}  // namespace

TriangleTree::TriangleTree(const Complex& complex, std::vector<Index> faces)
    : complex_(complex),
      faces_(std::move(faces)) {
    nodes_.reserve(faces_.size());
    if (!faces_.empty()) build(0, faces_.size());
}

/// Halves along the longest side of the box, by the faces' smallest corners.
Index TriangleTree::build(std::size_t first, std::size_t last) {
    constexpr std::size_t leaf_size = 4;
    const auto self = static_cast<Index>(nodes_.size());
    Node node;
    for (std::size_t i = first; i < last; ++i)
        for (Index j = 0; j < 3; ++j)
            for (int axis = 0; axis < 3; ++axis) {
                node.low[axis] = std::fmin(node.low[axis], corner(faces_[i], j)[axis]);
                node.high[axis] = std::fmax(node.high[axis], corner(faces_[i], j)[axis]);
            }
    node.first = static_cast<Index>(first);
    if (last - first <= leaf_size) node.count = static_cast<Index>(last - first);
    nodes_.push_back(node);
    if (node.count > 0) return self;

    int longest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (node.high[axis] / 2 - node.low[axis] / 2 > node.high[longest] / 2 - node.low[longest] / 2) longest = axis;
    const auto smallest = [&](Index f) {
        return std::fmin(corner(f, 0)[longest], std::fmin(corner(f, 1)[longest], corner(f, 2)[longest]));
    };
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return faces_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](Index f, Index g) {
        const double a = smallest(f);
        const double b = smallest(g);
        return a != b ? a < b : f < g;
    });
    build(first, middle);
    const Index right = build(middle, last);
    nodes_[self].right = right;
    return self;
}

/// Takes face f for the first hit if it is one and nearer than those so far.
void TriangleTree::meet(const Vec3& p, Index f, double& nearest, Hit& hit) const {
    const Vec3& a = corner(f, 0);
    const Vec3& b = corner(f, 1);
    const Vec3& c = corner(f, 2);
    if (crosses(p, a, b) != (crosses(p, b, c) != crosses(p, c, a))) {
        const Sign facing = projected_orientation(a, b, c);
        const Sign side = orientation(a, b, c, p);
        if (facing == Sign::zero || side * facing != Sign::negative) return;
        const double distance = distance_along_ray(p, a, b, c);
        if (distance < nearest || (distance == nearest && f < hit.face)) {
            nearest = distance;
            hit = {f, facing == Sign::positive};
        }
    }
}

}  // namespace delmesh::repairing
