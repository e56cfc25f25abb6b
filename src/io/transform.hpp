#pragma once
// Affine maps, of which scenes are built.

#include "delmesh/base/vec3.hpp"

#include <array>

namespace delmesh::io {

/// The images of the three axes, and of the origin.
struct Transform {
    std::array<Vec3, 4> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, 0}};

    [[nodiscard]] Vec3 turn(const Vec3& p) const { return columns[0] * p.x + columns[1] * p.y + columns[2] * p.z; }
    [[nodiscard]] Vec3 operator()(const Vec3& p) const { return turn(p) + columns[3]; }
    [[nodiscard]] Transform operator*(const Transform& inner) const {
        return {{turn(inner.columns[0]), turn(inner.columns[1]), turn(inner.columns[2]), (*this)(inner.columns[3])}};
    }
    [[nodiscard]] bool is_identity() const { return columns == Transform().columns; }
    /// Turns surfaces inside out: the corners of faces are to be taken the other way round.
    [[nodiscard]] bool mirrors() const { return dot(cross(columns[0], columns[1]), columns[2]) < 0; }
};

}  // namespace delmesh::io
