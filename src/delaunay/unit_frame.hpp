#pragma once
// Coordinates in a unit of the mesh's own size, a power of two: no square or product of theirs over- or underflows.

#include "delmesh/mesh/mesh.hpp"

#include <cmath>

namespace delmesh {

struct UnitFrame {
    /// What a coordinate is multiplied by is two to this power.
    int exponent = 0;
    /// In the frame: the largest coordinate, below 1, and the diagonal of the bounding box of the vertices with faces.
    double largest = 0;
    double diagonal = 0;

    [[nodiscard]] Vec3 operator()(const Vec3& p) const {
        return {std::scalbn(p.x, exponent), std::scalbn(p.y, exponent), std::scalbn(p.z, exponent)};
    }
    /// From the frame to the coordinates of the mesh.
    [[nodiscard]] double length(double in_frame) const { return std::scalbn(in_frame, -exponent); }
};

/// Cost: O(vertices).
[[nodiscard]] UnitFrame unit_frame(const Mesh& mesh);

}  // namespace delmesh
