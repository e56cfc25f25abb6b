#pragma once
// Triangles over vertices, with no promise about how they fit together: what the steps of a repair work on.

#include "delmesh/base/context.hpp"
#include "delmesh/repair/repair.hpp"
#include "mesh/edge_groups.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace delmesh::repairing {

using Index = std::uint32_t;
inline constexpr Index none = ~Index{0};

/// Half-edge h belongs to face h/3 and leaves vertex corners[h]; a corner is named by the half-edge that leaves it.
/// Vertices at one place keep their own numbers, so that faces which were joined in the input can be told from faces
/// that merely touch: two faces are *joined* if they share an edge by number, and *meet* if they share it by place.
/// The vertices are those of the input, and copies of them, which follow at the end.
struct Complex {
    explicit Complex(std::span<const Vec3> input) : points(input) {}
    Complex(Complex&&) = default;
    Complex(const Complex&) = delete;

    std::span<const Vec3> points;  ///< of the input vertices: those of the input, or `moved`
    std::vector<Vec3> moved;       ///< empty if all are where they were
    std::vector<Index> places;     ///< for each input vertex the smallest vertex at the same place
    std::vector<Index> copied;     ///< for each copy the input vertex it is a copy of
    std::vector<Index> corners;    ///< three for each face
    std::vector<FaceId> origin;    ///< for each face the input face it lies in
    std::vector<bool> turned;      ///< for each face whether it was turned round to agree with its component
    std::vector<bool> mended;      ///< for each face whether its component was joined, turned or cut

    [[nodiscard]] std::size_t vertex_count() const { return points.size() + copied.size(); }
    [[nodiscard]] std::size_t face_count() const { return origin.size(); }
    [[nodiscard]] std::size_t halfedge_count() const { return corners.size(); }

    /// The input vertex that v is, or is a copy of.
    [[nodiscard]] Index source(Index v) const { return v < points.size() ? v : copied[v - points.size()]; }
    [[nodiscard]] Index place(Index v) const { return places[source(v)]; }
    [[nodiscard]] const Vec3& point(Index v) const { return points[source(v)]; }

    static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static Index prev(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

    [[nodiscard]] Index from(Index h) const { return corners[h]; }
    [[nodiscard]] Index to(Index h) const { return corners[next(h)]; }
    [[nodiscard]] Index place_from(Index h) const { return place(corners[h]); }
    [[nodiscard]] Index place_to(Index h) const { return place(corners[next(h)]); }
    [[nodiscard]] Index place_apex(Index h) const { return place(corners[prev(h)]); }

    /// Face f and half-edge h after their face was turned round: the edge of h keeps its place, but its number changes.
    void turn(std::size_t f) { std::swap(corners[3 * f + 1], corners[3 * f + 2]); }
    static Index turned_halfedge(Index h) { return h - h % 3 + (2 - h % 3); }

    /// True if h and g, at one edge, run in opposite directions.
    [[nodiscard]] bool opposite(Index h, Index g) const { return place_from(h) == place_to(g); }
    /// True if h and g join the same two vertices by number, in whatever direction.
    [[nodiscard]] bool share_numbers(Index h, Index g) const {
        return (from(h) == from(g) && to(h) == to(g)) || (from(h) == to(g) && to(h) == from(g));
    }

    /// Drops the faces for which `gone` says so; the others keep their order.
    template <class Gone>
    void drop_faces(Gone&& gone) {
        std::size_t kept = 0;
        for (std::size_t f = 0; f < face_count(); ++f) {
            if (gone(f)) continue;
            for (std::size_t i = 0; i < 3; ++i) corners[3 * kept + i] = corners[3 * f + i];
            turned[kept] = turned[f];
            mended[kept] = mended[f];
            origin[kept++] = origin[f];
        }
        origin.resize(kept);
        turned.resize(kept);
        mended.resize(kept);
        corners.resize(3 * kept);
    }
};

/// For each half-edge the one it is joined with, or none.
using Partners = std::vector<Index>;

/// The half-edges of a complex, grouped by the places that their edges join.
class Edges {
public:
    explicit Edges(const Complex& complex)
        : complex_(complex),
          groups_(complex.points.size(), complex.halfedge_count(), [&](Index h) { return ends(complex, h).first; }) {}

