#include "simplify/tangle.hpp"

#include "simplify/walk.hpp"

namespace delmesh {
namespace {

/// The first neighbour of v that is asked for, if any.
template <class IsAskedFor>
VertexId find_neighbour(const Mesh& mesh, VertexId v, IsAskedFor&& is_asked_for) {
    const HalfedgeId start = mesh.halfedge(v);
    for (HalfedgeId at = start; at.valid();) {
        if (is_asked_for(mesh.target(at))) return mesh.target(at);
        const HalfedgeId next = mesh.next_around(at);
        if (!next.valid() && is_asked_for(mesh.apex(at))) return mesh.apex(at);
        if (next == start) break;
        at = next;
    }
    return {};
}

}  // namespace

std::vector<VertexId> find_tangles(const Mesh& mesh) {
    std::vector<VertexId> third(mesh.halfedge_count());
    std::vector<VertexId> joined_to(mesh.vertex_count());
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const VertexId u(i);
        each_outgoing(mesh, u,
                      [&](HalfedgeId h) { joined_to[mesh.target(h).index()] = joined_to[mesh.apex(h).index()] = u; });
        each_outgoing(mesh, u, [&](HalfedgeId h) {
            if (!mesh.names_edge(h)) return;
            const HalfedgeId t = mesh.twin(h);
            const VertexId left = mesh.apex(h);
            const VertexId right = t.valid() ? mesh.apex(t) : left;
            third[h.index()] = find_neighbour(
                mesh, mesh.target(h), [&](VertexId x) { return joined_to[x.index()] == u && x != left && x != right; });
        });
    }
    return third;
}

}  // namespace delmesh
