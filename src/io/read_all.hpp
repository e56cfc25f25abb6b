#pragma once

#include "io/input.hpp"

#include <string>

namespace delmesh::io {

/// All the bytes of an input, of which there must be less than 2 GiB, else throws `Error` (too_large).
[[nodiscard]] std::string read_all(Input& input);

}  // namespace delmesh::io
