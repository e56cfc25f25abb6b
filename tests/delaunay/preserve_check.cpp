#include "delaunay/preserve_check.hpp"

#include "delmesh/exact/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <vector>

namespace delmesh::test {
namespace {

using Ends = std::pair<VertexId, VertexId>;

Ends ends_of(VertexId a, VertexId b) {
    return a < b ? Ends{a, b} : Ends{b, a};
}

template <class... Parts>
std::string say(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    return text.str();
}

double largest_coordinate(const Mesh& mesh) {
    double largest = 0;
    for (const Vec3& p : mesh.points())
        for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::fabs(p[axis]));
    return largest;
}

/// Distances are measured on coordinates divided by the largest one, so that no scale over- or underflows.
struct Scaled {
    const Mesh& mesh;
    double unit;
    [[nodiscard]] Vec3 at(VertexId v) const {
        const Vec3& p = mesh.point(v);
        return {p.x / unit, p.y / unit, p.z / unit};
    }
    [[nodiscard]] double area(FaceId f) const {
        const HalfedgeId h = Mesh::halfedge(f);
        const Vec3 a = at(mesh.origin(h));
        return 0.5 * norm(cross(at(mesh.target(h)) - a, at(mesh.apex(h)) - a));
    }
};

long long euler(const Mesh& mesh) {
    const std::set<VertexId> used(mesh.corners().begin(), mesh.corners().end());
    return static_cast<long long>(used.size()) - static_cast<long long>(mesh.count_edges()) +
           static_cast<long long>(mesh.face_count());
}

std::size_t boundary_loops(const Mesh& mesh) {
    std::map<VertexId, VertexId> next;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (mesh.is_boundary(h)) next[mesh.origin(h)] = mesh.target(h);
    }
    std::size_t loops = 0;
    while (!next.empty()) {
        ++loops;
        VertexId at = next.begin()->first;
        while (next.contains(at)) {
            const VertexId to = next[at];
            next.erase(at);
            at = to;
        }
    }
    return loops;
}

std::string check_vertices(const Mesh& before, const Mesh& after, const Provenance& from, double slack) {
    if (from.input_vertices != before.vertex_count()) return "the number of input vertices is wrong";
    if (from.splits.size() + from.input_vertices != after.vertex_count()) return "the splits do not match the vertices";
    for (std::size_t v = 0; v < before.vertex_count(); ++v)
        if (std::memcmp(&before.points()[v], &after.points()[v], sizeof(Vec3)) != 0)
            return say("input vertex ", v, " has moved");
    const Scaled scaled{after, largest_coordinate(before)};
    for (std::size_t i = 0; i < from.splits.size(); ++i) {
        const SplitPoint& split = from.splits[i];
        if (!(split.a < split.b && split.t > 0 && split.t < 1)) return say("split ", i, " is not inside an edge");
        if (!before.are_joined(split.a, split.b)) return say("split ", i, " is not on an input edge");
        const Vec3 expected = scaled.at(split.a) * (1 - split.t) + scaled.at(split.b) * split.t;
        const Vec3 found = scaled.at(VertexId(from.input_vertices + i));
        if (norm(found - expected) > slack) return say("split ", i, " is ", norm(found - expected), " off its edge");
    }
    return {};
}

/// Input edges between different facets, and boundary edges.
std::set<Ends> physical_edges(const Mesh& before, const Provenance& from) {
    std::set<Ends> physical;
    for (std::size_t i = 0; i < before.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        const HalfedgeId t = before.twin(h);
        if (t.valid() && is_planar_edge(before.point(before.origin(h)), before.point(before.target(h)),
                                        before.point(before.apex(h)), before.point(before.apex(t)))) {
            if (from.facet_of_input_face[h.index() / 3] != from.facet_of_input_face[t.index() / 3])
                physical.insert(Ends{});  // a planar edge between two facets: never right
            continue;
        }
        physical.insert(ends_of(before.origin(h), before.target(h)));
    }
    return physical;
}

