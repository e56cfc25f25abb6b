#pragma once
// Where parallel planes cut needles, and what takes their place near corners.

#include "delaunay/id_map.hpp"
#include "delaunay/split_model.hpp"
#include "delmesh/base/vec3.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace delmesh {

/// A level for each point of an edge that is not at right angles to the axis; points of one level are where threads
/// cross. Mostly they lie in a plane at right angles to the axis. Where at a corner two edges of different lean meet at
/// an edge between them, planes leave that not Delaunay however near they come: there a level is a sphere about the
/// corner, which never does.
class SliceLevels {
public:
    /// `rounding`: of coordinates, relative. `dents_fans`: of edges that leave a corner side by side those in between
    /// are cut nearer to it by more than that, so that rounding leaves them Delaunay.
    SliceLevels(const SplitModel& model, double rounding, bool dents_fans)
        : model_(model),
          rounding_(rounding),
          dents_fans_(dents_fans) {}

    /// The direction of most of the edges' length.
    void find_axis(std::span<const std::uint32_t> edges);

    /// Of what a side sees.
    [[nodiscard]] double level_of(std::uint32_t side, const Contact& seen);
    /// Outside of [0,1], or not a number, if the edge does not reach that level.
    [[nodiscard]] double place_of(std::uint32_t e, double level) { return levels(e).place_of(level); }
    /// By how much rounding may move a point of the edge, as a share of it.
    [[nodiscard]] double rounding(std::uint32_t e) { return levels(e).rounding; }

private:
    /// Linear near the ends of an edge, and between.
    struct Levels {
        double from = 0;
        double first = 0;  ///< at `near_from`
        double last = 0;   ///< at 1 - near_to
        double to = 0;
        double near_from = 0;
        double near_to = 0;
        double rounding = -1;  ///< negative: not known yet
        [[nodiscard]] double at(double t) const;
        [[nodiscard]] double place_of(double level) const;
    };
    /// An edge as it leaves a corner.
    struct Ray {
        std::uint32_t edge = 0;
        std::uint32_t end = 0;  ///< that the corner is at: 0 for the smaller vertex, else 1
        int direction = 0;      ///< 1: up along the axis; -1: down; 0: neither
        Vec3 at_unit;           ///< where its level is 1 above the corner, or below, as seen from there
        double slope = 0;       ///< of the level
        double length = 0;
        bool is_boundary = false;
    };
    struct End {
        double radius = 0;  ///< that the following holds in
        double slope = 0;   ///< near that end of the edge, of the level; 0: as elsewhere
        double dent = 0;    ///< in units of what rounding does
    };

    [[nodiscard]] Vec3 point(VertexId v) const;
    [[nodiscard]] const Levels& levels(std::uint32_t e);
    [[nodiscard]] End end_at(VertexId v, HalfedgeId h);
    void look_around(VertexId v);
    void add_ray(VertexId v, VertexId other, HalfedgeId h);
    [[nodiscard]] static bool fails(std::span<const Ray> fan, bool is_closed);
    void add_fan(std::span<const Ray> fan, bool is_closed);

    const SplitModel& model_;
    double rounding_;
    bool dents_fans_;
    int exponent_ = 0;
    Vec3 axis_;
    std::vector<Levels> levels_;  ///< per edge
    std::vector<End> ends_;
    std::array<IdMap, 2> end_of_;  ///< per end: by edge of the mesh
    std::vector<Ray> rays_;
};

}  // namespace delmesh
