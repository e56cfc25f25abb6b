#include "measure/face_tree.hpp"

#include "base/parallel.hpp"

#include <tbb/parallel_invoke.h>

#include <array>
#include <bit>

namespace delmesh::measure {

namespace {

int longest_axis(const Box& box) {
    const Vec3 size = box.high - box.low;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

}  // namespace

/// Puts the faces into the order of the tree.
class FaceTree::Builder {
public:
    struct Item {
        Vec3 centre;  ///< three times the centroid
        std::uint32_t face;
    };

    Builder(std::span<Item> items, bool parallel) : items_(items), parallel_(parallel) {}

    void order() {
        std::size_t capacity = width;
        while (capacity < items_.size()) capacity *= width;
        order_node(0, items_.size(), capacity);
    }

private:
    static constexpr std::size_t parallel_from = 1 << 14;

    /// A node for up to `capacity` triangles.
    void order_node(std::size_t begin, std::size_t end, std::size_t capacity) {
        if (capacity > width) return split(begin, end, capacity / width);
        // nth_element leaves an order that differs between standard libraries.
        std::sort(items_.begin() + begin, items_.begin() + end,
                  [](const Item& s, const Item& t) { return s.face < t.face; });
    }

    /// Halves until the parts fit into a child; all but the last are full.
    void split(std::size_t begin, std::size_t end, std::size_t child_capacity) {
        const std::size_t children = (end - begin + child_capacity - 1) / child_capacity;
        if (children <= 1) return order_node(begin, end, child_capacity);
        const std::size_t middle = begin + (children + 1) / 2 * child_capacity;
        partition(begin, middle, end);
        const auto left = [&] { split(begin, middle, child_capacity); };
        const auto right = [&] { split(middle, end, child_capacity); };
        if (parallel_ && end - begin >= parallel_from) {
            tbb::parallel_invoke(left, right);
        } else {
            left();
            right();
        }
    }

    void partition(std::size_t begin, std::size_t middle, std::size_t end) {
        Box box;
        for (std::size_t i = begin; i < end; ++i) box.add(items_[i].centre);
        const auto order = [&](double Vec3::*coordinate) {
            std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                             [coordinate](const Item& s, const Item& t) {
                                 const double a = s.centre.*coordinate, b = t.centre.*coordinate;
                                 return a < b || (a == b && s.face < t.face);
                             });
        };
        constexpr std::array<double Vec3::*, 3> coordinates{&Vec3::x, &Vec3::y, &Vec3::z};
        order(coordinates[longest_axis(box)]);
    }

    std::span<Item> items_;
    bool parallel_;
};

FaceTree::FaceTree(std::span<const Vec3> points, std::span<const std::uint32_t> corners, const Context* context) {
    const std::size_t count = corners.size() / 3;
    const auto corner = [&](std::size_t face, std::size_t i) -> const Vec3& { return points[corners[3 * face + i]]; };
    std::vector<Builder::Item> items(count);
    parallel_blocks(count, context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f)
            items[f] = {corner(f, 0) + corner(f, 1) + corner(f, 2), static_cast<std::uint32_t>(f)};
    });
    run_in_arena(context, [&] { Builder(items, thread_count(context) != 1).order(); });
    triangles_.resize(count);
    faces_.resize(count);
    parallel_blocks(count, context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t f = faces_[i] = items[i].face;
            triangles_[i] = longest_first(corner(f, 0), corner(f, 1), corner(f, 2));
        }
    });
    make_nodes(context);
}

void FaceTree::make_nodes(const Context* context) {
    std::vector<Box> boxes(triangles_.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (const Vec3& p : {triangles_[i].a, triangles_[i].b, triangles_[i].c}) boxes[i].add(p);
    do {
        std::vector<Node> nodes((boxes.size() + width - 1) / width);
        std::vector<Box> parents(nodes.size());
        const auto fill = [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n) {
                const std::size_t first = n * width, last = std::min(first + width, boxes.size());
                for (std::size_t i = first; i < last; ++i) parents[n].add(boxes[i]);
                nodes[n].origin = 0.5 * (parents[n].low + parents[n].high);
                const Vec3 size = parents[n].high - parents[n].low;
                nodes[n].radius = static_cast<float>(std::max(size.x, std::max(size.y, size.z)) * 0.5);
                for (std::size_t lane = 0; lane < width; ++lane)
                    set_child(nodes[n], lane, first + lane < last ? boxes[first + lane] : Box());
            }
        };
        parallel_blocks(nodes.size(), context, fill, 2048);
        levels_.push_back(std::move(nodes));
        boxes = std::move(parents);
    } while (boxes.size() > 1);
}

