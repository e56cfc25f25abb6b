#include "simplify/least_vertices.hpp"

#include "repair/union_find.hpp"

#include <vector>

namespace delmesh {
namespace {

struct Part {
    long long euler = 0;
    long long loops = 0;
};

/// Which component each vertex with faces belongs to; returns how many there are.
std::size_t number_components(const Mesh& mesh, std::vector<std::size_t>& component) {
    repairing::UnionFind joined(mesh.vertex_count());
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        // Two sides of each face join its corners.
        if (i % 3 < 2 && mesh.origin(h).valid()) joined.unite(mesh.origin(h).value(), mesh.target(h).value());
    }
    component.assign(mesh.vertex_count(), 0);
    std::size_t count = 0;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        if (!mesh.halfedge(VertexId(i)).valid()) continue;
        // The root of a set is its smallest number.
        const std::size_t root = joined.find(static_cast<std::uint32_t>(i));
        component[i] = root == i ? count++ : component[root];
    }
    return count;
}

void count_loop(const Mesh& mesh, HalfedgeId start, Part& part, std::vector<bool>& seen) {
    if (seen[start.index()]) return;
    ++part.loops;
    for (HalfedgeId h = start; !seen[h.index()]; h = mesh.halfedge(mesh.target(h))) seen[h.index()] = true;
}

std::vector<Part> find_parts(const Mesh& mesh) {
    std::vector<std::size_t> component;
    std::vector<Part> parts(number_components(mesh, component));
    std::vector<bool> seen(mesh.halfedge_count());
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
        if (mesh.halfedge(VertexId(i)).valid()) ++parts[component[i]].euler;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        if (!mesh.origin(h).valid()) continue;
        Part& part = parts[component[mesh.origin(h).index()]];
        if (mesh.names_edge(h)) --part.euler;
        if (i % 3 == 0) ++part.euler;
        if (mesh.is_boundary(h)) count_loop(mesh, h, part, seen);
    }
    return parts;
}

/// With n vertices, b of them on the boundary, there are 3 (n - euler) - b edges; no two join the same vertices.
std::size_t least_of(const Part& part) {
    const bool closed = part.loops == 0;
    if (closed && part.euler == -2) return 10;  // 9 have pairs enough, but do not do
    long long n = closed ? 4 : 3 * part.loops;
    while (3 * (n - part.euler) - (closed ? 0 : n) > n * (n - 1) / 2) ++n;
    return static_cast<std::size_t>(n);
}

}  // namespace

std::size_t least_vertices(const Mesh& mesh) {
    std::size_t least = 0;
    for (const Part& part : find_parts(mesh)) least += least_of(part);
    return least;
}

}  // namespace delmesh
