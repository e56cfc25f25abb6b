#pragma once
// One function for each format that is read. Each starts at the input's first unread byte.

#include "delmesh/io/format.hpp"
#include "delmesh/io/read.hpp"
#include "io/input.hpp"

#include <optional>

namespace delmesh::io {

/// Reads a soup from an input whose content, or else `hint`, or before all `options`, says what it is.
[[nodiscard]] PolygonSoup read_input(Input& input, std::optional<Format> hint, const ReadOptions& options);

/// What the first bytes look like; throws where they are a known format that is not read here, or not 8-bit text.
[[nodiscard]] std::optional<Format> detect_format(Input& input);
/// True if the STL data are binary: many binary files begin with "solid" too, so sizes and zero bytes count.
[[nodiscard]] bool is_binary_stl(Input& input);

[[nodiscard]] PolygonSoup read_ply(Input& input);
[[nodiscard]] PolygonSoup read_obj(Input& input);
[[nodiscard]] PolygonSoup read_off(Input& input);
[[nodiscard]] PolygonSoup read_stl(Input& input);

}  // namespace delmesh::io
