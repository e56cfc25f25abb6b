#pragma once
// What the two readers of OFF files share.

#include "io/input.hpp"
#include "io/soup_builder.hpp"

#include <optional>
#include <string_view>

namespace delmesh::io {

/// What the keyword [ST][C][N][4][n]OFF says about each vertex.
/// Source: Geomview manual, section "OFF Files".
struct OffKind {
    bool texture = false;        ///< ST: two texture coordinates
    bool colours = false;        ///< C: a colour
    bool normals = false;        ///< N: a normal
    bool homogeneous = false;    ///< 4: one more coordinate, by which the others are to be divided
    bool any_dimension = false;  ///< n: the number of coordinates comes first
};

[[nodiscard]] std::optional<OffKind> parse_off_keyword(std::string_view word);

/// Reads what follows the line "OFF BINARY".
void read_off_binary(Input& input, const OffKind& kind, SoupBuilder& builder);

}  // namespace delmesh::io
