#include "delaunay/hub_index.hpp"

#include "mesh/fan_search.hpp"

namespace delmesh {

HubIndex::Neighbours* HubIndex::find(VertexId v) {
    const auto it = neighbours_.find(v.value());
    return it == neighbours_.end() ? nullptr : &it->second;
}

bool HubIndex::are_joined(const Mesh& mesh, VertexId a, VertexId b) {
    if (!neighbours_.empty()) {
        if (const Neighbours* known = find(a)) return known->contains(b.value());
        if (const Neighbours* known = find(b)) return known->contains(a.value());
    }
    if (const std::optional<bool> joined = are_joined_within(mesh, a, b, least_valence)) return *joined;
    Neighbours& made = neighbours_[a.value()];
    const HalfedgeId start = mesh.halfedge(a);
    HalfedgeId h = start;
    do {
        made.insert(mesh.target(h).value());
        made.insert(mesh.apex(h).value());
        h = mesh.next_around(h);
    } while (h.valid() && h != start);
    return made.contains(b.value());
}

void HubIndex::join(VertexId a, VertexId b) {
    if (neighbours_.empty()) return;
    if (Neighbours* known = find(a)) known->insert(b.value());
    if (Neighbours* known = find(b)) known->insert(a.value());
}

void HubIndex::part(VertexId a, VertexId b) {
    if (neighbours_.empty()) return;
    if (Neighbours* known = find(a)) known->erase(b.value());
    if (Neighbours* known = find(b)) known->erase(a.value());
}

}  // namespace delmesh
