#pragma once
// Planar facets laid out in the plane, one at a time and only where they are asked for.

#include "delaunay/id_map.hpp"
#include "delaunay/marked_mesh.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace delmesh {

struct Point2 {
    double x = 0;
    double y = 0;
};

constexpr Point2 operator-(Point2 a, Point2 b) {
    return {a.x - b.x, a.y - b.y};
}
constexpr Point2 operator+(Point2 a, Point2 b) {
    return {a.x + b.x, a.y + b.y};
}
constexpr Point2 operator*(double s, Point2 a) {
    return {s * a.x, s * a.y};
}
constexpr double dot(Point2 a, Point2 b) {
    return a.x * b.x + a.y * b.y;
}

/// A facet's view of one of its physical edges. The edge runs from its smaller vertex (parameter 0) to the larger one
/// (parameter 1). In the *frame* of the side the edge is the interval [0,1] of the x axis and the facet lies above it.
struct Side {
    Point2 start;  ///< of the edge, in the plane of the facet
    Point2 along;  ///< from start to end
    Point2 x_row;  ///< the linear map into the frame
    Point2 y_row;  ///<
    Point2 apex;   ///< the corner opposite to the edge in its triangle, in the frame
    std::uint32_t edge = 0;
    std::uint32_t facet = 0;
    std::uint32_t triangle = 0;  ///< the one at the edge; 0 where the facet is a single triangle

    [[nodiscard]] Point2 at(double t) const { return start + t * along; }
    [[nodiscard]] Point2 to_frame(Point2 p) const { return turn(p - start); }
    [[nodiscard]] Point2 turn(Point2 d) const { return {dot(x_row, d), dot(y_row, d)}; }
};

/// A side in the plane of its facet, from its smaller vertex on. The facet lies to the left, or to the right if
/// `mirrored`.
struct SideLine {
    Point2 start;
    Point2 along;
    bool mirrored = false;
};

/// A triangle of a facet that has several.
struct FacetTriangle {
    std::array<std::uint32_t, 3> corner{};
    std::array<std::uint32_t, 3> beyond{};  ///< across the side corner[i], corner[i+1]: a triangle, or a side
    std::array<bool, 3> is_side{};
};

struct Facet {
    std::uint32_t first_side = 0;
    std::uint32_t side_count : 31 = 0;
    bool single : 1 = true;            ///< one triangle: `side_count` is 3, in the order of its half-edges
    std::uint32_t kept = IdMap::none;  ///< where its sides are kept, see FacetLayout
};
static_assert(sizeof(Facet) == 12);  // there are as many as faces

/// Lays out facets of a mesh whose planar edges are Delaunay within their facets. Facets, sides and edges are numbered
/// in the order in which they are asked for. The mesh must not change. Memory: what was asked for, no more.
class FacetLayout {
public:
    static constexpr std::uint32_t none = IdMap::none;

    struct Edge {
        HalfedgeId halfedge;                            ///< the one that names the edge
        std::array<std::uint32_t, 2> side{none, none};  ///< 0: of the half-edge from the smaller vertex
        bool is_delaunay = true;                        ///< exactly, before any split
        bool is_usable = true;                          ///< both facets could be laid out in doubles
    };

    explicit FacetLayout(const MarkedMesh& marked);
    /// An empty layout of the same mesh.
    FacetLayout(const MarkedMesh& marked, const FacetLayout& other);

    /// The facet of a face, laid out if it was not. Cost: O(n log n) for a new facet of n triangles.
    std::uint32_t facet_of(FaceId f);
    /// The edge with the facets at both of its sides.
    std::uint32_t edge_of(HalfedgeId h);
    /// Lays out the facets at both sides of an edge that a facet has named.
    void complete(std::uint32_t edge);
    /// Makes room for so many more facets, most of them single triangles. Room that is not used costs no memory, but
    /// growing step by step costs it twice.
    void expect(std::size_t facets);

    /// All edges that are not Delaunay and not planar, so that no other has to be asked.
    void know_bad(std::span<const EdgeId> bad);

    [[nodiscard]] const MarkedMesh& marked() const { return marked_; }
    [[nodiscard]] std::size_t facet_count() const { return facets_.size(); }
    [[nodiscard]] std::size_t edge_count() const { return edges_.size(); }
    [[nodiscard]] std::size_t edge_capacity() const { return edges_.capacity(); }
    [[nodiscard]] const Edge& edge(std::uint32_t e) const { return edges_[e]; }
    [[nodiscard]] Side side(std::uint32_t s) const;
    /// A part of side(s), which takes a fraction of the time.
    [[nodiscard]] SideLine line(std::uint32_t s) const;
    /// Another side of the same facet in the frame of `side`, which is side s: from where it starts, and along it.
    [[nodiscard]] std::pair<Point2, Point2> seen_from(const Side& side, std::uint32_t s, std::uint32_t other) const;
    /// side(s).edge.
    [[nodiscard]] std::uint32_t edge_at(std::uint32_t s) const { return records_[s].edge; }
    /// side(s).facet.
    [[nodiscard]] std::uint32_t facet_at(std::uint32_t s) const { return records_[s].facet; }
    /// Which of the two sides of edge e lies in a facet, 0 or 1; 0 if both do. Requires that one does.
    [[nodiscard]] std::size_t side_within(std::uint32_t e, std::uint32_t facet) const {
        const std::uint32_t first = edges_[e].side[0];
        return first != none && records_[first].facet == facet ? 0 : 1;
    }
    [[nodiscard]] const Facet& facet(std::uint32_t f) const { return facets_[f]; }
    [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }
    [[nodiscard]] const FacetTriangle& triangle(std::uint32_t t) const { return triangles_[t]; }
    [[nodiscard]] Point2 corner(std::uint32_t c) const { return corners_[c]; }

private:
    /// What a side is computed from: that takes no longer than to fetch all of it from memory.
    struct SideRecord {
        std::uint32_t edge : 30 = 0;
        std::uint32_t corner : 2 = 0;  ///< 0, 1 or 2: of the triangle, opposite to the side
        std::uint32_t facet : 30 = 0;
        bool forward : 1 = true;  ///< the side runs from its smaller vertex to the larger one
        bool single : 1 = true;
        std::uint32_t place = 0;  ///< of a single triangle its first corner; else the triangle

