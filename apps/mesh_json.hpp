#pragma once
// Meshes in numbers: measured once, shown as JSON or as a table.

#include "console.hpp"
#include "delmesh/measure/certificate.hpp"
#include "delmesh/measure/statistics.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <string>
#include <vector>

namespace delmesh::app {

struct Measured {
    MeshSize size;
    Certificate certificate;
    AngleStatistics angles;
    /// The ends of certificate.worst_edge.
    std::vector<std::size_t> worst_edge;
};

[[nodiscard]] Measured measure(const Mesh& mesh, const Context* context);

/// {"mesh":{...},"delaunay":{...},"quality":{...}} as DESIGN and docs/cli.md lay down.
[[nodiscard]] Json to_json(const Measured& measured);

/// One line that says whether the mesh is Delaunay, and if not, where it fails most.
[[nodiscard]] std::string verdict(const Measured& measured);

/// The rows "vertices", "edges", ... with a column for each mesh.
[[nodiscard]] std::string comparison_table(const std::vector<std::string>& titles,
                                           const std::vector<Measured>& columns);

}  // namespace delmesh::app
