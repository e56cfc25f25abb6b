#pragma once
// Meshes to files, whole or not at all.

#include "delmesh/io/format.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <filesystem>
#include <optional>

namespace delmesh {

struct WriteOptions {
    /// Not given: by the extension of the path.
    std::optional<Format> format;
    /// Of binary PLY coordinates and of all text formats; STL is always float32.
    Precision precision = Precision::float64;
    /// PLY and STL as text instead of binary little-endian.
    bool ascii = false;
};

/// The precision of the coordinates in a file of this format.
[[nodiscard]] Precision stored_precision(Format format, const WriteOptions& options);

/// Writes beside the name, then renames, so that the file appears whole or not at all; an existing file keeps its
/// permissions, a symbolic link stays one, and what is not a regular file (a pipe, /dev/stdout) is written directly.
/// Doubles are written so that they are read back bit for bit; with float32, coordinates must already be floats (see
/// `round_to_float`), so that nothing moves here. Polygons stay polygons, but for STL. Throws `Error`
/// (file_not_writable, unsupported_format, bad_argument where a coordinate is no float, index_out_of_range, too_large).
void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const WriteOptions& options = {});
void write_soup(const std::filesystem::path& path, const PolygonSoup& soup, const WriteOptions& options = {});

/// Removes what writes that are under way have put beside their targets: for a signal handler that ends the process
/// (async-signal-safe). Those writes fail if they go on.
void remove_unfinished_files() noexcept;

}  // namespace delmesh
