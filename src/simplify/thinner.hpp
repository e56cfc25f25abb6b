#pragma once
// The first part of the way of a large mesh: cheap collapses in sweeps, in hardly more room than the mesh takes itself.

#include "delmesh/base/context.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "simplify/placement.hpp"
#include "simplify/star.hpp"
#include "simplify/tuning.hpp"
#include "simplify/weights.hpp"

#include <limits>
#include <vector>

namespace delmesh {

/// Collapses what costs less than a limit that grows from sweep to sweep, as `Sweeper` does, but keeps nothing of
/// edges, quadrics and what was merged: all that is computed again. With `Tuning::constrained` the mesh must be
/// Delaunay, and is after each collapse; without, `Tuning::mending` says what may become of edges that are not (but for
/// rounding).
class Thinner {
public:
    /// The mesh must be without isolated vertices, and must outlive the thinner.
    Thinner(Mesh& mesh, const Tuning& tuning, Precision precision);

    /// Collapses until so many vertices are left, hardly anything can be collapsed any more, or the context is
    /// cancelled. Leaves no gaps between the ids, and all in their order.
    void run(std::size_t vertices, const Context* context);

    [[nodiscard]] std::size_t collapses() const { return collapses_; }
    /// By the ids of the start, the present id of the vertex that each was merged into.
    [[nodiscard]] std::vector<VertexId> merged_into() const;

private:
    [[nodiscard]] double key_of(HalfedgeId h) const;
    [[nodiscard]] float choose_limit(double part);
    void sweep(std::size_t vertices, float limit, const Context* context);
    void visit(HalfedgeId h, float limit);
    [[nodiscard]] double find_drift2(const Vec3& w) const;
    void accept(HalfedgeId h, const Vec3& w);
    void close_gaps();
    [[nodiscard]] VertexId name(VertexId v) const { return name_.empty() ? v : name_[v.index()]; }

    Mesh& mesh_;
    const Tuning tuning_;
    const double scale_;
    const Precision precision_;
    Placer placer_;
    VertexWeights weights_;
    Star star_;
    std::size_t vertices_;
    std::size_t collapses_ = 0;
    double drift_limit2_ = std::numeric_limits<double>::infinity();  ///< squared, local unit
    double drift_sum_ = 0;
    std::vector<bool> merged_;      ///< per vertex: something was merged into it in this sweep
    std::vector<VertexId> name_;    ///< per vertex: what it was called at first; empty: as now
    std::vector<VertexId> parent_;  ///< by name, the name of what it was merged into, or its own
    std::vector<float> some_keys_;
};

}  // namespace delmesh