        /// Corners of the triangle, where the edge starts and ends.
        [[nodiscard]] std::uint32_t start() const { return forward ? after() : before(); }
        [[nodiscard]] std::uint32_t end() const { return forward ? before() : after(); }
        [[nodiscard]] std::uint32_t after() const { return corner == 2 ? 0 : corner + 1; }
        [[nodiscard]] std::uint32_t before() const { return corner == 0 ? 2 : corner - 1; }
    };
    static_assert(sizeof(SideRecord) == 12);
    static constexpr std::uint32_t mask = (1u << 30) - 1;

    [[nodiscard]] Side make_side(const SideRecord& record) const;
    [[nodiscard]] const Side* kept_side(std::uint32_t s) const {
        const Facet& facet = facets_[records_[s].facet];
        return facet.kept == none ? nullptr : &sides_[facet.kept + (s - facet.first_side)];
    }
    static void check_size(std::size_t count);
    std::uint32_t name_edge(HalfedgeId h);
    void gather(FaceId f, std::uint32_t facet);
    void lay_corners();
    void add_side(HalfedgeId h, SideRecord record);
    void add_triangle(FaceId f, std::uint32_t facet, std::uint32_t first_triangle);
    [[nodiscard]] Vec3 scaled(VertexId v) const;
    [[nodiscard]] std::uint32_t corner_of(VertexId v) const;

    const MarkedMesh& marked_;
    const Mesh& mesh_;
    double scale_ = 1;
    double second_scale_ = 1;
    bool knows_bad_ = false;
    std::vector<bool> is_bad_;  ///< per half-edge that names an edge
    IdMap facet_of_face_;
    IdMap edge_of_halfedge_;
    std::vector<Facet> facets_;
    std::vector<SideRecord> records_;
    std::vector<Side> sides_;  ///< of facets with many sides, as each of these is looked at very often
    std::vector<Edge> edges_;
    std::vector<FacetTriangle> triangles_;
    std::vector<Point2> corners_;
    std::vector<FaceId> faces_;                                      ///< of the facet that is being made, sorted
    std::vector<std::pair<VertexId, std::uint32_t>> local_corners_;  ///< the same, sorted by vertex
};

inline SideLine FacetLayout::line(std::uint32_t s) const {
    const SideRecord& record = records_[s];
    const auto point = [&](std::uint32_t i) {
        return corners_[record.single ? record.place + i : triangles_[record.place].corner[i]];
    };
    const Point2 start = point(record.start());
    return {start, point(record.end()) - start, !record.forward};
}

inline Side FacetLayout::side(std::uint32_t s) const {
    const SideRecord& record = records_[s];
    if (!record.single)
        if (const Side* kept = kept_side(s)) return *kept;
    return make_side(record);
}

inline Side FacetLayout::make_side(const SideRecord& record) const {
    Side side;
    side.edge = record.edge;
    side.facet = record.facet;
    side.triangle = record.single ? 0 : record.place;
    const auto point = [&](std::uint32_t i) {
        return corners_[record.single ? record.place + i : triangles_[record.place].corner[i]];
    };
    side.start = point(record.start());
    side.along = point(record.end()) - side.start;
    side.x_row = 1 / dot(side.along, side.along) * side.along;
    side.y_row = (record.forward ? 1.0 : -1.0) * Point2{-side.x_row.y, side.x_row.x};
    side.apex = side.to_frame(point(record.corner));
    return side;
}

/// In a triangle that is known without a look at the corners.
inline std::pair<Point2, Point2> FacetLayout::seen_from(const Side& side, std::uint32_t s, std::uint32_t other) const {
    const SideRecord& there = records_[other];
    if (!there.single) {
        if (const Side* kept = kept_side(other)) return {side.to_frame(kept->start), side.turn(kept->along)};
        const Point2 start = corners_[triangles_[there.place].corner[there.start()]];
        const Point2 end = corners_[triangles_[there.place].corner[there.end()]];
        return {side.to_frame(start), side.turn(end - start)};
    }
    const SideRecord& here = records_[s];
    const auto place = [&](std::uint32_t i) {
        return i == here.corner ? side.apex : Point2{i == here.end() ? 1.0 : 0.0, 0};
    };
    const Point2 start = place(there.start());
    return {start, place(there.end()) - start};
}

}  // namespace delmesh
