#pragma once
// Files to soups. PLY (ascii, both endians, triangle strips), OBJ, OFF (all usual variants), STL (ascii, binary).

#include "delmesh/base/context.hpp"
#include "delmesh/io/format.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

namespace delmesh {

struct ReadOptions {
    /// Not given: content decides, the extension is a hint.
    std::optional<Format> format;
};

/// Reads a mesh file. STL corners are welded where their coordinates are equal (-0 equals +0), in order of first
/// appearance. Every number keeps its full precision. Throws `Error` (file_not_readable, file_format,
/// unsupported_format) in one line that names file, line or byte, what was found and what was expected. Cost: O(bytes);
/// memory in proportion to what the file really holds, whatever its counts say.
[[nodiscard]] PolygonSoup read_soup(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for bytes in memory; `name` stands for the file in messages.
[[nodiscard]] PolygonSoup parse_soup(std::span<const std::byte> bytes, std::string_view name,
                                     const ReadOptions& options = {});

}  // namespace delmesh
