#pragma once

#include "delmesh/delaunay/provenance.hpp"

#include <filesystem>

namespace delmesh {

/// Writes a provenance as one JSON object, whole or not at all (docs/provenance.md describes it):
/// {"input_vertices": n, "splits": [[a, b, t], ...], "facet_of_face": [...], "facet_of_input_face": [...]}.
/// The numbers t are read back bit for bit. Throws `Error` (file_not_writable).
void write_provenance(const std::filesystem::path& path, const Provenance& provenance);

}  // namespace delmesh
