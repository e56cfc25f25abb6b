#pragma once
// The order in which edges that are not Delaunay are worked off.

#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace delmesh {

/// How far an edge is from Delaunay, in steps: it grows with the sum of the opposite angles.
using Urgency = std::uint32_t;
inline constexpr Urgency most_urgent = 255;

/// The urgency of the edge of h, from the cosine of the sum of its opposite angles (at the boundary: of twice the
/// opposite angle) in equal steps. Only for edges that are not Delaunay. Computed in doubles with square roots alone,
/// so that it is the same everywhere.
[[nodiscard]] Urgency urgency(const Mesh& mesh, HalfedgeId h);

/// Edges in the order asked for. `worst`: the most urgent first; of equals, the one that came first. An entry may be
/// out of date when it is popped: its edge may have changed since, and then the edge has been pushed again.
class FlipQueue {
public:
    struct Entry {
        HalfedgeId h;
        Urgency urgency;
    };

    explicit FlipQueue(FlipOrder order) : order_(order), lanes_(order == FlipOrder::worst ? most_urgent + 1 : 1) {}

    void push(Entry entry);
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Requires !empty().
    Entry pop();
    /// What may be popped in a while: place 0 comes next, the places after it soon. Invalid where nothing is known.
    [[nodiscard]] HalfedgeId upcoming(std::size_t place) const;
    /// Whether the urgency of an entry has to be that of its edge for the entry to count.
    [[nodiscard]] bool uses_urgency() const { return order_ == FlipOrder::worst; }

private:
    /// The edges of one urgency, in the order in which they came; those before `first` are gone.
    struct Lane {
        std::vector<HalfedgeId> edges;
        std::size_t first = 0;
        [[nodiscard]] bool empty() const { return first == edges.size(); }
    };

    FlipOrder order_;
    std::vector<Lane> lanes_;
    std::size_t top_ = 0;  ///< no lane above has an edge
    std::size_t size_ = 0;
};

}  // namespace delmesh
