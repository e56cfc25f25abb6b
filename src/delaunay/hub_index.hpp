#pragma once
// Who is joined to whom at vertices of very many edges. Between two such vertices a walk round either is long, and
// needles make flips ask again and again: without an index the cost is quadratic.

#include "delmesh/mesh/mesh.hpp"

#include <unordered_map>
#include <unordered_set>

namespace delmesh {

class HubIndex {
public:
    /// Vertices of fewer edges are not worth an index.
    static constexpr std::size_t least_valence = 1024;

    /// True if an edge of the mesh joins a and b. Cost: O(least_valence) at most, but for the first question about a
    /// hub.
    bool are_joined(const Mesh& mesh, VertexId a, VertexId b);

    /// To be told of each edge that comes and goes. Cost: nothing while there is no hub, else O(1).
    void join(VertexId a, VertexId b);
    void part(VertexId a, VertexId b);
    void clear() { neighbours_.clear(); }

private:
    using Neighbours = std::unordered_set<std::uint32_t>;
    [[nodiscard]] Neighbours* find(VertexId v);

    std::unordered_map<std::uint32_t, Neighbours> neighbours_;
};

}  // namespace delmesh
