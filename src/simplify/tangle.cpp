#include "simplify/tangle.hpp"

#include "simplify/walk.hpp"

namespace delmesh {

std::vector<VertexId> find_tangles(const Mesh& mesh) {
    std::vector<VertexId> third(mesh.halfedge_count());
    std::vector<VertexId> joined_to(mesh.vertex_count());
    const auto find = [&](VertexId u, HalfedgeId h) {
        const HalfedgeId t = mesh.twin(h);
        const VertexId left = mesh.apex(h);
        const VertexId right = t.valid() ? mesh.apex(t) : left;
        const auto is_third = [&](VertexId x) { return joined_to[x.index()] == u && x != left && x != right; };
        const HalfedgeId start = mesh.halfedge(mesh.target(h));
        for (HalfedgeId at = start; at.valid();) {
            if (is_third(mesh.target(at))) return mesh.target(at);
            if (is_third(mesh.apex(at))) return mesh.apex(at);
            at = mesh.next_around(at);
            if (at == start) break;
        }
        return VertexId();
    };
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const VertexId u(i);
        each_outgoing(mesh, u,
                      [&](HalfedgeId h) { joined_to[mesh.target(h).index()] = joined_to[mesh.apex(h).index()] = u; });
        each_outgoing(mesh, u, [&](HalfedgeId h) {
            if (mesh.names_edge(h)) third[h.index()] = find(u, h);
        });
    }
    return third;
}

}  // namespace delmesh
