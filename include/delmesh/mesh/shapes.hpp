#pragma once
// Meshes made by code: samples to try things on, and families to test with.

#include "delmesh/mesh/polygon_soup.hpp"

#include <cstddef>
#include <span>
#include <string_view>

namespace delmesh {

struct SampleInfo {
    std::string_view name;
    std::string_view description;  ///< one line
    std::size_t default_faces;
};

/// The built-in samples, in the order in which they are listed.
[[nodiscard]] std::span<const SampleInfo> samples();

/// Makes a sample with about `faces` faces (0: its default): within 20 % from 1,000 faces on, the nearest it can be
/// below. Every sample is an oriented 2-manifold (with boundary where that is natural) of any size up to 10^9 faces,
/// without zero-area faces. Deterministic: the same name, size and seed give the same bits on every system. Throws
/// `Error` (bad_argument) for a name that is not in `samples()` and for more than 10^9 faces. Cost: O(faces).
[[nodiscard]] PolygonSoup make_sample(std::string_view name, std::size_t faces = 0, unsigned seed = 1);

}  // namespace delmesh
