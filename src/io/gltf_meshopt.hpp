#pragma once
// Buffer views that are packed by meshoptimizer (EXT_meshopt_compression, or KHR_ with the same code).

#include "io/gltf_file.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace delmesh::io {

/// No code of meshoptimizer makes more than this of a byte.
inline constexpr std::uint64_t meshopt_growth = 64;

/// The `length` bytes that are packed in `packed` as `extension`, of buffer view `view`, says. Throws `Error`, in one
/// line, where that can not be, before it asks for memory.
[[nodiscard]] std::string decode_meshopt(const GltfFile& file, const Json& extension, std::string_view packed,
                                         std::uint64_t length, std::uint64_t view);

}  // namespace delmesh::io
