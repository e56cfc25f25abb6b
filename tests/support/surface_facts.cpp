#include "support/surface_facts.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace delmesh::test {

namespace {

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;
/// From each directed edge to the vertex opposite to it.
using EdgeMap = std::map<DirectedEdge, std::uint32_t>;

class UnionFind {
public:
    explicit UnionFind(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
    std::size_t find(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

private:
    std::vector<std::size_t> parent_;
};

std::string edge_name(DirectedEdge e) {
    return std::to_string(e.first) + "-" + std::to_string(e.second);
}

std::string collect_edges(const PolygonSoup& soup, EdgeMap& edges) {
    if (!soup.is_triangles()) return "not a soup of triangles";
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const auto corners = soup.face(f);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = corners[k];
            const std::uint32_t b = corners[(k + 1) % 3];
            if (a >= soup.points.size()) return "face " + std::to_string(f) + " names a vertex that is not there";
            if (a == b) return "face " + std::to_string(f) + " repeats a vertex";
            if (!edges.emplace(DirectedEdge{a, b}, corners[(k + 2) % 3]).second) {
                return "two faces run through " + edge_name({a, b});
            }
        }
    }
    return {};
}

/// Each vertex has one fan: walking round it from one face meets as many faces as it has.
std::string check_fans(const PolygonSoup& soup, const EdgeMap& edges) {
    std::vector<std::size_t> faces_at(soup.points.size(), 0);
    for (const std::uint32_t v : soup.corners) ++faces_at[v];
    for (auto first = edges.begin(); first != edges.end();) {
        const std::uint32_t v = first->first.first;
        // Start where no face lies before, if there is such a place.
        auto start = first;
        for (auto e = first; e != edges.end() && e->first.first == v; ++e) {
            if (!edges.contains({e->first.second, v})) start = e;
        }
        std::size_t met = 0;
        auto walk = start;
        do {
            ++met;
            walk = edges.find({v, walk->second});
        } while (walk != edges.end() && walk != start && met <= faces_at[v]);
        if (met != faces_at[v]) return "the faces at vertex " + std::to_string(v) + " form more than one fan";
        first = edges.lower_bound({v + 1, 0});
    }
    return {};
}

double angle_at(Vec3 apex, Vec3 a, Vec3 b) {
    return std::atan2(norm(cross(a - apex, b - apex)), dot(a - apex, b - apex));
}

void judge_edge(const PolygonSoup& soup, const EdgeMap& edges, const EdgeMap::value_type& edge, SurfaceFacts& facts) {
    constexpr double pi = 3.14159265358979323846;
    constexpr double margin = 1e-9;
    const auto& p = soup.points;
    const auto [a, b] = edge.first;
    const auto twin = edges.find({b, a});
    double angle = angle_at(p[edge.second], p[a], p[b]);
    if (twin == edges.end()) {
        if (angle > pi / 2 + margin) ++facts.non_delaunay_edges;
        return;
    }
    angle += angle_at(p[twin->second], p[a], p[b]);
    if (angle <= pi + margin) return;
    ++facts.non_delaunay_edges;
    if (edges.contains({edge.second, twin->second}) || edges.contains({twin->second, edge.second})) {
        ++facts.unflippable_edges;
    }
}

std::size_t count_boundary_loops(const EdgeMap& edges) {
    std::map<std::uint32_t, std::uint32_t> next;
    for (const auto& edge : edges) {
        const auto [a, b] = edge.first;
        if (!edges.contains({b, a})) next[a] = b;
    }
    std::size_t loops = 0;
    while (!next.empty()) {
        ++loops;
        for (auto e = next.begin(); e != next.end();) {
            const std::uint32_t to = e->second;
            next.erase(e);
            e = next.find(to);
        }
    }
    return loops;
}

}  // namespace

SurfaceFacts examine(const PolygonSoup& soup) {
    SurfaceFacts facts;
    EdgeMap edges;
    facts.fault = collect_edges(soup, edges);
    if (facts.fault.empty()) facts.fault = check_fans(soup, edges);
    if (!facts.fault.empty()) return facts;

    facts.faces = soup.face_count();
    UnionFind parts(soup.points.size());
    std::vector<bool> used(soup.points.size(), false);
    for (const auto& edge : edges) {
        const auto [a, b] = edge.first;
        used[a] = true;
        parts.unite(a, b);
        const bool boundary = !edges.contains({b, a});
        if (boundary) ++facts.boundary_edges;
        if (!boundary && a > b) continue;
        ++facts.edges;
        judge_edge(soup, edges, edge, facts);
    }
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (!used[v]) continue;
        ++facts.used_vertices;
        if (parts.find(v) == v) ++facts.components;
    }
    facts.boundary_loops = count_boundary_loops(edges);
    facts.euler = static_cast<long long>(facts.used_vertices) - static_cast<long long>(facts.edges) +
                  static_cast<long long>(facts.faces);
    for (std::size_t f = 0; f < facts.faces; ++f) {
        const auto c = soup.face(f);
        facts.volume6 += dot(soup.points[c[0]], cross(soup.points[c[1]], soup.points[c[2]]));
    }
    return facts;
}

std::uint64_t hash_bits(const PolygonSoup& soup) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto add = [&hash](std::uint64_t value) {
        for (unsigned byte = 0; byte < 8; ++byte) {
            hash = (hash ^ ((value >> (8 * byte)) & 0xffU)) * 0x100000001b3U;
        }
    };
    for (const Vec3& p : soup.points) {
        for (int axis = 0; axis < 3; ++axis) add(std::bit_cast<std::uint64_t>(p[axis]));
    }
    for (const std::uint32_t v : soup.corners) add(v);
    return hash;
}

}  // namespace delmesh::test
