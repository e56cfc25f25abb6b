#pragma once
// A mesh whose edges are marked as physical or planar and whose faces know their facet. Flips and splits keep the marks
// in step, so that planarity is a matter of bookkeeping and never measured again: a split point rounded to double lies
// up to an ulp off its edge.

#include "delaunay/hub_index.hpp"
#include "delmesh/delaunay/provenance.hpp"
#include "delmesh/exact/sign.hpp"
#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace delmesh {

enum class Mark : std::uint8_t {
    planar,    ///< lies inside a facet: may be flipped, the surface stays
    physical,  ///< a crease or the boundary, or a part of one: may only be split
};

/// Facets that are plane only within a tolerance: flips there keep every face looking the same way along an axis, so
/// that the facet never folds.
struct FlatFacets {
    struct Plane {
        int axis = 2;
        Sign side = Sign::positive;
        double thickness = 0;  ///< along the axis, in the frame
        bool flipped = false;  ///< has anything been flipped there?
    };
    std::vector<Plane> planes;
    /// For each input face one more than the index of its plane, or 0; empty where all facets are exactly plane.
    std::vector<std::uint32_t> plane_of;
};

/// The side to which the triangle abc looks along an axis. Exact.
[[nodiscard]] Sign side_along(int axis, const Vec3& a, const Vec3& b, const Vec3& c);

class MarkedMesh {
public:
    /// `marks`: one per half-edge, twins alike; `facets`: one per face, or none at all where nobody asks.
    MarkedMesh(Mesh& mesh, std::vector<Mark> marks, std::vector<FaceId> facets);

    /// The same marks for a mesh that is a copy of other's.
    MarkedMesh(Mesh& copy, const MarkedMesh& other);
    /// Copies the other mesh into an empty one, with room for so many splits.
    MarkedMesh(Mesh& empty, const MarkedMesh& other, std::size_t splits);
    /// Takes over the mesh and the marks of another one, which is of no more use.
    void take(MarkedMesh&& other);

    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    [[nodiscard]] bool is_planar(HalfedgeId h) const { return marks_[h.index()] == Mark::planar; }
    [[nodiscard]] std::size_t input_vertices() const { return input_vertices_; }
    [[nodiscard]] std::size_t split_count() const { return splits_.size(); }
    [[nodiscard]] const std::vector<SplitPoint>& splits() const { return splits_; }
    /// Vertices of the input, and split vertices that are fixed, stay.
    [[nodiscard]] bool is_input(VertexId v) const { return v.index() < fixed_vertices_; }
    /// Where split vertex v lies. Requires !is_input(v).
    [[nodiscard]] const SplitPoint& split_point(VertexId v) const { return splits_[v.index() - input_vertices_]; }
    /// From now on all vertices count as those of an input: what they part are edges of their own.
    void fix_vertices() { fixed_vertices_ = mesh_.vertex_count(); }

    /// True if the edge of h may be flipped (see can_flip) and the new edge has a length. Cost: O(1), in effect.
    [[nodiscard]] bool is_flippable(HalfedgeId h);
    /// Tells which facets are only nearly plane.
    void set_flat_facets(FlatFacets flat) { flat_ = std::move(flat); }
    [[nodiscard]] bool has_flat_facets() const { return !flat_.plane_of.empty(); }
    /// Does the flip of a planar edge keep its facet from folding? Always true in exactly plane facets.
    [[nodiscard]] bool keeps_unfolded(HalfedgeId h) const {
        return flat_.plane_of.empty() || keeps_unfolded_in(flat_.plane_of[facets_[Mesh::face(h).index()].index()], h);
    }
    /// The largest thickness of a flat facet in which something was flipped.
    [[nodiscard]] double flattened() const;

    /// Flips a planar edge; moves half-edges as `flip` in edits.hpp does. Returns the new edge.
    HalfedgeId flip_planar(HalfedgeId h);
    /// Splits an edge at `where`, which is `point` in space; moves half-edges as `split_edge` does.
    VertexId split(HalfedgeId h, const SplitPoint& where, const Vec3& point);

    /// Flips the edge of a zero-area face that is its longest side: that face goes, the other one is cut in two. The
    /// two short sides become creases where the long one was.
    HalfedgeId flip_cap(HalfedgeId h);
    /// Merges target(h) into origin(h), which lies at the same place. Requires can_collapse.
    void merge(HalfedgeId h);
    /// Takes a zero-area face off the boundary. Requires can_remove_face.
    void drop(FaceId f);
    /// Removes what `merge` and `drop` have left dead. Ids change; split vertices keep their order.
    void compact_all();

    void reserve_splits(std::size_t count);
    /// For a mesh that is finished: no flips or splits after that.
    void forget_marks();
    /// For a mesh that is of no more use: gives back all room, the mesh's too.
    void forget_all();
    /// Hands over the facets and splits. The object is of no more use.
    [[nodiscard]] Provenance take_provenance();

private:
    [[nodiscard]] bool keeps_unfolded_in(std::uint32_t plane, HalfedgeId h) const;
    void copy_facet(HalfedgeId h);
    void mark_physical(HalfedgeId h);

    Mesh& mesh_;
    std::vector<Mark> marks_;
    std::vector<FaceId> facets_;
    std::vector<SplitPoint> splits_;
    std::size_t input_vertices_;
    std::size_t fixed_vertices_;
    HubIndex hubs_;
    FlatFacets flat_;
    /// Who went, and into whom, since the last `compact_all`.
    std::vector<std::array<VertexId, 2>> merged_;
};

}  // namespace delmesh
