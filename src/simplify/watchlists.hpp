#pragma once
// For each vertex, a list of what waits for it to change.

#include "delmesh/base/ids.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

namespace delmesh {

template <class Item>
class Watchlists {
public:
    explicit Watchlists(std::size_t vertices) : first_(vertices, none) {}

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
    /// The vertices have got other ids, in the same order; `moved` gives the items theirs, and tells whether they stay.
    template <class Moved>
    void close_gaps(const std::vector<VertexId>& ids, Moved&& moved) {
        for (std::size_t v = 0; v < ids.size(); ++v) {
            std::uint32_t* link = &first_[v];
            while (*link != none) {
                const std::uint32_t node = *link;
                if (ids[v].valid() && moved(nodes_[node].item)) {
                    link = &nodes_[node].next;
                    continue;
                }
                *link = nodes_[node].next;
                nodes_[node].next = free_;
                free_ = node;
            }
            if (ids[v].valid()) first_[ids[v].index()] = first_[v];
        }
        first_.resize(static_cast<std::size_t>(
            std::count_if(ids.begin(), ids.end(), [](const VertexId id) { return id.valid(); })));
        first_.shrink_to_fit();
    }
    /// Empties all lists.
    void clear() {
        std::fill(first_.begin(), first_.end(), none);
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
