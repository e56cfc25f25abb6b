#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace delmesh::repairing {

/// Disjoint sets of numbers; the smallest number of a set is its root.
class UnionFind {
public:
    explicit UnionFind(std::size_t size) : parent_(size) {
        for (std::uint32_t i = 0; i < parent_.size(); ++i) parent_[i] = i;
    }

    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a < b)
            parent_[b] = a;
        else
            parent_[a] = b;
    }

private:
    std::vector<std::uint32_t> parent_;
};

/// Faces gathered into sheets; within a sheet it is known which faces would have to be turned round to agree.
class Sheets {
public:
    explicit Sheets(std::size_t faces) : parent_(faces), differs_(faces, 0), size_(faces, 1), differing_(faces, 0) {
        for (std::uint32_t i = 0; i < parent_.size(); ++i) parent_[i] = i;
    }

    /// The root of face f; `differs` tells whether f is oriented differently from it.
    std::uint32_t find(std::uint32_t f, bool& differs) {
        std::uint32_t root = f;
        char sum = 0;
        while (parent_[root] != root) {
            sum ^= differs_[root];
            root = parent_[root];
        }
        differs = sum != 0;
        while (parent_[f] != root && f != root) {
            const std::uint32_t up = parent_[f];
            const char own = differs_[f];
            parent_[f] = root;
            differs_[f] = sum;
            sum ^= own;
            f = up;
        }
        return root;
    }

    /// True if f is to be turned round for its sheet to face as most of its faces do.
    bool turns(std::uint32_t f) {
        bool differs = false;
        const std::uint32_t root = find(f, differs);
        return differs != (2 * std::size_t{differing_[root]} > size_[root]);
    }

    /// Makes one sheet of two, in which f and g agree if exactly one of them (or none) is turned round, as told. No
    /// effect on faces of one sheet.
    void unite(std::uint32_t f, std::uint32_t g, bool differ) {
        bool f_differs = false;
        bool g_differs = false;
        std::uint32_t a = find(f, f_differs);
        std::uint32_t b = find(g, g_differs);
        if (a == b) return;
        if (size_[a] < size_[b] || (size_[a] == size_[b] && b < a)) std::swap(a, b);
        const bool flip = differ != (f_differs != g_differs);
        parent_[b] = a;
        differs_[b] = flip ? 1 : 0;
        differing_[a] += flip ? size_[b] - differing_[b] : differing_[b];
        size_[a] += size_[b];
    }

private:
    std::vector<std::uint32_t> parent_;
    std::vector<char> differs_;
    std::vector<std::uint32_t> size_;
    std::vector<std::uint32_t> differing_;
};

}  // namespace delmesh::repairing
