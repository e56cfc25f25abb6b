#pragma once
// Looking for a neighbour among the edges of a vertex, a step at a time, so that two vertices can be searched at once.

#include "delmesh/mesh/mesh.hpp"

#include <cstddef>
#include <optional>

namespace delmesh {

/// Walks a fan one half-edge at a time, looking for a neighbour.
class FanSearch {
public:
    FanSearch(const Mesh& mesh, VertexId from, VertexId wanted)
        : mesh_(mesh),
          start_(mesh.halfedge(from)),
          at_(start_),
          wanted_(wanted) {}

    /// One step; true when the search is over.
    bool step() {
        if (!at_.valid()) return true;
        if (mesh_.target(at_) == wanted_) {
            outgoing_ = at_;
            found_ = true;
            return true;
        }
        // The last edge of an open fan has no outgoing half-edge.
        if (mesh_.apex(at_) == wanted_ && mesh_.is_boundary(Mesh::prev(at_))) {
            found_ = true;
            return true;
        }
        at_ = mesh_.next_around(at_);
        if (at_ == start_) at_ = HalfedgeId();
        return false;
    }

    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] HalfedgeId outgoing() const { return outgoing_; }

private:
    const Mesh& mesh_;
    HalfedgeId start_;
    HalfedgeId at_;
    HalfedgeId outgoing_;
    VertexId wanted_;
    bool found_ = false;
};

/// True if an edge joins a and b; nothing if both have more than `most` edges and the first `most` of each do not tell.
inline std::optional<bool> are_joined_within(const Mesh& mesh, VertexId a, VertexId b, std::size_t most) {
    FanSearch from_a(mesh, a, b);
    FanSearch from_b(mesh, b, a);
    for (std::size_t steps = 0; steps < most; ++steps) {
        if (from_a.step()) return from_a.found();
        if (from_b.step()) return from_b.found();
    }
    return {};
}

}  // namespace delmesh
