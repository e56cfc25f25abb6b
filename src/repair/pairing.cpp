// Which of the faces at an edge belong together? Faces that were joined stay joined; of the others, first those that
// have no choice are joined, then the rest, edge by edge, so that what is one sheet already stays one. docs/repair.md,
// "Non-manifold edges".

#include "delmesh/exact/predicates.hpp"
#include "repair/complex.hpp"
#include "repair/direction.hpp"
#include "repair/union_find.hpp"

#include <algorithm>

namespace delmesh::repairing {
namespace {

/// A face at an edge, seen along the edge.
struct Spoke {
    Index h = none;
    Index face = none;
    bool runs_along = false;  ///< h runs in the direction of the edge
    bool forward = false;     ///< it does once its sheet faces as most of its faces do
    int quarter = 0;          ///< 0: in the plane of the first spoke, 1: less than 180 degrees on, 2: at 180, 3: more
    Vec3 apex;
    Vec3 normal;  ///< unit length but for rounding; of the half-plane, not of the face
};

class Pairing {
public:
    Pairing(const Complex& complex, Edges& edges, Log& log)
        : complex_(complex),
          log_(log),
          edges_(edges),
          partner_(edges.links()) {}

    Joined run(const Context* context) {
        EdgeList crowded;
        edges_.visit([&](std::span<const Index> edge) {
            for (const Index h : edge) partner_[h] = none;
            join_without_choice(edge);
            if (edge.size() > 2) crowded.add(edge);
        });
        if (open_.size() > 0) join_with_choice(context);
        return {std::move(partner_), std::move(crowded)};
    }

private:
    void join(Index h, Index g) {
        partner_[h] = g;
        partner_[g] = h;
    }

    /// Joins the faces that share an edge by number with one other face, and the rest if it consists of two.
    void join_without_choice(std::span<const Index> edge) {
        if (edge.size() == 2) return join(edge[0], edge[1]);
        if (edge.size() < 2) return;
        rest_.assign(edge.begin(), edge.end());
        const auto numbers = [&](Index h) {
            return std::pair(std::min(complex_.from(h), complex_.to(h)), std::max(complex_.from(h), complex_.to(h)));
        };
        std::stable_sort(rest_.begin(), rest_.end(), [&](Index a, Index b) { return numbers(a) < numbers(b); });
        for (auto run = rest_.begin(); run != rest_.end();) {
            const auto end = std::find_if(run, rest_.end(), [&](Index h) { return numbers(h) != numbers(*run); });
            if (end - run == 2) join(run[0], run[1]);
            run = end;
        }
        std::erase_if(rest_, [&](Index h) { return partner_[h] != none; });
        std::sort(rest_.begin(), rest_.end());
        if (rest_.size() == 2) return join(rest_[0], rest_[1]);
        if (rest_.size() < 2) return;
        open_.add(rest_);
        log_.add_pair(Defect::non_manifold_edge, complex_.source(complex_.from(rest_[0])),
                      complex_.source(complex_.to(rest_[0])));
    }

    void join_with_choice(const Context* context) {
        sheets_ = Sheets(complex_.face_count());
        for (Index h = 0; h < partner_.size(); ++h)
            if (partner_[h] != none && h < partner_[h]) unite(h, partner_[h]);
        std::vector<std::pair<Index, Index>> edges;  // first half-edge, edge: the order is that of the faces
        for (Index e = 0; e < open_.size(); ++e) edges.emplace_back(open_[e][0], e);
        std::sort(edges.begin(), edges.end());
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (i % 1024 == 0) check_cancelled(context);
            join_at(open_[edges[i].second]);
        }
    }

    void unite(Index h, Index g) { sheets_.unite(h / 3, g / 3, !complex_.opposite(h, g)); }

    void join_spokes(Spoke& a, Spoke& b) {
        join(a.h, b.h);
        unite(a.h, b.h);
    }

    void join_at(std::span<const Index> halfedges) {
        sort_spokes(halfedges);
        constexpr std::size_t few = 16;
        if (alternates())
            join_wedges();
        else if (spokes_.size() <= few)
            join_best_first();
        else
            join_nested();
    }

    // --- spokes in the order of their angles ---

    void sort_spokes(std::span<const Index> halfedges) {
        spokes_.clear();
        const Index from = complex_.place_from(halfedges[0]);
        const Vec3& a = complex_.point(complex_.from(halfedges[0]));
        const Vec3& b = complex_.point(complex_.to(halfedges[0]));
        const Vec3& first = complex_.point(complex_.corners[Complex::prev(halfedges[0])]);
        const Vec3 axis = direction(a, b);
        for (const Index h : halfedges) {
            Spoke s;
            s.h = h;
            s.face = h / 3;
            s.apex = complex_.point(complex_.corners[Complex::prev(h)]);
            s.runs_along = complex_.place_from(h) == from;
            s.forward = s.runs_along != sheets_.turns(s.face);
            const Sign side = orientation(a, b, first, s.apex);
            s.quarter = side == Sign::positive                ? 1
                        : side == Sign::negative              ? 3
                        : is_planar_edge(a, b, first, s.apex) ? 2
                                                              : 0;
            s.normal = unit(cross(axis, direction(a, s.apex)));
            spokes_.push_back(s);
        }
        // Of faces at the same angle, those that close a solid come before those that open the next.
        std::sort(spokes_.begin(), spokes_.end(), [&](const Spoke& s, const Spoke& t) {
            if (s.quarter != t.quarter) return s.quarter < t.quarter;
            const Sign turn = s.quarter % 2 == 1 ? orientation(a, b, s.apex, t.apex) : Sign::zero;
            if (turn != Sign::zero) return turn == Sign::positive;
            if (s.forward != t.forward) return s.forward;
            return s.h < t.h;
        });
        mark_angles(a, b);
    }

