#include "repair/lines.hpp"

#include <algorithm>
#include <set>
#include "base/sort_unique.hpp"

namespace delmesh::repairing {
namespace {

using Line = std::array<Index, 2>;

class LineCarrier {
public:
    LineCarrier(const PolygonSoup& soup, const Complex& complex, const std::vector<Index>& number)
        : soup_(soup),
          complex_(complex),
          number_(number) {
        find_edges();
        find_first_vertices();
    }

    std::vector<Line> run(Log& log) {
        for (std::size_t i = 0; i < soup_.lines.size(); ++i) {
            const std::size_t before = lines_.size();
            carry(soup_.lines[i]);
            if (lines_.size() == before) log.add(Defect::stray_line, i);
        }
        return std::move(lines_);
    }

private:
    struct Edge {
        Line places;  ///< ascending
        Line ends;    ///< vertices of the complex, in the order of their places
        friend auto operator<=>(const Edge&, const Edge&) = default;
    };

    [[nodiscard]] bool is_possible(const Line& line) const {
        const std::size_t n = soup_.points.size();
        return line[0] < n && line[1] < n && complex_.place(line[0]) != complex_.place(line[1]);
    }

    [[nodiscard]] Edge edge(Index a, Index b) const {
        if (complex_.place(b) < complex_.place(a)) std::swap(a, b);
        return {{complex_.place(a), complex_.place(b)}, {a, b}};
    }

    /// The edges at the places of lines, each once, sorted.
    void find_edges() {
        std::vector<char> wanted(complex_.points.size(), 0);
        for (const Line& line : soup_.lines)
            if (is_possible(line)) wanted[complex_.place(line[0])] = wanted[complex_.place(line[1])] = 1;
        for (Index h = 0; h < complex_.halfedge_count(); ++h)
            if (wanted[complex_.place_from(h)] != 0 && wanted[complex_.place_to(h)] != 0)
                edges_.push_back(edge(complex_.from(h), complex_.to(h)));
        sort_unique(edges_);
    }

    void find_first_vertices() {
        first_at_.assign(complex_.points.size(), none);
        for (Index v = static_cast<Index>(number_.size()); v-- > 0;)
            if (number_[v] != none) first_at_[complex_.place(v)] = v;
    }

    void carry(const Line& line) {
        if (!is_possible(line)) return;
        const Edge wanted = edge(line[0], line[1]);
        const bool backwards = wanted.ends[0] != line[0];
        const auto first = std::lower_bound(edges_.begin(), edges_.end(), Edge{wanted.places, {0, 0}});
        const auto last = std::upper_bound(first, edges_.end(), Edge{wanted.places, {none, none}});
        const auto is_exact = [&](const Edge& e) {
            return complex_.source(e.ends[0]) == wanted.ends[0] && complex_.source(e.ends[1]) == wanted.ends[1];
        };
        const bool exact = std::any_of(first, last, is_exact);
        for (auto e = first; e != last; ++e)
            if (!exact || is_exact(*e)) add(e->ends, backwards);
        if (first == last) add({kept(wanted.ends[0]), kept(wanted.ends[1])}, backwards);
    }

    /// The vertex itself if it was kept, else the first at its place.
    [[nodiscard]] Index kept(Index v) const { return number_[v] != none ? v : first_at_[complex_.place(v)]; }

    void add(Line ends, bool backwards) {
        if (ends[0] == none || ends[1] == none) return;
        Line line{number_[ends[0]], number_[ends[1]]};
        if (!seen_.insert({std::min(line[0], line[1]), std::max(line[0], line[1])}).second) return;
        if (backwards) std::swap(line[0], line[1]);
        lines_.push_back(line);
    }

    const PolygonSoup& soup_;
    const Complex& complex_;
    const std::vector<Index>& number_;
    std::vector<Edge> edges_;
    std::vector<Index> first_at_;
    std::set<Line> seen_;
    std::vector<Line> lines_;
};

}  // namespace

std::vector<std::array<Index, 2>> carry_lines(const PolygonSoup& soup, const Complex& complex,
                                              const std::vector<Index>& number, Log& log) {
    if (soup.lines.empty()) return {};
    return LineCarrier(soup, complex, number).run(log);
}

}  // namespace delmesh::repairing
