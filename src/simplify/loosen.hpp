#pragma once
// Shakes a decimated mesh in which no edge can be collapsed any more, so that some can.

#include "base/random.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "simplify/placement.hpp"
#include "simplify/samples.hpp"
#include "simplify/star.hpp"

#include <cstdint>
#include <functional>
#include <utility>

namespace delmesh {

/// Flips edges whose other diagonal is Delaunay as well (two faces that do not lie in a plane often have two such
/// diagonals) and moves vertices. The mesh is Delaunay after each change. What is tried is drawn by a generator whose
/// seed is given.
class Loosener {
public:
    /// As `Refitter`; `samples` may be null.
    Loosener(Mesh& mesh, SurfaceSamples* samples, double scale, std::function<Vec3(const Vec3&)> settle,
             std::function<void(VertexId, const Vec3&)> moved)
        : mesh_(mesh),
          samples_(samples),
          scale_(scale),
          settle_(std::move(settle)),
          moved_(std::move(moved)) {}

    struct Pass {
        std::uint64_t seed = 0;
        bool boundary = true;  ///< moves vertices of the boundary as well
        double allowed2 = 0;   ///< squared, local unit: no sample gets farther from the surface, or than it was
    };
    /// Half of the edges, then all vertices. Returns the number of changes.
    std::size_t run(const Pass& pass);

private:
    bool flip_edge(HalfedgeId h, double allowed2);
    void move(VertexId v, const Vec3& to);
    bool move_vertex(VertexId v, double allowed2);
    [[nodiscard]] Vec3 draw_place();

    Mesh& mesh_;
    SurfaceSamples* samples_;
    double scale_;
    std::function<Vec3(const Vec3&)> settle_;
    std::function<void(VertexId, const Vec3&)> moved_;
    Random random_{0};
    Star star_;
};

}  // namespace delmesh
