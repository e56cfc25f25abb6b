#pragma once

#include "repair/complex.hpp"

namespace delmesh::repairing {

/// The line elements of a soup after its repair: on every edge between the vertices that the ends of a line were kept
/// as or copied to; where there is no such edge, on every edge at that place; where there is none either, between the
/// first vertices there. `number` holds for each vertex of the complex its number in the output, or none.
[[nodiscard]] std::vector<std::array<Index, 2>> carry_lines(const PolygonSoup& soup, const Complex& complex,
                                                            const std::vector<Index>& number, Log& log);

}  // namespace delmesh::repairing
