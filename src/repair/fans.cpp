// One vertex for each fan of faces. Fans follow from which half-edges are partners, so nothing is left to choose, but
// for one thing: a fan that passes the same edge twice would need two edges between the same two vertices. There the
// partners are exchanged, which parts the fan in two at both ends of the edge and leaves nobody alone.

#include "repair/complex.hpp"
#include "repair/union_find.hpp"

#include <algorithm>

namespace delmesh::repairing {
namespace {

class FanSeparator {
public:
    FanSeparator(Complex& complex, const EdgeGroups& groups, Partners& partners, Log& log)
        : complex_(complex),
          groups_(groups),
          partners_(partners),
          log_(log) {}

    void run() {
        name_fans();
        for (std::size_t g = 0; g < groups_.size(); ++g)
            if (groups_[g].size() > 2) part_double_edges(groups_[g]);
        number_vertices();
    }

private:
    /// `fan_` of a corner: a number that the corners of its fan share.
    void name_fans() {
        UnionFind sets(complex_.halfedge_count());
        for (Index h = 0; h < partners_.size(); ++h) {
            const Index g = partners_[h];
            if (g == none || g < h) continue;
            sets.unite(h, Complex::next(g));
            sets.unite(Complex::next(h), g);
        }
        fan_ = sets.number_sets();
        for (const Index fan : fan_) next_fan_ = std::max(next_fan_, fan + 1);
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

    void part_double_edges(std::span<const Index> group) {
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

    /// Walks over the corners of a fan, first one way round, then the other.
    class Walk {
    public:
        Walk(const Partners& partners, Index corner) : partners_(partners), start_(corner), seen_{corner} {}

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
        Index start_;
        Index back_ = none;
        bool forward_ = true;
        std::vector<Index> seen_;
    };

    /// Two corners were of one fan, which is parted now: the smaller part gets a new name, so that naming costs
    /// O(n log n) in all.
    void rename_smaller(Index a, Index b) {
        Walk from_a(partners_, a);
        Walk from_b(partners_, b);
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

    /// Each fan gets the smallest vertex number that its corners had; where several fans want the same, the first one
    /// gets it and the others get copies.
    void number_vertices() {
        std::vector<Index> smallest(next_fan_, none);
        for (Index h = 0; h < fan_.size(); ++h) smallest[fan_[h]] = std::min(smallest[fan_[h]], complex_.corners[h]);
        std::vector<Index> number(next_fan_, none);
        std::vector<char> taken(complex_.points.size(), 0);
        for (Index h = 0; h < fan_.size(); ++h) {
            Index& v = number[fan_[h]];
            if (v != none) continue;
            v = smallest[fan_[h]];
            if (taken[v] != 0)
                v = copy_vertex(v, taken);
            else
                taken[v] = 1;
        }
        for (Index h = 0; h < fan_.size(); ++h) complex_.corners[h] = number[fan_[h]];
    }

    Index copy_vertex(Index v, std::vector<char>& taken) {
        if (taken[v] == 1) log_.add(Defect::non_manifold_vertex, complex_.source[v]);
        taken[v] = 2;
        // By value: the arrays may move.
        const Vec3 point = complex_.points[v];
        const Index place = complex_.place[v];
        const Index source = complex_.source[v];
        complex_.points.push_back(point);
        complex_.place.push_back(place);
        complex_.source.push_back(source);
        return static_cast<Index>(complex_.points.size() - 1);
    }

    Complex& complex_;
    const EdgeGroups& groups_;
    Partners& partners_;
    Log& log_;
    std::vector<Index> fan_;
    Index next_fan_ = 0;
};

}  // namespace

void separate_fans(Complex& complex, const EdgeGroups& groups, Partners& partners, Log& log) {
    FanSeparator(complex, groups, partners, log).run();
}

}  // namespace delmesh::repairing
