// One vertex for each fan of faces. Fans follow from which half-edges are partners, so nothing is left to choose, but
// for one thing: a fan that passes the same edge twice would need two edges between the same two vertices. There the
// partners are exchanged, which parts the fan in two at both ends of the edge and leaves nobody alone.

#include "base/let_go.hpp"
#include "repair/complex.hpp"

#include <algorithm>

namespace delmesh::repairing {
namespace {

/// Walks over the corners of a fan, first one way round, then the other.
class Walk {
public:
    explicit Walk(const Partners& partners) : partners_(partners) {}

    void start(Index corner) {
        start_ = corner;
        forward_ = true;
        seen_.assign(1, corner);
    }
    /// False once all corners were seen.
    bool step() {
        if (forward_) {
            const Index next = partners_[Complex::prev(seen_.back())];
            if (next == start_) return false;
            if (next != none) {
                seen_.push_back(next);
                return true;
            }
            forward_ = false;
            back_ = start_;
        }
        const Index other = partners_[back_];
        if (other == none) return false;
        back_ = Complex::next(other);
        seen_.push_back(back_);
        return true;
    }
    [[nodiscard]] const std::vector<Index>& seen() const { return seen_; }

private:
    const Partners& partners_;
    Index start_ = none;
    Index back_ = none;
    bool forward_ = true;
    std::vector<Index> seen_;
};

class FanSeparator {
public:
    FanSeparator(Complex& complex, Partners& partners, Log& log) : complex_(complex), partners_(partners), log_(log) {}

    /// Exchanges partners at edges that would be there twice.
    void part_double_edges(EdgeList& crowded) {
        fan_.resize(complex_.halfedge_count());
        visit_fans([&](const std::vector<Index>& corners) {
            for (const Index corner : corners) fan_[corner] = next_fan_;
            ++next_fan_;
        });
        for (std::size_t e = 0; e < crowded.size(); ++e) part_at(crowded[e]);
        let_go(fan_);
    }

    /// Each fan gets the smallest vertex number that its corners had; where several fans want the same, the first one
    /// gets it and the others get copies.
    void number_vertices() {
        std::vector<char> taken(complex_.vertex_count(), 0);
        visit_fans([&](const std::vector<Index>& corners) {
            Index v = none;
            for (const Index corner : corners) v = std::min(v, complex_.corners[corner]);
            if (taken[v] != 0)
                v = copy_vertex(v, taken);
            else
                taken[v] = 1;
            for (const Index corner : corners) complex_.corners[corner] = v;
        });
    }

private:
    /// Calls visitor(corners) for each fan, in the order of their first corners.
    template <class Visitor>
    void visit_fans(Visitor&& visitor) const {
        std::vector<bool> seen(partners_.size(), false);
        Walk walk(partners_);
        for (Index corner = 0; corner < seen.size(); ++corner) {
            if (seen[corner]) continue;
            walk.start(corner);
            while (walk.step()) {
            }
            for (const Index other : walk.seen()) seen[other] = true;
            visitor(walk.seen());
        }
    }

    /// An edge of the mesh to be, at a place where there are several: one or two half-edges.
    struct Edge {
        Index along = none;
        Index against = none;
    };

    [[nodiscard]] std::pair<Index, Index> ends(const Edge& e) const {
        if (e.along != none) return {fan_[e.along], fan_[Complex::next(e.along)]};
        return {fan_[Complex::next(e.against)], fan_[e.against]};
    }

    void part_at(std::span<const Index> group) {
        std::vector<Edge> edges = collect_edges(group);
        const auto in_order = [&](const Edge& a, const Edge& b) { return ends(a) < ends(b); };
        for (bool again = true; again;) {
            again = false;
            std::stable_sort(edges.begin(), edges.end(), in_order);
            for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
                if (ends(edges[i]) != ends(edges[i + 1])) continue;
                exchange(edges[i], edges[i + 1]);
                again = true;
            }
        }
    }

    [[nodiscard]] std::vector<Edge> collect_edges(std::span<const Index> group) const {
        std::vector<Edge> edges;
        for (const Index h : group) {
            const bool is_along = !complex_.opposite(h, group[0]);
            if (partners_[h] != none && !is_along) continue;
            edges.push_back(is_along ? Edge{h, partners_[h]} : Edge{none, h});
        }
        return edges;
    }

    void exchange(Edge& a, Edge& b) {
        // Two lone half-edges of one fan would run in opposite directions, and such are partners.
        std::swap(a.against, b.against);
        for (const Edge* e : {&a, &b}) {
            if (e->along != none) partners_[e->along] = e->against;
            if (e->against != none) partners_[e->against] = e->along;
        }
        const auto start = [](const Edge& e) { return e.along != none ? e.along : Complex::next(e.against); };
        const auto end = [](const Edge& e) { return e.along != none ? Complex::next(e.along) : e.against; };
        rename_smaller(start(a), start(b));
        rename_smaller(end(a), end(b));
    }

    /// Two corners were of one fan, which is parted now: the smaller part gets a new name, so that naming costs
    /// O(n log n) in all.
    void rename_smaller(Index a, Index b) {
        Walk from_a(partners_);
        Walk from_b(partners_);
        from_a.start(a);
        from_b.start(b);
        bool a_ended = false;
        while (true) {
            if (!from_a.step()) {
                a_ended = true;
                break;
            }
            if (!from_b.step()) break;
        }
        for (const Index corner : (a_ended ? from_a : from_b).seen()) fan_[corner] = next_fan_;
        ++next_fan_;
    }

    Index copy_vertex(Index v, std::vector<char>& taken) {
        const Index source = complex_.source(v);
        if (taken[v] == 1) log_.add(Defect::non_manifold_vertex, source);
        taken[v] = 2;
        complex_.copied.push_back(source);
        return static_cast<Index>(complex_.vertex_count() - 1);
    }

    Complex& complex_;
    Partners& partners_;
    Log& log_;
    std::vector<Index> fan_;  ///< of a corner: a number that the corners of its fan share
    Index next_fan_ = 0;
};

}  // namespace

void separate_fans(Complex& complex, Joined& joined, Log& log) {
    FanSeparator separator(complex, joined.partners, log);
    if (joined.crowded.size() > 0) separator.part_double_edges(joined.crowded);
    separator.number_vertices();
}

}  // namespace delmesh::repairing
