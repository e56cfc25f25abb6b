#pragma once
// Meshes for property tests: every law that holds for all meshes is tried on each of these.

#include "delmesh/mesh/polygon_soup.hpp"

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace delmesh::test {

struct NamedSoup {
    std::string name;
    PolygonSoup soup;
    /// Holds faces of exactly zero area.
    bool has_zero_area = false;
    /// Holds coordinates near the ends of the range of doubles.
    bool extreme_scale = false;
};

inline std::ostream& operator<<(std::ostream& out, const NamedSoup& named) {
    return out << named.name;
}

/// Oriented manifolds (with boundary or without), all valid input of `Mesh`: the samples with about `faces` faces, and
/// small random and hostile constructions. The same every time.
[[nodiscard]] std::vector<NamedSoup> families(std::size_t faces = 300);

/// Makes `count` random edge flips that keep the soup an oriented manifold, without regard to its shape.
void flip_at_random(PolygonSoup& soup, std::size_t count, std::uint64_t seed);

}  // namespace delmesh::test
