#pragma once
// The quadrics of the vertices: of the faces around them now, and of all that was merged into them.

#include "delmesh/mesh/mesh.hpp"
#include "delmesh/simplify/quadric.hpp"
#include "simplify/tuning.hpp"

#include <vector>

namespace delmesh {

/// All quadrics are local: the origin is the vertex's own place, the unit 1/scale of the mesh's.
class VertexWeights {
public:
    VertexWeights(const Mesh& mesh, double scale, const Tuning& tuning);

    /// The planes to judge an edge by: those at its ends, with the place of u as the origin; `to_v` is that of v.
    [[nodiscard]] Quadric of_edge(VertexId u, VertexId v, const Vec3& to_v) const;
    /// Planes of the original faces that v stands for.
    [[nodiscard]] const Quadric& history(VertexId v) const { return history_[v.index()]; }

    /// v stands for the planes of `merged` from now on.
    void set_history(VertexId v, const Quadric& merged) { history_[v.index()] = merged; }
    /// To be called when the faces at v have changed.
    void refresh(VertexId v);

private:
    /// A of a quadric whose b and c are zero: all planes go through the vertex.
    struct Planes {
        double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    };
    [[nodiscard]] Quadric planes_at(VertexId v) const;

    const Mesh& mesh_;
    double scale_;
    const Tuning& tuning_;
    std::vector<Quadric> history_;
    std::vector<Planes> current_;
};

}  // namespace delmesh
