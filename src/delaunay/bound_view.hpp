#pragma once
// What is certain about an edge's surroundings: which corners and sides of its facets see all of it, and where they
// lie, as intervals.

#include "delaunay/interval.hpp"
#include "delaunay/marked_mesh.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <array>
#include <vector>

namespace delmesh {

/// A point in the frame of an edge, which runs from 0 to 1 on the x axis. All facets are turned to lie above it.
struct FramePoint {
    Interval x;
    Interval y;
};

/// Above the edge for certain, and within the range where nothing over- or underflows.
[[nodiscard]] inline bool is_usable(const FramePoint& p) {
    return p.y.low > 0x1p-100 && p.y.high < 0x1p100 && std::fabs(p.x.low) < 0x1p100 && std::fabs(p.x.high) < 0x1p100;
}

/// The cotangent of the angle at which p sees the whole edge, times p.y.
[[nodiscard]] inline Interval scaled_cot(const FramePoint& p) {
    return p.x * (p.x - exactly(1)) + square(p.y);
}

/// A convex polygon within a facet with an edge as one of its sides: all its points see each other.
struct ConvexView {
    std::vector<VertexId> corners;  ///< but for the ends of the edge
    std::vector<HalfedgeId> sides;  ///< those that are physical, but for the edge
};

class BoundView {
public:
    /// `exact_facets`: facets of several faces are plane exactly; else nothing is said about them. Split points may lie
    /// off their edges by `precision` times the largest coordinate.
    BoundView(const MarkedMesh& marked, bool exact_facets, double precision);

    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    /// Is the face of h a part of the plane that any method must keep?
    [[nodiscard]] bool is_certain(HalfedgeId h) const { return exact_facets_ || is_single(Mesh::face(h)); }
    /// The view from h into its own facet; empty if nothing is certain there. Cost: O(1), as its size is limited.
    void look(HalfedgeId h, ConvexView& view);

    /// The frame of the edge from u to v; false where doubles do not hold it.
    struct Frame {
        VertexId u;
        VertexId v;
        std::array<Interval, 3> along{};
        Interval length2;
        double slack = 0;  ///< how far split points may be off their place, in the frame
    };
    [[nodiscard]] bool make_frame(VertexId u, VertexId v, Frame& frame) const;
    [[nodiscard]] FramePoint locate(const Frame& frame, VertexId p) const;

private:
    [[nodiscard]] bool is_single(FaceId f) const;
    [[nodiscard]] std::array<Interval, 3> difference(VertexId a, VertexId b) const;
    void grow();
    [[nodiscard]] bool turns_left(VertexId a, VertexId b, VertexId c) const;

    const MarkedMesh& marked_;
    const Mesh& mesh_;
    bool exact_facets_;
    double scale_ = 1;
    double second_scale_ = 1;
    double precision_;
    int axis_ = 2;
    Sign side_ = Sign::positive;
    std::vector<VertexId> ring_;
    std::vector<HalfedgeId> ring_sides_;  ///< from ring_[i] to the next
};

}  // namespace delmesh