    /// Calls visitor(half-edges) for each edge; half-edges are in ascending order.
    template <class Visitor>
    void visit(Visitor&& visitor) const {
        groups_.visit([&](Index h) { return ends(complex_, h).second; }, visitor);
    }
    /// Only for edges between marked places.
    template <class Visitor>
    void visit_between(const std::vector<bool>& marked, Visitor&& visitor) const {
        groups_.visit([&](Index h) { return ends(complex_, h).second; },
                      [&](std::span<const Index> edge) {
                          if (marked[ends(complex_, edge[0]).second]) visitor(edge);
                      },
                      [&](Index place) { return marked[place]; });
    }
    /// See `EdgeGroups::links`: there is room for partners.
    [[nodiscard]] std::vector<Index>& links() { return groups_.links(); }

private:
    static std::pair<Index, Index> ends(const Complex& complex, Index h) {
        return std::minmax({complex.place_from(h), complex.place_to(h)});
    }

    const Complex& complex_;
    EdgeGroups<Index> groups_;
};

/// Some edges, each with its half-edges.
class EdgeList {
public:
    void add(std::span<const Index> edge) {
        halfedges_.insert(halfedges_.end(), edge.begin(), edge.end());
        starts_.push_back(static_cast<Index>(halfedges_.size()));
    }

    [[nodiscard]] std::size_t size() const { return starts_.size() - 1; }
    [[nodiscard]] std::span<Index> operator[](std::size_t e) {
        return std::span(halfedges_).subspan(starts_[e], starts_[e + 1] - starts_[e]);
    }

private:
    std::vector<Index> halfedges_;
    std::vector<Index> starts_{0};
};

/// What was found so far.
class Log {
public:
    void add(Defect kind, std::size_t element) { note(kind, {element, 0}, 1); }
    void add_pair(Defect kind, std::size_t a, std::size_t b) { note(kind, {a, b}, 2); }
    void forget(Defect kind) { found_[static_cast<std::size_t>(kind)] = {}; }
    [[nodiscard]] std::vector<Finding> findings() const;

private:
    void note(Defect kind, std::array<std::size_t, 2> place, std::size_t numbers);
    std::array<Finding, defect_kinds> found_{};
};

/// Thrown inside a repair when the context was cancelled; never leaves it.
struct Cancelled {};
inline void check_cancelled(const Context* context) {
    if (is_cancelled(context)) throw Cancelled();
}

// The steps, in their order. Each is the identity on its own result.

/// Drops what names nothing or is not a number, and cuts the rest into triangles.
[[nodiscard]] Complex sift(const PolygonSoup& soup, Log& log);
/// Finds the vertices that are at one place; with a tolerance, moves clusters to one place first.
void weld(Complex& complex, double tolerance_rel, Log& log);
/// Drops faces with two corners at one place and flips faces without area away.
void remove_degenerate(Complex& complex, Log& log, const Context* context);
/// What is left of faces at one place.
struct Doubled {
    bool dropped = false;  ///< some were dropped
    bool kept = false;     ///< some are still double, as both layers are needed
};
/// Drops faces at the place of another one, unless both layers are needed. `edges` hold no more if any were dropped.
Doubled remove_duplicates(Complex& complex, const Edges& edges, Log& log);

struct Joined {
    Partners partners;
    EdgeList crowded;  ///< edges with more than two half-edges, the half-edges in ascending order
};
/// Joins the half-edges of each edge in pairs; at most one of each edge stays alone. `edges` are used up.
[[nodiscard]] Joined pair_halfedges(const Complex& complex, Edges& edges, Log& log, const Context* context);
/// Turns faces so that partners run in opposite directions, and parts those that can not. Returns how much was parted,
/// as a sum of lengths in a fixed unit: 0 if nothing was.
std::uint64_t orient(Complex& complex, Joined& joined, Log& log, const Context* context);
/// Exchanges partners at edges that would join the same two vertices twice, and numbers the vertices so that partners
/// share their ends and nothing else does.
void separate_fans(Complex& complex, Joined& joined, Log& log);
/// Drops the back of each triangle that is joined with its own back alone and has an obtuse angle. True if there were
/// any; `partners` do not hold then.
bool open_pillows(Complex& complex, const Partners& partners, Log& log);
/// Turns the outermost closed components outwards, and with them what lies inside. Where all of them face inwards and
/// no face was turned before, that is how the mesh is meant, and it stays, unless `always` is set. `partners` do not
/// hold afterwards.
void turn_outward(Complex& complex, const Partners& partners, bool always, Log& log);

}  // namespace delmesh::repairing
