#include "delmesh/mesh/coincident.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace delmesh {
namespace {

auto place(const Vec3& p) {
    // Adding zero makes +0 of -0.
    return std::tuple(p.x + 0.0, p.y + 0.0, p.z + 0.0);
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> find_coincident(const PolygonSoup& soup) {
    std::vector<std::uint8_t> used(soup.points.size(), 0);
    for (const std::uint32_t v : soup.corners) used[v] = 1;
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < used.size(); ++v)
        if (used[v] != 0) order.push_back(v);
    std::sort(order.begin(), order.end(), [&soup](std::uint32_t a, std::uint32_t b) {
        return std::tuple(place(soup.points[a]), a) < std::tuple(place(soup.points[b]), b);
    });
    std::vector<std::array<std::uint32_t, 2>> pairs;
    std::size_t first = 0;
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (place(soup.points[order[i]]) == place(soup.points[order[first]])) {
            pairs.push_back({order[first], order[i]});
        } else {
            first = i;
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
    return pairs;
}

std::size_t weld_coincident(PolygonSoup& soup) {
    const auto pairs = find_coincident(soup);
    if (pairs.empty()) return 0;
    std::vector<std::uint32_t> kept(soup.points.size());
    std::iota(kept.begin(), kept.end(), 0u);
    for (const auto& [first, other] : pairs) kept[other] = first;
    for (std::uint32_t& v : soup.corners) v = kept[v];
    for (auto& line : soup.lines)
        for (std::uint32_t& v : line) v = kept[v];
    return pairs.size();
}

std::size_t part_coincident(PolygonSoup& soup) {
    std::size_t moved = 0;
    for (auto pairs = find_coincident(soup); !pairs.empty(); pairs = find_coincident(soup)) {
        for (const auto& pair : pairs) {
            // One step along the largest coordinate, whose steps are the longest: the least likely to be lost in later
            // sums. Who lands at a place that is taken moves on in the next round.
            Vec3& p = soup.points[pair[1]];
            int axis = 0;
            for (const int k : {1, 2})
                if (std::fabs(p[k]) > std::fabs(p[axis])) axis = k;
            const auto towards = std::numeric_limits<float>::infinity();
            const float x = std::nextafter(static_cast<float>(p[axis]), towards);
            (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = static_cast<double>(x);
            ++moved;
        }
    }
    return moved;
}

}  // namespace delmesh
