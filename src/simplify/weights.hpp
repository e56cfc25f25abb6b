#pragma once
// The quadrics of the vertices: of the faces around them now, and of all that was merged into them.

#include "delmesh/mesh/mesh.hpp"
#include "delmesh/simplify/quadric.hpp"
#include "simplify/tuning.hpp"

#include <cstdint>
#include <vector>

namespace delmesh {

/// All quadrics are local: the origin is the vertex's own place, the unit 1/scale of the mesh's.
class VertexWeights {
public:
    VertexWeights(const Mesh& mesh, double scale, const Tuning& tuning);

    /// Planes of the current faces, with a share of the history.
    [[nodiscard]] const Quadric& current(VertexId v) const { return current_[v.index()]; }
    /// Planes of the original faces that v stands for.
    [[nodiscard]] const Quadric& history(VertexId v) const { return history_[v.index()]; }

    /// How often `current(v)` was computed.
    [[nodiscard]] std::uint32_t version(VertexId v) const { return version_[v.index()]; }

    /// v stands for the planes of `merged` from now on.
    void set_history(VertexId v, const Quadric& merged) { history_[v.index()] = merged; }
    /// Computes `current(v)` anew from the faces at v.
    void refresh(VertexId v);

private:
    [[nodiscard]] Quadric planes_at(VertexId v) const;

    const Mesh& mesh_;
    double scale_;
    const Tuning& tuning_;
    std::vector<Quadric> history_;
    std::vector<Quadric> current_;
    std::vector<std::uint32_t> version_;
};

}  // namespace delmesh
