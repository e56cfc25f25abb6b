#pragma once
// Which half-edges are at one edge?

#include <algorithm>
#include <array>
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
        Keys keys;
        std::vector<Halfedge> halfedges;
        for (std::size_t v = 0; v < first_.size(); v += at_once) {
            gather(v, high, wanted, keys);
            for (std::vector<std::uint64_t>& list : keys) visit_list(list, halfedges, visitor);
        }
    }
    template <class High, class Visitor>
    void visit(High&& high, Visitor&& visitor) const {
        visit(high, visitor, [](std::uint32_t) { return true; });
    }

    /// An entry for each half-edge; in the last visit, that of a half-edge which is told may be put to any use.
    [[nodiscard]] std::vector<Halfedge>& links() { return links_; }

private:
    static constexpr auto none = Halfedge(~std::uint32_t{0});

    static std::uint32_t number(Halfedge h) {
        if constexpr (std::is_integral_v<Halfedge>)
            return h;
        else
            return h.value();
    }

    /// Lists are followed several at a time, as each step waits for memory where faces are in no order.
    static constexpr std::size_t at_once = 16;
    /// For each list the higher ends and the half-edges.
    using Keys = std::array<std::vector<std::uint64_t>, at_once>;

    template <class High, class Wanted>
    void gather(std::size_t v, High&& high, Wanted&& wanted, Keys& keys) const {
        std::array<Halfedge, at_once> at;
        for (std::size_t i = 0; i < at_once; ++i) {
            keys[i].clear();
            at[i] = v + i < first_.size() && wanted(static_cast<std::uint32_t>(v + i)) ? first_[v + i] : none;
        }
        for (bool any = true; any;) {
            any = false;
            for (std::size_t i = 0; i < at_once; ++i) {
                if (at[i] == none) continue;
                keys[i].push_back(std::uint64_t{high(at[i])} << 32 | number(at[i]));
                at[i] = links_[number(at[i])];
                any = true;
            }
        }
    }

    template <class Visitor>
    static void visit_list(std::vector<std::uint64_t>& keys, std::vector<Halfedge>& halfedges, Visitor&& visitor) {
        std::sort(keys.begin(), keys.end());
        halfedges.clear();
        for (const std::uint64_t key : keys) halfedges.emplace_back(static_cast<std::uint32_t>(key));
        for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
            while (end < keys.size() && keys[end] >> 32 == keys[begin] >> 32) ++end;
            visitor(std::span<const Halfedge>(&halfedges[begin], end - begin));
        }
    }

    std::vector<Halfedge> first_;
    std::vector<Halfedge> links_;
};

}  // namespace delmesh
