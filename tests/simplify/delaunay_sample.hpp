#pragma once
// Built-in meshes as `simplify` starts from them.

#include "delmesh/mesh/shapes.hpp"
#include "delmesh/simplify/simplify.hpp"

#include <string_view>

namespace delmesh::test {

inline Mesh delaunay_sample(std::string_view name, std::size_t faces) {
    Mesh mesh(make_sample(name, faces));
    make_delaunay(mesh, SimplifyOptions::default_remesh());
    return mesh;
}

}  // namespace delmesh::test
