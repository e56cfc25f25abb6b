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

/// All zero for a mesh without faces.
struct AngleStatistics {
    double min_angle_deg = 0;
    double max_angle_deg = 0;
    double small_angles_percent = 0;  ///< face angles below 30 degrees, of all face angles
    double large_angles_percent = 0;  ///< face angles above 120 degrees, of all face angles
};

/// Cost: O(vertices + faces).
[[nodiscard]] MeshSize measure_size(const Mesh& mesh);

/// The angles of all faces, at any scale of the coordinates (1e-300, 1e+300, denormals). The two percentages are exact
/// counts: an angle of exactly 30 or 120 degrees is not counted. The extremes are within a few 1e-14 degrees. A
/// zero-area face has the angles 0, 0, 180 of its limit; with two corners in one place 0, 90, 90; with all three in
/// one place 0, 0, 180. Parallel; the result does not depend on the number of threads. A cancelled call returns what
/// it would for the faces it has seen. Cost: O(faces), about 30 ns per face on one core.
[[nodiscard]] AngleStatistics measure_angles(const Mesh& mesh, const Context* context = nullptr);

/// The diagonal of the bounding box of all vertices that have a face; 0 for a mesh without faces, infinity if it is not
/// a double. Cost: O(vertices).
[[nodiscard]] double bounding_diagonal(const Mesh& mesh);

}  // namespace delmesh
