#pragma once
// Distances from samples of one surface to another.

#include "delmesh/base/context.hpp"
#include "measure/surface.hpp"

#include <cstddef>
#include <cstdint>

namespace delmesh::measure {

/// The sample that is farthest from the other surface.
struct Farthest {
    double distance2 = -1;
    Vec3 point;
    std::uint32_t nearest = 0;  ///< the triangle of the other surface that is nearest, in the order of its tree
};

struct Sum {
    std::size_t count = 0;
    double distance = 0;
    double squared = 0;
};

struct OneWay {
    Farthest farthest;
    Sum inside;   ///< samples inside faces, spread by area
    Sum outline;  ///< vertices and points on edges
    bool complete = true;
};

/// All vertices, at least one point on each side of each face (the two sides of an edge have different ones), more on
/// long edges, and `face_samples` points inside the faces. The same for any number of threads.
[[nodiscard]] OneWay sample_distances(const Surface& from, const Surface& to, std::size_t face_samples,
                                      std::uint64_t seed, const Context* context);

/// Squared distances below this are rounding, and are taken for zero.
inline constexpr double noise_distance2 = 0x1p-100;

}  // namespace delmesh::measure
