#pragma once

#include "delmesh/mesh/polygon_soup.hpp"

#include <filesystem>
#include <optional>
#include <string_view>

namespace delmesh {

enum class Format { ply, obj, off, stl };

/// The lower-case name: "ply", "obj", ...
[[nodiscard]] std::string_view name(Format format);
/// By name, with or without a dot, in any case.
[[nodiscard]] std::optional<Format> format_from_name(std::string_view name);
/// By the extension of a path.
[[nodiscard]] std::optional<Format> format_from_path(const std::filesystem::path& path);

}  // namespace delmesh
