#pragma once
// The quadrics of the vertices: of the faces around them now, and of all that was merged into them.

#include "delmesh/mesh/mesh.hpp"
#include "delmesh/simplify/quadric.hpp"
#include "simplify/pool.hpp"
#include "simplify/star.hpp"
#include "simplify/tuning.hpp"

#include <cstdint>
#include <vector>

namespace delmesh {

/// The mean square of the distances, local unit, of the origin to the planes.
[[nodiscard]] double mean_square(const Quadric& planes);

/// All quadrics are local: the origin is the vertex's own place, the unit 1/scale of the mesh's.
class VertexWeights {
public:
    /// Which of them are kept; the others are computed when they are asked for.
    enum class Kept {
        all,
        changed,  ///< of vertices around which something has changed: `prepare` must be told before it does
        none,     ///< `changed` must be told after it did; there is no history
    };
    VertexWeights(const Mesh& mesh, double scale, const Tuning& tuning, Kept kept = Kept::all);

    /// The edge of the star is about to be collapsed.
    void prepare(const Star& star);
    /// Where none are kept: the edge of the star has been collapsed.
    void changed(const Star& star);

    /// The planes to judge an edge by: those at its ends, with the place of u as the origin; `to_v` is that of v.
    [[nodiscard]] Quadric of_edge(VertexId u, VertexId v, const Vec3& to_v) const;
    /// Planes of the original faces that v stands for.
    [[nodiscard]] Quadric history(VertexId v) const;
    /// Asks memory for it ahead of its use.
    void prefetch_history(VertexId v) const {
        if (at_[v.index()] != none) __builtin_prefetch(&history_[at_[v.index()]]);
    }

    /// What the vertex that the edge of the star is merged into stands for, w (local) as its origin.
    [[nodiscard]] Quadric merged_history(const Star& star, const Vec3& w) const;

    /// v stands for the planes of `merged` from now on.
    void set_history(VertexId v, const Quadric& merged);
    /// v is gone: its room goes to others.
    void forget(VertexId v);
    /// To be called when the faces at v have changed.
    void refresh(VertexId v);
    /// The number of vertices has changed; new ones stand for nothing yet.
    void resize();
    /// The vertices have got other ids.
    void renumber(const std::vector<VertexId>& ids);
    /// The same, where they keep their order: in place.
    void close_gaps(const std::vector<VertexId>& ids);
    /// To be called when the edge of the star has been collapsed to w (local), between `left` and `right` (not valid at
    /// the boundary): brings the quadrics of w and of the ring up to date from what has changed.
    void replace_star(const Star& star, const Vec3& w, VertexId left, VertexId right);

private:
    /// A of a quadric whose b and c are zero: all planes go through the vertex.
    struct Planes {
        double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

        void add(const Vec3& normal, double weight) {
            const Vec3 n = normal * weight;
            xx += n.x * normal.x, xy += n.x * normal.y, xz += n.x * normal.z;
            yy += n.y * normal.y, yz += n.y * normal.z, zz += n.z * normal.z;
        }
        [[nodiscard]] double trace() const { return xx + yy + zz; }
        Planes& operator+=(const Planes& o) {
            xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
            return *this;
        }
    };
    /// The rest of a quadric. It is zero, and not stored, until something is merged into the vertex.
    struct Rest {
        Vec3 b;
        double c = 0;
    };
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    [[nodiscard]] Quadric planes_at(VertexId v) const;
    [[nodiscard]] Planes computed(VertexId v) const;
    [[nodiscard]] const Planes& current(VertexId v) const;
    [[nodiscard]] Planes& kept_current(VertexId v) { return current_[at_[v.index()]]; }
    void keep(VertexId v, const Planes& planes);

    const Mesh& mesh_;
    double scale_;
    const Tuning& tuning_;
    std::vector<std::uint32_t> at_;  ///< per vertex: of its planes; none: they are computed
    Pool<Planes> current_;
    Pool<Planes> history_;                ///< numbered as `current_`
    std::vector<std::uint32_t> rest_at_;  ///< per vertex: of its history
    Pool<Rest> rest_;
    struct Recent {
        VertexId vertex;
        Planes planes;
    };
    mutable std::vector<Recent> recent_;  ///< what was computed lately
};

}  // namespace delmesh
