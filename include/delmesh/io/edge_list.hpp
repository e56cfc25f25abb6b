#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace delmesh {

/// Reads a text file of edges: two vertex numbers a line, counted from 0; blank lines and what follows a '#' are passed
/// over. Throws `Error` (file_not_readable, file_format) that names the file and the line.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> read_edge_list(const std::filesystem::path& path);

}  // namespace delmesh
