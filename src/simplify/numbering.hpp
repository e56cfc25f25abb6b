#pragma once
// Elements are renumbered on the way, so that neighbours lie close in memory; what they were called at first is kept.

#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <vector>

namespace delmesh {

/// Moves the items of what lives down to their new places, where the map keeps the order, and gives back the room.
template <class Item, class Id>
void move_down(std::vector<Item>& items, const std::vector<Id>& map) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < map.size(); ++i)
        if (map[i].valid()) items[count++] = items[i];
    items.resize(count);
    items.shrink_to_fit();
}

class Numbering {
public:
    /// As the mesh is, all are called what they are.
    explicit Numbering(const Mesh& mesh);

    /// The name of the vertex that now has the id v; none for none.
    [[nodiscard]] VertexId name(VertexId v) const { return v.valid() ? vertex_[v.index()] : v; }
    /// As many names as the mesh had vertices at first.
    [[nodiscard]] std::size_t vertex_names() const { return vertex_names_; }
    /// The present ids by name; not valid for what is gone.
    [[nodiscard]] std::vector<VertexId> ids() const;

    /// Closes the gaps between the ids, in place: the map keeps the order. Remembers.
    CompactMap close_gaps(Mesh& mesh);
    /// The two halves of that, in this order; they leave it to the caller to `shrink` the mesh.
    std::vector<VertexId> close_vertex_gaps(Mesh& mesh);
    std::vector<FaceId> close_face_gaps(Mesh& mesh);
    /// Renumbers the mesh, and remembers.
    void renumber(Mesh& mesh, const CompactMap& map);
    /// Ids from 0 on for what lives, in the order of the names.
    [[nodiscard]] CompactMap in_order_of_names(const Mesh& mesh) const;

private:
    std::vector<VertexId> vertex_;
    std::vector<FaceId> face_;
    std::size_t vertex_names_;
    std::size_t face_names_;
};

/// Removes isolated vertices.
void drop_isolated(Mesh& mesh);

/// Ids from 0 on for what lives, by place along a curve that fills space: what is close by mostly gets close ids.
/// Source: Morton 1966.
[[nodiscard]] CompactMap in_order_of_place(const Mesh& mesh, double scale);

}  // namespace delmesh
