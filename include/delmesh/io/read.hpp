#pragma once
// Files to soups. PLY (ascii, both endians, triangle strips), OBJ, OFF (all usual variants), STL (ascii, binary), glTF
// 2.0 (.gltf, .glb), 3MF.

#include "delmesh/base/context.hpp"
#include "delmesh/io/format.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace delmesh {

/// What could not be read of a damaged file.
struct FileDamage {
    /// Lines or faces that were left out; all that follows an early end counts as one.
    std::size_t count = 0;
    /// What is wrong with the first 16 of them, and where: each as an error would say it.
    std::vector<std::string> sentences;
};

struct ReadOptions {
    /// Not given: content decides, the extension is a hint.
    std::optional<Format> format;
    /// Given: what is damaged is left out and told here. Faces that can not be read are missing; vertices that can not
    /// be read are NaN, so that the others keep their numbers. A file without a single face that can be read is an
    /// error all the same, and so is a damaged scene. Not given: the first damage is an error.
    FileDamage* damage = nullptr;
};

/// Reads a mesh file; of a scene (glTF, 3MF) all that is shown, where it is shown. gzip and Zstandard data are unpacked
/// on the way, and lines and bytes in messages are then those of the unpacked data. STL corners, and those of one glTF
/// mesh, are welded where their coordinates are equal (-0 equals +0), in order of first appearance. Numbers are read as
/// doubles at full precision, but for an ascii PLY file whose header says `float`: such a number is the nearest float,
/// as in any program that keeps the declared type. Infinities and NaNs are kept; a decimal number that overflows is an
/// error. All vertex indices are checked. Throws `Error` (file_not_readable, file_format, index_out_of_range,
/// too_large, unsupported_format) in one line that names file, line or byte, what was found and what was expected.
/// Cost: O(bytes); memory in proportion to what the file really holds, whatever its counts say; packed data that grow
/// absurdly (more than 250-fold, beyond 64 MiB) are an error. See docs/formats.md.
[[nodiscard]] PolygonSoup read_soup(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for bytes in memory; `name` stands for the file in messages.
[[nodiscard]] PolygonSoup parse_soup(std::span<const std::byte> bytes, std::string_view name,
                                     const ReadOptions& options = {});

}  // namespace delmesh
