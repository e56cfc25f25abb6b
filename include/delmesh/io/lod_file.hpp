#pragma once
// Files of progressive meshes (.dlod).

#include "delmesh/simplify/progressive_mesh.hpp"

#include <filesystem>

namespace delmesh {

/// Throws `Error` (file_not_readable, file_format) that names the file, and the byte where it is not what it should be.
[[nodiscard]] ProgressiveMesh read_lod(const std::filesystem::path& path);

/// Writes beside the name, then renames. Throws `Error` (file_not_writable).
void write_lod(const std::filesystem::path& path, const ProgressiveMesh& progressive);

}  // namespace delmesh
