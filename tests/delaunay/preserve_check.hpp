#pragma once
// What `preserve` promises, checked from the outside: by positions and provenance alone.

#include "delmesh/delaunay/provenance.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <string>

namespace delmesh::test {

/// Empty if every edge is Delaunay, decided by the exact predicates one edge at a time; else names one that is not.
[[nodiscard]] std::string check_delaunay(const Mesh& mesh);

/// Empty if the output keeps the input's surface: input vertices bit for bit and first; every split point on its input
/// edge; each physical input edge tiled end to end by output edges; every output face spanned by points of one facet,
/// facet areas equal; Euler number and boundary loops as before. `slack` is relative to the largest coordinate.
/// The input must not hold zero-area faces.
[[nodiscard]] std::string check_preserved(const Mesh& before, const Mesh& after, const Provenance& provenance,
                                          double slack);

}  // namespace delmesh::test
