#pragma once

#include "delmesh/mesh/polygon_soup.hpp"

#include <filesystem>
#include <optional>
#include <string_view>

namespace delmesh {

/// glTF (.gltf and .glb) and 3MF are read only.
enum class Format { ply, obj, off, stl, gltf, three_mf };

/// The lower-case name: "ply", "obj", ..., "3mf".
[[nodiscard]] std::string_view name(Format format);
/// False for formats that are only read.
[[nodiscard]] bool can_write(Format format);
/// By name, with or without a dot, in any case.
[[nodiscard]] std::optional<Format> format_from_name(std::string_view name);
/// By the extension of a path; .glb is glTF too.
[[nodiscard]] std::optional<Format> format_from_path(const std::filesystem::path& path);

}  // namespace delmesh
