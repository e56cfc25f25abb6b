#pragma once
// For each vertex, a list of what waits for it to change.

#include "delmesh/base/ids.hpp"
#include "simplify/numbering.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

namespace delmesh {

template <class Item>
class Watchlists {
public:
    explicit Watchlists(std::size_t vertices = 0) : first_(vertices, none) {}

    void add(VertexId v, const Item& item) {
        std::uint32_t node = free_;
        if (node == none) {
            node = static_cast<std::uint32_t>(nodes_.size());
            nodes_.emplace_back();
        } else {
            free_ = nodes_[node].next;
        }
        nodes_[node] = {item, first_[v.index()]};
        first_[v.index()] = node;
    }
    /// Empties the list of v into `out`, the latest first.
    void take(VertexId v, std::vector<Item>& out) {
        std::uint32_t node = first_[v.index()];
        first_[v.index()] = none;
        while (node != none) {
            out.push_back(nodes_[node].item);
            const std::uint32_t next = nodes_[node].next;
            nodes_[node].next = free_;
            free_ = node;
            node = next;
        }
    }
    /// The vertices have got other ids, in the same order. Nothing waits for those that are gone.
    void close_gaps(const std::vector<VertexId>& ids) { move_down(first_, ids); }
    /// `moved` gives each item its new name, and tells whether it stays.
    template <class Moved>
    void renumber_items(Moved&& moved) {
        for (std::uint32_t& first : first_) {
            std::uint32_t* link = &first;
            while (*link != none) {
                const std::uint32_t node = *link;
                if (moved(nodes_[node].item)) {
                    link = &nodes_[node].next;
                    continue;
                }
                *link = nodes_[node].next;
                nodes_[node].next = free_;
                free_ = node;
            }
        }
    }
    /// Empty lists for so many vertices.
    void reset(std::size_t vertices) {
        first_.assign(vertices, none);
        nodes_.clear();
        free_ = none;
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    struct Node {
        Item item;
        std::uint32_t next = none;
    };

    std::vector<std::uint32_t> first_;
    std::deque<Node> nodes_;  ///< grows without a copy
    std::uint32_t free_ = none;
};

}  // namespace delmesh
