#pragma once
// A heap of edges by key in which each edge has at most one entry, which can be moved and removed.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace delmesh {

class Queue {
public:
    struct Entry {
        double key = 0;
        std::uint32_t edge = 0;

        /// A total order, so that results do not depend on the shape of the heap.
        friend bool operator<(const Entry& a, const Entry& b) {
            return a.key < b.key || (a.key == b.key && a.edge < b.edge);
        }
    };

    /// For edges that are named by half-edges, as many as there are.
    void reset(std::size_t edges) {
        heap_.clear();
        heap_.reserve(edges / 2);  // most edges have two half-edges
        place_.assign(edges, nowhere);
    }
    [[nodiscard]] bool empty() const { return heap_.empty(); }
    [[nodiscard]] std::size_t size() const { return heap_.size(); }
    [[nodiscard]] const Entry& top() const { return heap_.front(); }
    [[nodiscard]] bool contains(std::uint32_t edge) const { return place_[edge] != nowhere; }

    /// Adds without order; call `heapify` before anything else.
    void append(double key, std::uint32_t edge) { heap_.push_back({key, edge}); }
    void heapify() {
        for (std::size_t i = 0; i < heap_.size(); ++i) place_[heap_[i].edge] = static_cast<std::uint32_t>(i);
        for (std::size_t i = heap_.size() / arity + 1; i-- > 0;)
            if (i < heap_.size()) sink(i, heap_[i]);
    }

    /// Inserts the edge or changes its key.
    void set(double key, std::uint32_t edge) {
        const Entry entry{key, edge};
        std::size_t at = place_[edge];
        if (at == nowhere) {
            at = heap_.size();
            heap_.push_back(entry);
            rise(at, entry);
        } else if (entry < heap_[at]) {
            rise(at, entry);
        } else {
            sink(at, entry);
        }
    }
    void remove(std::uint32_t edge) {
        const std::size_t at = place_[edge];
        if (at == nowhere) return;
        place_[edge] = nowhere;
        const Entry last = heap_.back();
        heap_.pop_back();
        if (at == heap_.size()) return;
        if (last < heap_[at])
            rise(at, last);
        else
            sink(at, last);
    }
    Entry pop() {
        const Entry first = heap_.front();
        remove(first.edge);
        return first;
    }

private:
    static constexpr std::size_t arity = 4;
    static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

    void put(std::size_t at, const Entry& entry) {
        heap_[at] = entry;
        place_[entry.edge] = static_cast<std::uint32_t>(at);
    }
    void rise(std::size_t at, const Entry entry) {
        while (at > 0) {
            const std::size_t parent = (at - 1) / arity;
            if (!(entry < heap_[parent])) break;
            put(at, heap_[parent]);
            at = parent;
        }
        put(at, entry);
    }
    void sink(std::size_t at, const Entry entry) {
        const std::size_t size = heap_.size();
        for (;;) {
            const std::size_t first = at * arity + 1;
            if (first >= size) break;
            const std::size_t end = first + arity < size ? first + arity : size;
            std::size_t least = first;
            for (std::size_t i = first + 1; i < end; ++i)
                if (heap_[i] < heap_[least]) least = i;
            if (!(heap_[least] < entry)) break;
            put(at, heap_[least]);
            at = least;
        }
        put(at, entry);
    }

    std::vector<Entry> heap_;
    std::vector<std::uint32_t> place_;
};

}  // namespace delmesh
