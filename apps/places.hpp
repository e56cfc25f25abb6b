#pragma once
// STL has no indices: whatever lies at one place is one vertex when the file is read. A mesh may see that differently.

#include "delmesh/mesh/mesh.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace delmesh::app {

struct PlacesReport {
    std::size_t welded = 0;  ///< vertices joined with another one at their place
    std::size_t parted = 0;  ///< vertices moved by the last bit instead, as joining would not give a mesh
    /// All points before that, if any was moved.
    std::vector<Vec3> before;
};

/// Makes places and vertices of a soup of floats the same thing: joins vertices where the result is a mesh; where it is
/// not, as the surface touches itself, moves them apart.
PlacesReport tell_places_apart(PolygonSoup& soup);

/// Throws `Error` (unsupported_format) if two vertices lie at the same place.
void check_places(const std::string& path, const Mesh& mesh);

}  // namespace delmesh::app
