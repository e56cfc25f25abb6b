#pragma once
// Sizes and angle statistics: the columns of Table 1 of the paper.

#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"

namespace delmesh {

struct MeshSize {
    std::size_t vertices = 0;  ///< all of them, isolated ones too
    std::size_t edges = 0;
    std::size_t faces = 0;
    std::size_t boundary_edges = 0;
    std::size_t components = 0;  ///< connected by shared vertices; isolated vertices do not count
    long long euler = 0;         ///< V - E + F over the vertices that have faces
};

struct AngleStatistics {
    double min_angle_deg = 0;
    double max_angle_deg = 0;
    double small_angles_percent = 0;  ///< face angles below 30 degrees
    double large_angles_percent = 0;  ///< face angles above 120 degrees
};

[[nodiscard]] MeshSize measure_size(const Mesh& mesh);

/// Parallel; the result does not depend on the number of threads.
[[nodiscard]] AngleStatistics measure_angles(const Mesh& mesh, const Context* context = nullptr);

/// The diagonal of the bounding box of all vertices that have a face; 0 for a mesh without faces.
[[nodiscard]] double bounding_diagonal(const Mesh& mesh);

}  // namespace delmesh
