#pragma once
// What a triangle soup is as a surface, found the slow and plain way (an edge map), independent of the library's mesh.

#include "delmesh/mesh/polygon_soup.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace delmesh::test {

struct SurfaceFacts {
    /// Empty for an oriented 2-manifold with boundary; else a sentence about the first fault found.
    std::string fault;
    std::size_t used_vertices = 0;
    std::size_t edges = 0;
    std::size_t faces = 0;
    std::size_t boundary_edges = 0;
    std::size_t boundary_loops = 0;
    std::size_t components = 0;
    /// Over the vertices that have faces.
    long long euler = 0;
    /// Interior edges whose opposite angles sum to more than pi, boundary edges whose angle is over pi/2, by more than
    /// 1e-9 rad (in floating point: a guide, not a certificate).
    std::size_t non_delaunay_edges = 0;
    /// Edges among them whose flip would join two vertices that are joined already.
    std::size_t unflippable_edges = 0;
    /// Six times the enclosed volume; above zero where a closed surface is oriented outwards.
    double volume6 = 0;
};

[[nodiscard]] SurfaceFacts examine(const PolygonSoup& soup);

/// FNV-1a of all coordinates' bits and all indices.
[[nodiscard]] std::uint64_t hash_bits(const PolygonSoup& soup);

}  // namespace delmesh::test
