#pragma once
// The first part of a long way: cheap collapses in sweeps over the whole mesh, each one checked exactly.

#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "simplify/numbering.hpp"
#include "simplify/placement.hpp"
#include "simplify/pool.hpp"
#include "simplify/star.hpp"
#include "simplify/tuning.hpp"
#include "simplify/watchlists.hpp"
#include "simplify/weights.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace delmesh {

/// Collapses what costs less than a limit that grows from sweep to sweep, in the order of memory and not of cost: no
/// queue, no lists of what waits for what, no samples. The mesh is Delaunay after each collapse. For the part of the
/// way where so many edges are cheap that the order among them does not matter.
class Sweeper {
public:
    /// The mesh must be Delaunay, without isolated vertices, and must outlive the sweeper. It gets other ids.
    Sweeper(Mesh& mesh, const Tuning& tuning, Precision precision, Numbering& numbering);

    /// Collapses until so many vertices are left, hardly anything can be collapsed any more, or the context is
    /// cancelled. Leaves no gaps between the ids.
    void run(std::size_t vertices, const Context* context);

    [[nodiscard]] std::size_t collapses() const { return collapses_; }
    /// As `SimplifyReport::quadric_error`.
    [[nodiscard]] double worst_error() const;
    [[nodiscard]] const VertexWeights& weights() const { return weights_; }
    /// By name, the present id of the vertex that each was merged into.
    [[nodiscard]] std::vector<VertexId> merged_into() const;

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    struct Drift {
        double distance2 = -1;  ///< squared, local unit
        Vec3 point;
    };
    [[nodiscard]] float key_of(HalfedgeId h);
    [[nodiscard]] float choose_limit();
    void sweep(std::size_t vertices, float limit, const Context* context);
    void visit(HalfedgeId h, float limit);
    void wait(HalfedgeId h, VertexId witness);
    void wake(VertexId v);
    [[nodiscard]] Drift find_drift(const Vec3& w) const;
    void accept(HalfedgeId h, const Vec3& w);
    void keep_far(VertexId kept, VertexId gone, const Vec3& point);
    void close_vertex_gaps();
    void tidy();

    Mesh& mesh_;
    const Tuning tuning_;
    const double scale_;
    const Precision precision_;
    Numbering& numbering_;
    Placer placer_;
    VertexWeights weights_;
    Star star_;
    std::size_t vertices_;
    std::size_t collapses_ = 0;
    double worst_error2_ = 0;
    double drift_limit2_ = std::numeric_limits<double>::infinity();  ///< squared, local unit
    double drift_sum_ = 0;
    std::vector<float> key_;          ///< per half-edge that names an edge: its cost; negative: not known
    std::vector<bool> waits_;         ///< per half-edge: it was blocked, and nothing has changed at what blocked it
    Watchlists<HalfedgeId> watches_;  ///< who waits for a vertex to change
    std::vector<HalfedgeId> woken_;
    std::vector<bool> merged_;           ///< per vertex: something was merged into it in this sweep
    std::vector<std::uint32_t> far_at_;  ///< per vertex: where its far point stands; none: nothing was merged into it
    Pool<Vec3> far_;                     ///< of what was merged into a vertex, the farthest from the surface
    std::vector<VertexId> parent_;       ///< by name, the name of what it was merged into, or its own
    std::vector<float> some_keys_;
};

}  // namespace delmesh
