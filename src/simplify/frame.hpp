#pragma once
// Local coordinates: near the origin and of about unit size, wherever and however large the mesh is.

#include "delmesh/base/vec3.hpp"
#include "delmesh/mesh/mesh.hpp"

namespace delmesh {

struct Frame {
    double scale = 1;    ///< a power of two
    double inverse = 1;  ///< 1 / scale
    Vec3 origin;         ///< in the mesh's space

    [[nodiscard]] Vec3 to_local(const Vec3& p) const { return (p - origin) * scale; }
    [[nodiscard]] Vec3 to_mesh(const Vec3& p) const { return p * inverse + origin; }
};

/// The power of two that brings the mesh to about unit size.
[[nodiscard]] double local_scale(const Mesh& mesh);

}  // namespace delmesh
