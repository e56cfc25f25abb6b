#pragma once
// Which half-edges are at one edge?

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace delmesh {

/// Half-edges in lists, one for each vertex: those of the edges that have it as their lower end. A list is linked
/// through an entry for each half-edge, and what edges are usually grouped for, the half-edge on the other side, can
/// take the place of the links: there is never room for both. `Halfedge` is an id or a number.
template <class Halfedge>
class EdgeGroups {
public:
    /// `low(h)` is the number of the lower end of half-edge h.
    template <class Low>
    EdgeGroups(std::size_t vertices, std::size_t halfedges, Low&& low) : first_(vertices, none),
                                                                         links_(halfedges) {
        // Backwards, so that lists are in ascending order.
        for (auto i = static_cast<std::uint32_t>(halfedges); i-- > 0;)
            links_[i] = std::exchange(first_[low(Halfedge(i))], Halfedge(i));
    }

    /// Calls visitor(half-edges) for each edge, in the order of the lower ends, then of the higher ones, which `high`
    /// tells; half-edges are in ascending order. Leaves out edges whose lower end is not `wanted`.
    template <class High, class Visitor, class Wanted>
    void visit(High&& high, Visitor&& visitor, Wanted&& wanted) const {
        std::vector<std::uint64_t> keys;
        std::vector<Halfedge> halfedges;
        for (std::uint32_t v = 0; v < first_.size(); ++v) {
            if (!wanted(v)) continue;
            keys.clear();
            for (Halfedge h = first_[v]; h != none; h = links_[number(h)])
                keys.push_back(std::uint64_t{high(h)} << 32 | number(h));
            std::sort(keys.begin(), keys.end());
            halfedges.clear();
            for (const std::uint64_t key : keys) halfedges.emplace_back(static_cast<std::uint32_t>(key));
            for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
                while (end < keys.size() && keys[end] >> 32 == keys[begin] >> 32) ++end;
                visitor(std::span<const Halfedge>(&halfedges[begin], end - begin));
            }
        }
    }

    template <class High, class Visitor>
    void visit(High&& high, Visitor&& visitor) const {
        visit(high, visitor, [](std::uint32_t) { return true; });
    }

    /// An entry for each half-edge. In the last visit the visitor may put anything there for the half-edges it is told.
    [[nodiscard]] std::vector<Halfedge>& links() { return links_; }

private:
    static constexpr auto none = Halfedge(~std::uint32_t{0});

    static std::uint32_t number(Halfedge h) {
        if constexpr (std::is_integral_v<Halfedge>)
            return h;
        else
            return h.value();
    }

    std::vector<Halfedge> first_;
    std::vector<Halfedge> links_;
};

}  // namespace delmesh