std::string check_tiling(const Mesh& before, const Mesh& after, const Provenance& from) {
    const std::set<Ends> physical = physical_edges(before, from);
    if (physical.contains(Ends{})) return "a planar edge parts two facets";
    std::map<Ends, std::vector<std::pair<double, VertexId>>> on_edge;
    for (const Ends& ends : physical) on_edge[ends] = {{0.0, ends.first}, {1.0, ends.second}};
    for (std::size_t i = 0; i < from.splits.size(); ++i) {
        const auto found = on_edge.find({from.splits[i].a, from.splits[i].b});
        // Elsewhere it lies on a planar input edge, as happens where a surface touches itself.
        if (found != on_edge.end()) found->second.emplace_back(from.splits[i].t, VertexId(from.input_vertices + i));
    }
    for (auto& [ends, chain] : on_edge) {
        std::sort(chain.begin(), chain.end());
        for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            if (!after.are_joined(chain[i].second, chain[i + 1].second))
                return say("the edge ", ends.first.value(), "-", ends.second.value(), " is not tiled");
    }
    return {};
}

std::string check_facets(const Mesh& before, const Mesh& after, const Provenance& from, double slack) {
    if (from.facet_of_face.size() != after.face_count()) return "not every face knows its facet";
    if (from.facet_of_input_face.size() != before.face_count()) return "not every input face knows its facet";
    // Which facets hold a vertex: those of its input faces, or those at its input edge.
    std::map<Ends, std::set<FaceId>> at_edge;
    std::vector<std::set<FaceId>> at_vertex(before.vertex_count());
    for (std::size_t i = 0; i < before.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        const FaceId facet = from.facet_of_input_face[i / 3];
        at_edge[ends_of(before.origin(h), before.target(h))].insert(facet);
        at_vertex[before.origin(h).index()].insert(facet);
    }
    const Scaled old_scale{before, largest_coordinate(before)};
    const Scaled new_scale{after, old_scale.unit};
    std::map<FaceId, double> area;
    double total = 0;
    for (std::size_t f = 0; f < before.face_count(); ++f) {
        area[from.facet_of_input_face[f]] += old_scale.area(FaceId(f));
        total += old_scale.area(FaceId(f));
    }
    for (std::size_t f = 0; f < after.face_count(); ++f) {
        const FaceId facet = from.facet_of_face[f];
        area[facet] -= new_scale.area(FaceId(f));
        for (std::size_t k = 0; k < 3; ++k) {
            const VertexId v = after.corners()[3 * f + k];
            const bool input = v.index() < from.input_vertices;
            const SplitPoint split = input ? SplitPoint{} : from.splits[v.index() - from.input_vertices];
            if (!(input ? at_vertex[v.index()] : at_edge[{split.a, split.b}]).contains(facet))
                return say("face ", f, " has a corner outside its facet ", facet.value());
        }
    }
    for (const auto& [facet, left] : area)
        if (std::fabs(left) > 100 * slack * (1 + total))
            return say("facet ", facet.value(), " differs in area by ", left);
    return {};
}

}  // namespace

std::string check_delaunay(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        const HalfedgeId t = mesh.twin(h);
        const Vec3& p = mesh.point(mesh.origin(h));
        const Vec3& q = mesh.point(mesh.target(h));
        const Vec3& u = mesh.point(mesh.apex(h));
        const Sign sign = t.valid() ? delaunay_sign(p, q, u, mesh.point(mesh.apex(t))) : right_angle_sign(p, q, u);
        if (sign == Sign::negative) return say("half-edge ", i, " is not Delaunay");
    }
    return {};
}

std::string check_preserved(const Mesh& before, const Mesh& after, const Provenance& provenance, double slack) {
    if (euler(before) != euler(after)) return "the Euler number has changed";
    if (boundary_loops(before) != boundary_loops(after)) return "the number of boundary loops has changed";
    if (std::string bad = check_vertices(before, after, provenance, slack); !bad.empty()) return bad;
    if (std::string bad = check_tiling(before, after, provenance); !bad.empty()) return bad;
    return check_facets(before, after, provenance, slack);
}

}  // namespace delmesh::test
