#pragma once
// What a mesh file can hold: points and polygons, with no promise about how they fit together.

#include "delmesh/base/vec3.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace delmesh {

/// The precision in which numbers are stored in a file (and in which new vertices are rounded when they are made).
enum class Precision { float32, float64 };

/// "float" and "double", as on the command line.
[[nodiscard]] std::span<const std::string_view> choices(Precision);

/// Points and polygons. Faces are stored one after another in `corners`; face f is
/// `corners[starts[f]] ... corners[starts[f+1]-1]`. An empty `starts` means that all faces are triangles.
struct PolygonSoup {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> corners;
    std::vector<std::size_t> starts;
    /// Line elements (OBJ `l`): pairs of point indices, used as feature edges.
    std::vector<std::array<std::uint32_t, 2>> lines;
    /// What the coordinates were stored in: `float32` if every one of them came from 32 bits.
    Precision stored = Precision::float64;

    [[nodiscard]] bool is_triangles() const { return starts.empty(); }
    [[nodiscard]] std::size_t face_count() const { return starts.empty() ? corners.size() / 3 : starts.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t f) const {
        if (starts.empty()) return {corners.data() + 3 * f, 3};
        return {corners.data() + starts[f], starts[f + 1] - starts[f]};
    }
    void add_face(std::span<const std::uint32_t> polygon);
};

/// Splits every polygon into triangles (faces with fewer than three corners are left out), in place; triangles stay as
/// they are. A polygon becomes the fan about its first corner, as in nearly every program, so that all see the same
/// surface where it is not flat. If that would fold over (the polygon is concave or has a flat corner), its ears are
/// clipped in its mean plane, those with large angles first; and if that fails too (self-crossing, degenerate, above
/// 1,000 corners), it becomes the fan all the same.
/// Cost: O(corners) for fans, O(n^2) for an n-gon whose ears are clipped.
void triangulate(PolygonSoup& soup);

}  // namespace delmesh
