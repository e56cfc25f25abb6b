#pragma once
// Split positions on physical edges, and whether every part of every edge is Delaunay: no triangulation is needed.
//
// In a Delaunay facet the angle opposite to a part of a side is the largest one at which any point of the facet that
// sees the part does see it. So a part is Delaunay iff the smallest cotangents at its two sides do not sum to less than
// zero (at the boundary: iff the smallest one is not below zero). The model keeps these minima up to date.

#include "delaunay/facet_layout.hpp"

#include <limits>
#include <span>
#include <vector>

namespace delmesh {

/// What a part of a side sees under the largest angle.
struct Contact {
    double cot = 0;
    Point2 at;                               ///< in the frame of the side
    std::uint32_t edge = FacetLayout::none;  ///< the edge it lies on; none: a corner of the input
    double along = 0;                        ///< its place on that edge
};

/// A part of an edge, from the end of the part before it (or 0) to `end`.
struct Part {
    double end = 1;
    std::array<double, 2> cot{};  ///< the smallest, for both sides; 0 where there is no facet
    std::array<std::uint32_t, 2> culprit{FacetLayout::none, FacetLayout::none};
};

class SplitModel {
public:
    static constexpr std::uint32_t none = FacetLayout::none;

    explicit SplitModel(const MarkedMesh& marked) : layout_(marked) {}
    /// An empty model of the mesh that another layout is of.
    SplitModel(const MarkedMesh& marked, const FacetLayout& other) : layout_(marked, other) {}

    // --- where ---
    [[nodiscard]] const FacetLayout& layout() const { return layout_; }
    std::uint32_t edge_of(HalfedgeId h) { return layout_.edge_of(h); }
    /// Makes everything known that a change of this edge's points may touch.
    void prepare(std::uint32_t e);
    [[nodiscard]] bool is_prepared(std::uint32_t e) const { return e < states_.size() && states_[e].prepared; }
    void know_bad(std::span<const EdgeId> bad) { layout_.know_bad(bad); }
    /// Makes room for preparing so many edges, see FacetLayout::expect.
    void expect(std::size_t edges);
    /// Points may be put on this edge.
    [[nodiscard]] bool is_movable(std::uint32_t e) const { return states_[e].movable; }
    void set_movable(std::uint32_t e, bool movable) { states_[e].movable = movable; }

    // --- positions ---
    [[nodiscard]] std::size_t edge_count() const { return states_.size(); }
    [[nodiscard]] std::size_t point_count() const { return points_; }
    [[nodiscard]] std::uint32_t point_count(std::uint32_t e) const {
        return e < states_.size() && states_[e].made ? states_[e].count - 1 : 0;
    }
    [[nodiscard]] std::span<const Part> parts(std::uint32_t e) const {
        return {pool_.data() + states_[e].first, states_[e].count};
    }
    [[nodiscard]] double part_start(std::uint32_t e, std::size_t i) const {
        return i == 0 ? 0.0 : pool_[states_[e].first + i - 1].end;
    }
    /// The index of the part that ends at or after `at`.
    [[nodiscard]] std::size_t part_at(std::uint32_t e, double at) const;
    /// Replaces the points first ... last-1 of a prepared edge by new ones, in order. Edges with parts that are no
    /// longer Delaunay go onto the list of suspects.
    void cut(std::uint32_t e, std::size_t first, std::size_t last, std::span<const double> points);

    // --- judgement ---
    /// From now on the parts of this edge must keep a distance from ties.
    void distrust(std::uint32_t e) { states_[e].distrusted = true; }
    [[nodiscard]] bool is_distrusted(std::uint32_t e) const { return states_[e].distrusted; }
    [[nodiscard]] bool is_bad(std::uint32_t e, const Part& part) const;
    /// The first part that is not Delaunay, or -1.
    [[nodiscard]] int first_bad(std::uint32_t e) const;
    /// Edges that may have a part that is not Delaunay; each is listed once, until it is taken off.
    [[nodiscard]] std::size_t suspect_count() const { return suspects_.size(); }
    [[nodiscard]] std::uint32_t suspect(std::size_t i) const { return suspects_[i]; }
    void add_suspect(std::uint32_t e);
    /// Edges that were given up are never suspected, until they are no longer.
    void give_up(std::uint32_t e, bool yes) { states_[e].given_up = yes; }
    [[nodiscard]] bool is_given_up(std::uint32_t e) const { return states_[e].given_up; }
    void drop_suspect(std::size_t i);
    void swap_suspects(std::size_t i, std::size_t j) { std::swap(suspects_[i], suspects_[j]); }

    /// What sees the interval [a,b] of a side under the largest angle. Where the facet is not a single triangle and
    /// nothing has a cotangent below `bound`, only that is told: by `bound` as the cotangent.
    [[nodiscard]] Contact nearest(std::uint32_t s, double a, double b,
                                  double bound = std::numeric_limits<double>::infinity()) const;
    /// True if the disc of the points that see [a,b] of side s with a cotangent below `level` reaches side t within the
    /// facet.
    [[nodiscard]] bool reaches(std::uint32_t s, double a, double b, double level, std::uint32_t t) const {
        return layout_.facet(layout_.facet_at(s)).single || reaches_through(s, a, b, level, t);
    }

    // --- weights, for the search ---
    [[nodiscard]] int weight(std::uint32_t e) const { return states_[e].weight; }
    void add_weight(std::uint32_t e, int more);

    // --- transactions ---
    void begin();
    void commit();
    void rollback();
    /// Calls visit(edge) for each edge of which a part, or what it sees, has changed since `begin`.
    template <class Visit>
    void visit_changed(Visit&& visit) const {
        for (const Saved& saved : saved_) visit(saved.edge);
    }

