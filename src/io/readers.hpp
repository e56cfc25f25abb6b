#pragma once
// One function for each format that is read. Each starts at the input's first unread byte.

#include "delmesh/io/format.hpp"
#include "delmesh/io/read.hpp"
#include "io/input.hpp"
#include "io/soup_builder.hpp"

#include <filesystem>
#include <optional>

namespace delmesh::io {

/// Reads a soup from an input whose content, or else `hint`, or before all `options`, says what it is.
/// `folder` is where files lie that the input names; empty: nowhere.
[[nodiscard]] PolygonSoup read_input(Input& input, std::optional<Format> hint, const ReadOptions& options,
                                     const std::filesystem::path& folder = {});

/// What the first bytes look like; throws where they are a known format that is not read here, or not 8-bit text.
[[nodiscard]] std::optional<Format> detect_format(Input& input);
/// True if the STL data are binary: many binary files begin with "solid" too, so sizes and zero bytes count.
[[nodiscard]] bool is_binary_stl(Input& input);

// What has been read stays in the builder if an error is thrown.
void read_ply(Input& input, SoupBuilder& builder);
void read_obj(Input& input, SoupBuilder& builder);
void read_off(Input& input, SoupBuilder& builder);
void read_stl(Input& input, SoupBuilder& builder);
/// Buffers in files of their own are looked for in `folder` and below; nowhere if it is empty.
[[nodiscard]] PolygonSoup read_gltf(Input& input, const std::filesystem::path& folder);
[[nodiscard]] PolygonSoup read_3mf(Input& input);

}  // namespace delmesh::io
