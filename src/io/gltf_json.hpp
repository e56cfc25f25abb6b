#pragma once
// The JSON of a glTF file, as far as meshes need it.

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string_view>

namespace delmesh::io {

using Json = nlohmann::json;

/// Parses JSON without what does not say where triangles are: materials, pictures, animations and the like may be
/// large. Nothing is recursive, and time is linear. Returns the byte at which the text is damaged, if it is.
[[nodiscard]] std::optional<std::size_t> parse_gltf_json(std::string_view text, Json& root);

}  // namespace delmesh::io