void FaceTree::set_child(Node& node, std::size_t lane, const Box& box) const {
    constexpr double outward = 0x1p-22;  // more than the rounding to float
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        node.boxes.low[axis][lane] = infinity;
        node.boxes.high[axis][lane] = -infinity;
        if (box.low[axis] > box.high[axis]) continue;
        const double low = box.low[axis] - node.origin[axis];
        const double high = box.high[axis] - node.origin[axis];
        node.boxes.low[axis][lane] = static_cast<float>(low - outward * std::fabs(low));
        node.boxes.high[axis][lane] = static_cast<float>(high + outward * std::fabs(high));
    }
}

inline void FaceTree::find_near_children(const Node& node, const Vec3& p, float limit, BoxDistances& result) {
    const Vec3 offset = p - node.origin;
    const std::array<float, 3> r{static_cast<float>(offset.x), static_cast<float>(offset.y),
                                 static_cast<float>(offset.z)};
    const float farthest = std::max(std::fabs(r[0]), std::max(std::fabs(r[1]), std::fabs(r[2])));
    // Covers the rounding of r, of the sums with it, and that of distances to triangles.
    find_near(node.boxes, r, 0x1p-22F * (farthest + node.radius), limit, result);
}

namespace {

/// A box with a greater squared distance holds nothing nearer. Covers the rounding of squares and their sum.
float search_limit(double distance2) {
    return std::max(static_cast<float>(distance2 * (1 + 0x1p-20)), std::numeric_limits<float>::min());
}

struct Entry {
    float distance2;
    std::uint32_t level;
    std::size_t node;
};

}  // namespace

template <class Value>
FaceTree::Nearest FaceTree::search(const Vec3& p, std::uint32_t hint, const Value& value) const {
    Nearest best{value(triangles_[hint]), hint};
    float limit = search_limit(best.distance2);
    std::array<Entry, 12 * width> stack;  // NOLINT: at most 11 levels, each adds 7
    std::size_t size = 0;
    stack[size++] = {0, static_cast<std::uint32_t>(levels_.size() - 1), 0};
    BoxDistances boxes;
    while (size > 0) {
        const Entry top = stack[--size];
        if (top.distance2 > limit) continue;
        find_near_children(levels_[top.level][top.node], p, limit, boxes);
        const std::size_t first = top.node * width, begin = size;
        for (unsigned near = boxes.near; near != 0; near &= near - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(near));
            if (top.level > 0) {  // the nearest on top
                std::size_t at = size++;
                for (; at > begin && stack[at - 1].distance2 < boxes.squared[i]; --at) stack[at] = stack[at - 1];
                stack[at] = {boxes.squared[i], top.level - 1, first + i};
            } else if (boxes.squared[i] <= limit) {
                const auto t = static_cast<std::uint32_t>(first + i);
                const double d2 = value(triangles_[t]);
                if (d2 > best.distance2 || (d2 == best.distance2 && t >= best.triangle)) continue;
                best = {d2, t};
                limit = search_limit(d2);
            }
        }
    }
    return best;
}

FaceTree::Nearest FaceTree::nearest(const Vec3& p, std::uint32_t hint) const {
    return search(p, hint, [&p](const Triangle& t) { return squared_distance(p, t); });
}

double FaceTree::lower_distance(const Vec3& p, std::uint32_t hint) const {
    const auto squared_lower = [&p](const Triangle& t) {
        const double d = measure::lower_distance(p, t);
        return d * d;
    };
    return std::sqrt(search(p, hint, squared_lower).distance2);
}

}  // namespace delmesh::measure
