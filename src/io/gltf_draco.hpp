#pragma once
// Triangles that are packed by Draco (KHR_draco_mesh_compression).

#include "io/gltf_file.hpp"
#include "io/scene_builder.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace delmesh::io {

/// What is read of Draco data; every corner is below the number of points.
struct DracoMesh {
    std::string positions;  ///< three numbers of the accessor's type for each point
    std::vector<std::uint32_t> corners;
};

/// Decodes the data that `extension` names for `primitive`, whose accessors say what must come out. The decoder asks
/// for memory by the counts in the data, so corners and numbers are taken out of what the scene may have. Throws
/// `Error`, in one line, where the data are damaged, other than the accessors say, or want more than is left.
[[nodiscard]] DracoMesh decode_draco(GltfFile& file, const Json& primitive, const Json& extension, SceneBuilder& scene);

}  // namespace delmesh::io
