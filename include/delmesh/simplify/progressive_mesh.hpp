#pragma once
// All levels of detail in one: a coarse base mesh and the steps that lead from it back to the finest mesh.

#include "delmesh/mesh/mesh.hpp"
#include "delmesh/simplify/simplify.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace delmesh {

/// One step from coarse to fine. Vertices are numbered as in the meshes of `ProgressiveMesh::at`: the base's first,
/// then one for each split in order.
struct RefineStep {
    enum class Kind : unsigned char {
        split,  ///< `vertex` moves to `kept` and a new vertex appears at `added`, joined to vertex, left and right
        move,   ///< `vertex` moves to `kept`
    };
    Kind kind = Kind::split;
    VertexId vertex;
    VertexId left;   ///< the new edge (vertex, new) has this on its left ...
    VertexId right;  ///< ... and this on its right; not valid for a boundary edge
    Vec3 kept;
    Vec3 added;
};

/// Source: progressive meshes, Hoppe 1996; here every mesh on the way is Delaunay.
struct ProgressiveMesh {
    Mesh base;
    std::vector<RefineStep> steps;

    [[nodiscard]] std::size_t least_vertices() const { return base.vertex_count(); }
    [[nodiscard]] std::size_t most_vertices() const;

    /// The mesh with so many vertices (the nearest there is below or above the range), exactly as it was when the
    /// simplifier left that number. It is Delaunay if the steps come from `simplify`. The ids of its vertices are the
    /// same at every level that has them; faces are not. Throws `Error` (file_format, naming the step) if the steps do
    /// not fit the base. Cost: O(size of the result).
    [[nodiscard]] Mesh at(std::size_t vertices) const;
};

/// As `simplify` in simplify.hpp, and puts the whole way into `record`: its base is the mesh that is left, its finest
/// level the Delaunay mesh at the start.
SimplifyReport simplify(Mesh& mesh, const SimplifyOptions& options, ProgressiveMesh& record,
                        const Context* context = nullptr);

/// The content of a .dlod file; docs/simplify.md describes the bytes.
[[nodiscard]] std::vector<std::byte> encode(const ProgressiveMesh& progressive);

/// Reads what `encode` wrote; coordinates come back bit for bit. `name` stands for the file in messages. Throws `Error`
/// (file_format) that names the byte and what was expected; never reads past the end, whatever the counts say.
[[nodiscard]] ProgressiveMesh decode(std::span<const std::byte> bytes, std::string_view name);

}  // namespace delmesh