    /// Elementary evaluations so far: the measure of work that budgets are stated in.
    [[nodiscard]] std::uint64_t work() const { return work_; }
    void count_work(std::size_t more) const { work_ += more; }
    /// From now on facets of many triangles count for less than they take, and no walk through them looks for what a
    /// side without points sees: it is the corner of the triangle there, up to ties.
    void favour_large_facets() {
        triangle_work_ = 3;
        trusts_triangles_ = true;
        side_work_ = 0;
    }

    static constexpr int base_weight = 10;
    static constexpr std::uint64_t corner_work = 10;  ///< less than that of the walk that is saved, as it is

private:
    struct State {
        std::uint32_t first = 0;  ///< of its parts in the pool
        std::uint32_t count = 0;
        std::uint32_t transaction = 0;
        int weight = base_weight;
        std::uint8_t size_class = 0;  ///< room for 2^size_class parts
        // Bits: there is one for each edge.
        bool made : 1 = false;
        bool prepared : 1 = false;
        bool movable : 1 = true;
        bool suspected : 1 = false;
        bool given_up : 1 = false;
        bool distrusted : 1 = false;
    };
    static_assert(sizeof(State) == 20);
    struct Saved {
        std::uint32_t edge = 0;
        std::uint32_t first = 0;
        std::uint32_t count = 0;
        std::uint8_t size_class = 0;
    };
    /// A way into a triangle, from p to q, two of its corners.
    struct Gate {
        std::uint32_t triangle = 0;
        std::uint32_t from = 0;
        std::uint32_t to = 0;
        std::uint32_t before = 0;  ///< the gate on the way to it
        Point2 p;
        Point2 q;
        double level = 0;  ///< that it is open at
    };

    struct Portal {
        double level = 0;
        std::uint32_t triangle = 0;
        friend bool operator<(const Portal& a, const Portal& b) { return a.level > b.level; }
    };

    /// A side and which other sides of its triangle have points.
    struct Eye {
        std::uint32_t id = none;
        Side side;
        bool single = false;
        std::size_t count = 0;
        std::array<std::uint32_t, 2> sights{};
    };

    void grow_states();
    void make(std::uint32_t e);
    [[nodiscard]] double cot_at_corner(std::uint32_t s) const;
    [[nodiscard]] std::uint32_t allocate(std::uint8_t size_class);
    void release(std::uint32_t first, std::uint8_t size_class) { free_[size_class].push_back(first); }
    void save(std::uint32_t e);
    void replace_parts(std::uint32_t e, std::size_t first, std::size_t last, std::span<const double> points);
    void touch_facet(std::uint32_t e, std::uint32_t side, std::span<const double> points, bool removed);
    void touch_side(std::uint32_t e, std::uint32_t from, std::uint32_t s, std::span<const double> points, bool removed);
    [[nodiscard]] bool lies_flat(const SideLine& line) const;
    [[nodiscard]] bool stays(std::uint32_t e, std::uint32_t s, bool removed) const;
    [[nodiscard]] Eye eye_at(std::uint32_t s) const;
    [[nodiscard]] Contact nearest(const Eye& eye, double a, double b, double bound) const;
    void scan(const Side& side, std::uint32_t s, std::uint32_t other, double a, double b, Contact& best) const;
    [[nodiscard]] bool has_points(std::uint32_t s) const { return point_count(layout_.edge_at(s)) > 0; }
    [[nodiscard]] bool reaches_through(std::uint32_t s, double a, double b, double level, std::uint32_t t) const;
    [[nodiscard]] Contact flood(std::uint32_t s, double a, double b, double bound) const;
    [[nodiscard]] Contact flood_in_order(std::uint32_t s, double a, double b, double bound) const;
    [[nodiscard]] static double portal_level(Point2 p, Point2 q, double a, double b);
    [[nodiscard]] bool is_open(Point2 p, Point2 q, double a, double b, double level) const;
    void start_visit() const;
    void visit(std::uint32_t triangle) const;

    FacetLayout layout_;
    std::vector<State> states_;
    std::vector<Part> pool_;
    std::array<std::vector<std::uint32_t>, 32> free_;
    std::vector<std::uint32_t> suspects_;
    std::vector<Saved> saved_;
    std::vector<std::uint32_t> touched_weights_;
    std::vector<Part> scratch_;
    /// In the plane of the large facet that is touched: the ends of the edge, and its new points.
    std::vector<Point2> placed_;
    Point2 placed_along_;
    std::size_t points_ = 0;
    std::uint32_t transaction_ = 0;
    bool in_transaction_ = false;
    mutable std::vector<Portal> heap_;
    mutable std::vector<std::uint32_t> ahead_;
    mutable std::vector<Gate> gates_;
    mutable std::vector<std::uint32_t> seen_;
    mutable std::uint32_t visit_ = 0;
    std::uint64_t triangle_work_ = 5;
    std::uint64_t side_work_ = 2;
    bool trusts_triangles_ = false;
    mutable std::uint64_t work_ = 0;
};

/// The cotangent of the angle at which p sees the interval [a,b] of the x axis.
[[nodiscard]] inline double cot_of(double a, double b, Point2 p) {
    return ((a - p.x) * (b - p.x) + p.y * p.y) / (p.y * (b - a));
}

/// The parameter of the point of the line p + u d that sees [a,b] under the largest angle.
[[nodiscard]] double largest_angle_on_line(double a, double b, Point2 p, Point2 d);

}  // namespace delmesh
