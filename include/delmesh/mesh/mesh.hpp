#pragma once
// The oriented 2-manifold triangle mesh, with boundary, that every algorithm works on.

#include "delmesh/base/ids.hpp"
#include "delmesh/base/vec3.hpp"
#include "delmesh/mesh/polygon_soup.hpp"

#include <span>
#include <vector>

namespace delmesh {

class MeshEditor;

/// Half-edges in flat arrays: half-edge h belongs to face h/3 and runs from `origin(h)` to `origin(next(h))`.
///
/// A `Mesh` is always an oriented 2-manifold with boundary: every edge has one or two faces that run through it in
/// opposite directions, the faces at a vertex form one fan (open or closed), no face repeats a vertex, and no two edges
/// join the same two vertices. Vertices without a face are allowed and keep their place. Building from anything else
/// throws; the edits in `edits.hpp` keep it so; `validate()` (validate.hpp) states and checks it all.
///
/// Memory: 24 bytes a face, 28 bytes a vertex.
class Mesh {
public:
    Mesh() = default;

    /// Builds from a soup; polygons are triangulated first, the points and triangles keep their order.
    /// Throws `Error` (not_finite, index_out_of_range, degenerate_face, non_manifold_edge, inconsistent_edge,
    /// non_manifold_vertex, too_large) that names the first offenders. Cost: O(points + corners).
    explicit Mesh(PolygonSoup soup);

    // --- sizes ---
    [[nodiscard]] std::size_t vertex_count() const { return points_.size(); }
    [[nodiscard]] std::size_t face_count() const { return origin_.size() / 3; }
    [[nodiscard]] std::size_t halfedge_count() const { return origin_.size(); }
    /// O(half-edges).
    [[nodiscard]] std::size_t count_edges() const;

    /// False for what `collapse` or `remove_face` took away, until `compact`. Always true outside of algorithms that
    /// edit.
    [[nodiscard]] bool is_live(FaceId f) const { return origin_[f.index() * 3].valid(); }
    [[nodiscard]] bool is_live(VertexId v) const { return points_[v.index()].x == points_[v.index()].x; }

    // --- connectivity ---
    [[nodiscard]] static HalfedgeId next(HalfedgeId h) {
        return HalfedgeId(h.value() % 3 == 2 ? h.value() - 2 : h.value() + 1);
    }
    [[nodiscard]] static HalfedgeId prev(HalfedgeId h) {
        return HalfedgeId(h.value() % 3 == 0 ? h.value() + 2 : h.value() - 1);
    }
    [[nodiscard]] static FaceId face(HalfedgeId h) { return FaceId(h.value() / 3); }
    [[nodiscard]] static HalfedgeId halfedge(FaceId f) { return HalfedgeId(f.value() * 3); }
    [[nodiscard]] static HalfedgeId halfedge(EdgeId e) { return HalfedgeId(e.value()); }

    [[nodiscard]] VertexId origin(HalfedgeId h) const { return origin_[h.index()]; }
    [[nodiscard]] VertexId target(HalfedgeId h) const { return origin_[next(h).index()]; }
    /// The vertex opposite to h in its face.
    [[nodiscard]] VertexId apex(HalfedgeId h) const { return origin_[prev(h).index()]; }
    /// The half-edge that runs the other way; not valid at the boundary.
    [[nodiscard]] HalfedgeId twin(HalfedgeId h) const { return twin_[h.index()]; }
    [[nodiscard]] bool is_boundary(HalfedgeId h) const { return !twin(h).valid(); }
    [[nodiscard]] EdgeId edge(HalfedgeId h) const {
        const HalfedgeId t = twin(h);
        return EdgeId(t.valid() && t < h ? t.value() : h.value());
    }
    /// True for the one half-edge of each edge that names it.
    [[nodiscard]] bool names_edge(HalfedgeId h) const { return !twin(h).valid() || h < twin(h); }
    /// A half-edge that leaves v (not valid for a vertex without faces). At a boundary vertex it is the one without a
    /// twin, so that `next_around` visits the whole fan.
    [[nodiscard]] HalfedgeId halfedge(VertexId v) const { return out_[v.index()]; }
    [[nodiscard]] bool is_boundary(VertexId v) const { return halfedge(v).valid() && is_boundary(halfedge(v)); }
    /// The next half-edge that leaves the same vertex, counter-clockwise; not valid past the end of an open fan.
    [[nodiscard]] HalfedgeId next_around(HalfedgeId h) const { return twin(prev(h)); }
    /// Asks memory for the twin of h ahead of its use.
    void prefetch_twin(HalfedgeId h) const { __builtin_prefetch(twin_.data() + h.index()); }
    /// The half-edge from a to b, or not valid if there is none. Cost: O(smaller valence of the two).
    [[nodiscard]] HalfedgeId find_halfedge(VertexId a, VertexId b) const;
    /// True if an edge joins a and b, in either direction. Cost: O(smaller valence of the two).
    [[nodiscard]] bool are_joined(VertexId a, VertexId b) const;

    // --- geometry ---
    [[nodiscard]] const Vec3& point(VertexId v) const { return points_[v.index()]; }
    void set_point(VertexId v, const Vec3& p) { points_[v.index()] = p; }
    [[nodiscard]] std::span<const Vec3> points() const { return points_; }
    /// The vertices of all faces, 3 per face.
    [[nodiscard]] std::span<const VertexId> corners() const { return origin_; }

private:
    friend class MeshEditor;
    void find_outgoing();

    std::vector<VertexId> origin_;
    std::vector<HalfedgeId> twin_;
    std::vector<HalfedgeId> out_;
    std::vector<Vec3> points_;
};

/// The mesh as a soup of triangles (points, then faces, in order).
[[nodiscard]] PolygonSoup to_soup(const Mesh& mesh);

}  // namespace delmesh
