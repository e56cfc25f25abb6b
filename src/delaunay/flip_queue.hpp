#pragma once
// The order in which edges that are not Delaunay are worked off.

#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <cstdint>
#include <vector>

namespace delmesh {

/// How far the edge of h is from Delaunay, as a number that grows with the sum of its opposite angles (at the boundary:
/// with twice the opposite angle). Only for edges that are not Delaunay. Computed in doubles with square roots alone,
/// so that it is the same everywhere; two edges within 1e-9 or so of each other may get the same number.
[[nodiscard]] std::uint32_t urgency(const Mesh& mesh, HalfedgeId h);

/// Edges in the order asked for. An entry may be out of date when it is popped: its edge may have changed since, and
/// then the edge has been pushed again.
class FlipQueue {
public:
    struct Entry {
        HalfedgeId h;
        std::uint32_t urgency;
    };

    explicit FlipQueue(FlipOrder order) : order_(order) {}

    /// Adds many at once; cheaper than pushing them.
    void fill(const std::vector<Entry>& entries);
    void push(Entry entry);
    [[nodiscard]] bool empty() const { return first_ == items_.size(); }
    [[nodiscard]] std::size_t size() const { return items_.size() - first_; }
    Entry pop();
    /// What may be popped in a while: place 0 comes next, those up to 6 soon after. Not valid past the end.
    [[nodiscard]] HalfedgeId upcoming(std::size_t place) const;
    /// Whether the urgency of an entry has to be that of its edge for the entry to count.
    [[nodiscard]] bool uses_urgency() const { return order_ == FlipOrder::worst; }

private:
    FlipOrder order_;
    /// Urgency above, the complement of the id below: the largest comes first, ties by the smaller id.
    std::vector<std::uint64_t> items_;
    std::size_t first_ = 0;
};

}  // namespace delmesh
