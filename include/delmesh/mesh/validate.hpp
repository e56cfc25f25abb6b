#pragma once

#include "delmesh/mesh/mesh.hpp"

#include <string>

namespace delmesh {

/// Checks every invariant of `Mesh`, from scratch and independently of how the mesh was made. Returns an empty string
/// if all hold, else a sentence that names the first violation. Cost: O(size log size).
[[nodiscard]] std::string validate(const Mesh& mesh);

}  // namespace delmesh
