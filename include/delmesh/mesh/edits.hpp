#pragma once
// The only ways to change the connectivity of a mesh. Each keeps it an oriented 2-manifold; none looks at positions.

#include "delmesh/mesh/mesh.hpp"

#include <vector>

namespace delmesh {

/// True if the edge of h may be flipped: it has two faces and no edge joins their apexes yet.
/// Cost: O(smaller valence of the two apexes).
[[nodiscard]] bool can_flip(const Mesh& mesh, HalfedgeId h);

/// Replaces the edge pq of h by the edge uv between the apexes u = apex(h) and v = apex(twin(h)).
///
/// Half-edge ids move like this, with t = twin(h): prev(h) becomes u->v and prev(t) becomes v->u; h takes the place of
/// what was prev(t) (v->q), t that of what was prev(h) (u->p); next(h) and next(t) stay. Data kept per half-edge
/// follows that rule. Returns prev(h), the new edge. Requires `can_flip`. Cost: O(1).
HalfedgeId flip(Mesh& mesh, HalfedgeId h);

/// True if `split_edge` is allowed: the two apexes of the edge differ (else the new vertex would be joined to the same
/// vertex twice). O(1).
[[nodiscard]] bool can_split(const Mesh& mesh, HalfedgeId h);

/// Inserts a vertex at `point` on the edge of h = p->q and joins it to the apexes. Returns the new vertex s; its id is
/// the old vertex count. Faces: one new for a boundary edge, else two; the first new face is (s, q, u), the second, on
/// the side of the twin, (q, s, v).
///
/// h becomes p->s, its twin s->p; next(h) becomes s->u, prev(twin(h)) v->s. Of the first new face, the half-edges are
/// s->q, q->u (was next(h)), u->s; of the second q->s, s->v, v->q (was prev(twin(h))). Requires `can_split`. Throws
/// `Error` (too_large) past 2^32 - 2 half-edges; the mesh is then unchanged. Cost: O(1), amortised.
VertexId split_edge(Mesh& mesh, HalfedgeId h, const Vec3& point);

/// True if `collapse` keeps the manifold and its topology: the link condition, and no boundary is pinched or lost.
/// Cost: O(valences of both ends).
[[nodiscard]] bool can_collapse(const Mesh& mesh, HalfedgeId h);

/// Merges target(h) into origin(h), which moves to `point`. The faces at the edge and the target die: they keep their
/// ids until `compact`, but `is_live` is false for them. Requires `can_collapse`. Cost: O(valence of the target).
void collapse(Mesh& mesh, HalfedgeId h, const Vec3& point);

/// True if `split_vertex` is allowed: left (and right, unless it is not valid) are neighbours of v, distinct, and both
/// ends keep a fan of faces. Without `right`, v must be a boundary vertex. Cost: O(valence of v).
[[nodiscard]] bool can_split_vertex(const Mesh& mesh, VertexId v, VertexId left, VertexId right);

/// The inverse of `collapse`: a new vertex n appears at `point`, joined to v, left and right; the faces at v from right
/// counter-clockwise to left become n's. New faces: (v, n, left) and, if right is valid, (n, v, right). Without `right`
/// the edge v->n is on the boundary. Returns n; its id is the old vertex count. Requires `can_split_vertex`. Throws
/// `Error` (too_large) past 2^32 - 2 half-edges. Cost: O(valence of v).
VertexId split_vertex(Mesh& mesh, VertexId v, VertexId left, VertexId right, const Vec3& point);

/// Takes away a vertex that has no face: like what `collapse` takes away, it keeps its id until `compact`. O(1).
void remove_isolated(Mesh& mesh, VertexId v);

/// Old ids to new ones; not valid for what died.
struct CompactMap {
    std::vector<VertexId> vertex;
    std::vector<FaceId> face;
};

/// Removes dead elements; the order of the living ones is kept. Cost: O(size).
CompactMap compact(Mesh& mesh);

/// The two halves of that, in this order: each needs less room, and the first frees some for the second.
std::vector<VertexId> compact_vertices(Mesh& mesh);
std::vector<FaceId> compact_faces(Mesh& mesh);

/// Gives the living elements the ids that the map says, which are those from 0 on without gaps, and removes dead ones.
/// Each face keeps its first corner. Cost: O(size).
void renumber(Mesh& mesh, const CompactMap& map);

/// Gives back the room that `compact` has left.
void shrink(Mesh& mesh);

/// Makes room for growth, to avoid reallocation. Never required.
void reserve(Mesh& mesh, std::size_t vertices, std::size_t faces);

/// Deletes a face none of whose vertices loses its last face or gets a second fan. Used to take off zero-area faces at
/// the boundary. The face dies as in `collapse`. Cost: O(1) plus the check.
[[nodiscard]] bool can_remove_face(const Mesh& mesh, FaceId f);
void remove_face(Mesh& mesh, FaceId f);

}  // namespace delmesh
