#include "delmesh/mesh/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace delmesh {
namespace {

/// Each check returns a sentence for the first violation, or nothing.
std::string check_halfedges(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (!mesh.is_live(Mesh::face(h))) {
            if (mesh.origin(h).valid() || mesh.twin(h).valid()) return fmt::format("half-edge {} is half dead", i);
            continue;
        }
        if (!mesh.origin(h).valid() || mesh.origin(h).index() >= mesh.vertex_count())
            return fmt::format("half-edge {} has no origin", i);
        if (!mesh.is_live(mesh.origin(h))) return fmt::format("half-edge {} leaves a dead vertex", i);
        if (mesh.origin(h) == mesh.target(h)) return fmt::format("half-edge {} is a loop", i);
        const HalfedgeId t = mesh.twin(h);
        if (!t.valid()) continue;
        if (t.index() >= mesh.halfedge_count() || mesh.twin(t) != h || t == h)
            return fmt::format("half-edge {} and its twin disagree", i);
        if (mesh.origin(t) != mesh.target(h) || mesh.target(t) != mesh.origin(h))
            return fmt::format("half-edge {} and its twin join different vertices", i);
    }
    return {};
}

std::string check_simple(const Mesh& mesh) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (!mesh.is_live(Mesh::face(h)) || !mesh.names_edge(h)) continue;
        const std::uint32_t a = mesh.origin(h).value();
        const std::uint32_t b = mesh.target(h).value();
        edges.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(edges.begin(), edges.end());
    const auto twice = std::adjacent_find(edges.begin(), edges.end());
    if (twice == edges.end()) return {};
    return fmt::format("vertices {} and {} are joined by two edges", (*twice)[0], (*twice)[1]);
}

std::string check_fans(const Mesh& mesh) {
    std::vector<std::size_t> valence(mesh.vertex_count(), 0);
    for (const VertexId v : mesh.corners())
        if (v.valid()) ++valence[v.index()];
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const VertexId v(i);
        const HalfedgeId start = mesh.halfedge(v);
        if (!start.valid()) {
            if (valence[i] != 0) return fmt::format("vertex {} has faces but no half-edge", i);
            continue;
        }
        if (start.index() >= mesh.halfedge_count() || mesh.origin(start) != v)
            return fmt::format("the half-edge of vertex {} does not leave it", i);
        std::size_t seen = 0;
        HalfedgeId at = start;
        while (at.valid() && seen <= valence[i]) {
            ++seen;
            at = mesh.next_around(at);
            if (at == start) break;
        }
        if (seen != valence[i]) return fmt::format("the fan of vertex {} misses some of its faces", i);
        if (at == start && mesh.is_boundary(start)) return fmt::format("the fan of vertex {} is broken", i);
    }
    return {};
}

std::string check_points(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
        if (mesh.is_live(VertexId(i)) && !is_finite(mesh.point(VertexId(i))))
            return fmt::format("vertex {} is not finite", i);
    return {};
}

}  // namespace

std::string validate(const Mesh& mesh) {
    for (const auto check : {check_halfedges, check_simple, check_fans, check_points})
        if (std::string sentence = check(mesh); !sentence.empty()) return sentence;
    return {};
}

}  // namespace delmesh
