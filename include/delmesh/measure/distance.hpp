#pragma once
// How far two surfaces are apart: Hausdorff, mean and RMS distance, sampled as by Metro, or enclosed with a proof.

#include "delmesh/base/context.hpp"
#include "delmesh/base/option.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <cstddef>
#include <optional>

namespace delmesh {

struct DistanceOptions {
    /// Samples inside the faces, in each direction, for each face of the larger of the two meshes. Above 0.
    double samples_per_face = 10;
    /// At least so many samples inside the faces, in each direction.
    std::size_t min_samples = 200'000;
    /// Other seeds give other sample points.
    std::size_t seed = 1;
    /// Above 0: also encloses the Hausdorff distance in an interval of this width, as a fraction of the bounding-box
    /// diagonal of A. 0: does not.
    double bound_rel = 0;
    /// The enclosure gives up after so many pieces of triangles (some 100 bytes and 2 microseconds each).
    std::size_t max_pieces = 10'000'000;

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit(self.samples_per_face, OptionInfo{.name = "samples-per-face",
                                                .lowest = 1e-3,
                                                .highest = 1e6,
                                                .help = "samples inside faces, per face of the larger mesh"});
        visit(self.min_samples, OptionInfo{.name = "min-samples",
                                           .lowest = 0,
                                           .highest = 1e12,
                                           .help = "at least so many samples inside the faces, in each direction"});
        visit(self.seed, OptionInfo{.name = "seed", .lowest = 0, .help = "other seeds give other sample points"});
        visit(self.bound_rel, OptionInfo{.name = "bound",
                                         .unit = "rel",
                                         .lowest = 0,
                                         .highest = 1,
                                         .help = "prove an interval of this width around the Hausdorff distance"});
        visit(self.max_pieces,
              OptionInfo{
                  .name = "max-pieces", .lowest = 1, .help = "the proof gives up after so many pieces of triangles"});
    }
};

/// A distance in both directions: forward is from A to B (over the points of A), backward from B to A.
struct DistanceFigure {
    double value = 0;  ///< the larger of the two, in units of the coordinates
    double percent =
        0;  ///< `value` in percent of the bounding-box diagonal of A; infinite if A is a point, 0 if value is
    double forward = 0;
    double backward = 0;
};

/// Where the Hausdorff distance is attained, as far as the samples know: a point of each surface.
struct DistancePlace {
    Vec3 on_a;
    Vec3 on_b;
};

/// A proved interval: lower <= Hausdorff distance of the two surfaces <= upper.
struct DistanceEnclosure {
    double lower = 0;
    double upper = 0;
    double lower_percent = 0;
    double upper_percent = 0;
    /// True if the interval is as narrow as asked. If not, the work was bounded by `max_pieces`, the call was
    /// cancelled, or the width asked for is near what doubles resolve; the interval holds all the same.
    bool reached = false;
    std::size_t pieces = 0;  ///< pieces of triangles that were looked at
};

struct DistanceReport {
    DistanceFigure hausdorff;  ///< the largest distance of any sample: from below, up to rounding
    DistanceFigure mean;       ///< averages over the area
    DistanceFigure rms;
    DistancePlace at;
    std::size_t samples = 0;  ///< in both directions: vertices, points on edges, points inside faces
    double diagonal = 0;      ///< of the bounding box of A
    std::optional<DistanceEnclosure> enclosure;
    /// False only if the context was cancelled: the figures then cover a part of the samples.
    bool complete = false;
};

/// Measures the distance of two surfaces, both ways.
///
/// Samples: all vertices, points on all edges, and points inside the faces, spread by area; for each the exact nearest
/// point of the other surface (within rounding, about 1e-15 of the larger bounding box; distances below that are
/// reported as 0). Mean and RMS are over the samples inside the faces only, or over all if neither surface has area.
/// Exchanging A and B exchanges forward and backward, bit for bit (percentages are of A). Scaling both by a power of
/// two scales every distance by it, bit for bit. The result does not depend on the number of threads.
///
/// The enclosure is proved: all rounding is accounted for (docs/distance.md).
///
/// Throws `Error` (bad_argument) for options out of range, (no_surface) for a mesh without faces.
/// Cost: O((faces + samples) log faces); 0.2 to 1 microseconds per sample on one core.
/// Source: Cignoni, Rocchini, Scopigno, Metro, 1998; Tang, Lee, Kim, Interactive Hausdorff distance, 2009.
[[nodiscard]] DistanceReport measure_distance(const Mesh& a, const Mesh& b, const DistanceOptions& options = {},
                                              const Context* context = nullptr);

/// The same for soups: any set of triangles is a surface here. Polygons are triangulated first. Throws also
/// `not_finite` and `index_out_of_range`.
[[nodiscard]] DistanceReport measure_distance(const PolygonSoup& a, const PolygonSoup& b,
                                              const DistanceOptions& options = {}, const Context* context = nullptr);

}  // namespace delmesh
