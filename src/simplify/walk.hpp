#pragma once

#include "delmesh/mesh/mesh.hpp"

namespace delmesh {

/// Visits every half-edge that leaves v, counter-clockwise.
template <class Visit>
void each_outgoing(const Mesh& mesh, VertexId v, Visit&& visit) {
    const HalfedgeId start = mesh.halfedge(v);
    for (HalfedgeId at = start; at.valid();) {
        visit(at);
        at = mesh.next_around(at);
        if (at == start) break;
    }
}

/// Visits one half-edge of every edge at v: the one that names it.
template <class Visit>
void each_edge(const Mesh& mesh, VertexId v, Visit&& visit) {
    each_outgoing(mesh, v, [&](HalfedgeId at) {
        visit(Mesh::halfedge(mesh.edge(at)));
        if (mesh.is_boundary(Mesh::prev(at))) visit(Mesh::prev(at));
    });
}

}  // namespace delmesh