    /// Gives spokes at the same angle the same number.
    void mark_angles(const Vec3& a, const Vec3& b) {
        angle_.assign(spokes_.size(), 0);
        for (std::size_t i = 1; i < spokes_.size(); ++i) {
            const Spoke& s = spokes_[i - 1];
            const Spoke& t = spokes_[i];
            const bool same =
                s.quarter == t.quarter && (s.quarter % 2 == 0 || orientation(a, b, s.apex, t.apex) == Sign::zero);
            angle_[i] = angle_[i - 1] + (same ? 0 : 1);
        }
    }

    [[nodiscard]] bool folded(std::size_t i, std::size_t j) const { return angle_[i] == angle_[j]; }
    bool same_sheet(std::size_t i, std::size_t j) {
        bool ignored = false;
        return sheets_.find(spokes_[i].face, ignored) == sheets_.find(spokes_[j].face, ignored);
    }

    // --- the ways to join ---

    /// True if going round the edge, one always enters and leaves a solid in turn.
    [[nodiscard]] bool alternates() const {
        if (spokes_.size() % 2 == 1) return false;
        for (std::size_t i = 0; i < spokes_.size(); ++i)
            if (spokes_[i].forward == spokes_[(i + 1) % spokes_.size()].forward) return false;
        return true;
    }

    /// Joins neighbours: the two sides of each solid, or of each gap between solids where more of those are one sheet
    /// already.
    void join_wedges() {
        const std::size_t n = spokes_.size();
        std::ptrdiff_t solids = 0;
        std::ptrdiff_t gaps = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t j = (i + 1) % n;
            // A fold back onto itself is the worst that can happen.
            const std::ptrdiff_t merit = folded(i, j) ? -static_cast<std::ptrdiff_t>(n) : same_sheet(i, j) ? 1 : 0;
            (spokes_[i].forward ? gaps : solids) += merit;
        }
        const bool join_gaps = gaps > solids;
        for (std::size_t i = 0; i < n; ++i)
            if (spokes_[i].forward == join_gaps) join_spokes(spokes_[i], spokes_[(i + 1) % n]);
    }

    /// What speaks for joining two spokes; the smaller the better.
    struct Cost {
        int kind = 0;
        double bend = 0;  ///< cosine of the angle between the faces: -1 is flat
        friend auto operator<=>(const Cost&, const Cost&) = default;
    };

    Cost cost(std::size_t i, std::size_t j) {
        const bool consistent = spokes_[i].forward != spokes_[j].forward;
        const bool same = same_sheet(i, j);
        // Faces of different sheets that do not agree can be made to; those of one sheet can not.
        int kind = same ? (consistent ? 0 : 5) : (consistent ? 1 : 2);
        if (folded(i, j) && kind < 5) kind = consistent ? 3 : 4;
        return {kind, dot(spokes_[i].normal, spokes_[j].normal)};
    }

    void join_best_first() {
        std::vector<std::size_t> left(spokes_.size());
        for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
        while (left.size() > 1) {
            std::size_t best_i = 0;
            std::size_t best_j = 1;
            Cost best = cost(left[0], left[1]);
            for (std::size_t i = 0; i < left.size(); ++i)
                for (std::size_t j = i + 1; j < left.size(); ++j)
                    if (const Cost c = cost(left[i], left[j]); c < best) {
                        best = c;
                        best_i = i;
                        best_j = j;
                    }
            join_spokes(spokes_[left[best_i]], spokes_[left[best_j]]);
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(best_j));
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(best_i));
            // Sheets may have been turned by what was joined.
            for (const std::size_t i : left)
                spokes_[i].forward = spokes_[i].runs_along != sheets_.turns(spokes_[i].face);
        }
    }

    /// Joins as brackets match: a side that opens a solid with the next one that closes it. For crowded edges, where
    /// trying all pairs would take too long.
    void join_nested() {
        std::vector<std::size_t> opened;
        std::vector<std::size_t> unmatched;
        for (std::size_t round = 0; round < 2; ++round)
            for (std::size_t i = 0; i < spokes_.size(); ++i) {
                if (partner_[spokes_[i].h] != none) continue;
                if (!spokes_[i].forward) {
                    if (round == 0) opened.push_back(i);
                } else if (!opened.empty()) {
                    join_spokes(spokes_[i], spokes_[opened.back()]);
                    opened.pop_back();
                }
            }
        for (std::size_t i = 0; i < spokes_.size(); ++i)
            if (partner_[spokes_[i].h] == none) unmatched.push_back(i);
        for (std::size_t i = 0; i + 1 < unmatched.size(); i += 2)
            join_spokes(spokes_[unmatched[i]], spokes_[unmatched[i + 1]]);
    }

    const Complex& complex_;
    Log& log_;
    Edges& edges_;
    Partners& partner_;
    Sheets sheets_{0};
    std::vector<Index> rest_;
    EdgeList open_;  ///< the half-edges with a choice
    std::vector<Spoke> spokes_;
    std::vector<int> angle_;
};

}  // namespace

Joined pair_halfedges(const Complex& complex, Edges& edges, Log& log, const Context* context) {
    return Pairing(complex, edges, log).run(context);
}

}  // namespace delmesh::repairing
