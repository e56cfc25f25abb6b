#include "delaunay/non_delaunay.hpp"

#include "base/parallel.hpp"

#include <cstdint>

namespace delmesh {

std::vector<HalfedgeId> find_non_delaunay(const Mesh& mesh, const Context* context) {
    std::vector<std::uint8_t> bad(mesh.halfedge_count(), 0);
    parallel_blocks(bad.size(), context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const HalfedgeId h(i);
            if (mesh.names_edge(h)) bad[i] = is_non_delaunay(mesh, h) ? 1 : 0;
        }
    });
    std::vector<HalfedgeId> found;
    for (std::size_t i = 0; i < bad.size(); ++i)
        if (bad[i] != 0) found.emplace_back(i);
    return found;
}

}  // namespace delmesh
