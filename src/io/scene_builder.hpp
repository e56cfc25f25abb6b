#pragma once
// Meshes that stand, perhaps many times, in a scene become one soup.

#include "delmesh/mesh/polygon_soup.hpp"
#include "io/transform.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace delmesh::io {

/// A mesh that is used again and again costs nothing in the file, but memory here. So the scene may not have more
/// corners and points together than a generous multiple of the file's bytes.
class SceneBuilder {
public:
    /// `name` stands in messages.
    SceneBuilder(std::string name, std::uint64_t file_bytes);
    /// Tells that there are more bytes: files may name others.
    void set_file_bytes(std::uint64_t file_bytes);

    [[nodiscard]] PolygonSoup& soup() { return soup_; }

    /// To be called before `elements` of the file are taken for the scene. Throws `Error` (file_format) where that are
    /// too many in all.
    void expect(std::uint64_t elements);
    /// How many that may be yet.
    [[nodiscard]] std::uint64_t left() const { return allowed_ - taken_; }
    /// Appends a mesh of triangles; a transform that mirrors turns their corners. Throws `Error` (too_large).
    void add_mesh(std::span<const Vec3> points, std::span<const std::uint32_t> corners, const Transform& transform);

private:
    std::string name_;
    std::uint64_t allowed_ = 0;
    std::uint64_t taken_ = 0;
    PolygonSoup soup_;
};

}  // namespace delmesh::io
