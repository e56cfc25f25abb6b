#pragma once
// Fewer vertices and fewer edges that are not Delaunay, until none is left: where needles are in each other's way, and
// remeshing would need more points than anybody wants.

#include "base/random.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "mesh/edit_log.hpp"
#include "simplify/star.hpp"
#include "simplify/tuning.hpp"

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace delmesh {

/// Collapses, moves and flips that leave no more faults than there were: to twice the vertices, to so many, and on to
/// half as many again and again. Ends when there is no fault any more, or remeshing finds room for what is left below
/// the number of vertices (then it returns true); when there is nothing left to thin out; or after a fixed amount of
/// work.
bool mend(Mesh& mesh, Tuning tuning, const RemeshOptions& remesh, std::size_t vertices, const Context* context);

/// One pass of flips and moves. What is tried is drawn by a generator whose seed is given.
class Mender {
public:
    /// `settle` rounds a place to what can be stored.
    Mender(Mesh& mesh, double scale, std::function<Vec3(const Vec3&)> settle, const std::vector<Vec3>& homes)
        : mesh_(mesh),
          scale_(scale),
          settle_(std::move(settle)),
          homes_(homes),
          log_(mesh) {}

    /// Changes that leave as many faults are made as well, now and then. Returns how many faults are left.
    std::size_t run(std::uint64_t seed);

private:
    bool flip_edge(HalfedgeId h);
    bool move_vertex(VertexId v);
    [[nodiscard]] Vec3 draw_place(VertexId v);

    Mesh& mesh_;
    double scale_;
    std::function<Vec3(const Vec3&)> settle_;
    const std::vector<Vec3>& homes_;  ///< where the vertices were at the start
    EditLog log_;
    Random random_{0};
    Star star_;
};

}  // namespace delmesh
