#pragma once
// An edge with what sees it for certain, ready for proofs that it can not be Delaunay wherever certain points lie.

#include "delaunay/bound_view.hpp"
#include "delaunay/edge_need.hpp"
#include "delaunay/id_map.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace delmesh {

/// A point somewhere in a stretch of an edge.
struct VaguePoint {
    std::uint32_t edge = 0;
    Stretch at;
};

constexpr std::size_t most_vague_points = 8;

/// Points on one edge are given in their order along it; there are at most most_vague_points in all.
class EdgeScene {
public:
    EdgeScene(BoundView& view, EdgeId e);

    [[nodiscard]] std::uint32_t edge() const { return edge_; }
    /// How much there is to look at.
    [[nodiscard]] std::size_t size() const { return size_; }
    /// The edges that share a facet with it and see all of it.
    [[nodiscard]] const std::vector<std::uint32_t>& neighbours() const { return neighbours_; }
    /// True if no part of the edge is bad, in doubles, with each point in the middle of its stretch.
    [[nodiscard]] bool looks_good(std::span<const VaguePoint> points) const;
    /// How far its parts are from bad, in doubles: the least sum of cotangents by their size. Points are at one place
    /// each.
    [[nodiscard]] double margin(std::span<const VaguePoint> points) const;
    /// True if a part of the edge is bad wherever the points lie in their stretches; proved.
    [[nodiscard]] bool is_bad(std::span<const VaguePoint> points) const;

private:
    struct Line {
        std::uint32_t edge = 0;
        FramePoint start;
        FramePoint end;
    };
    struct SideScene {
        std::vector<FramePoint> corners;
        std::vector<Line> lines;
    };
    struct Part {
        double from = 0;
        double to = 1;
    };
    /// What a side sees under the largest angle.
    struct Seen {
        double cot = 0;
        const FramePoint* corner = nullptr;
        const Line* line = nullptr;
        Stretch at;
    };

    void look(BoundView& view, const BoundView::Frame& frame, HalfedgeId h);
    [[nodiscard]] Seen look_from(const SideScene& side, const Part& part, std::span<const VaguePoint> points) const;
    template <class Test>
    [[nodiscard]] bool all_parts(std::span<const VaguePoint> points, Test&& test) const;
    [[nodiscard]] bool is_bad(const Part& part, std::span<const VaguePoint> points) const;
    [[nodiscard]] double highest_cot(const Part& part, const Seen& seen) const;
    [[nodiscard]] double highest_cot(const Part& part, const FramePoint& p) const;

    std::uint32_t edge_;
    double slack_ = 0;
    int sides_ = 0;
    std::size_t size_ = 0;
    std::array<SideScene, 2> scenes_;
    std::vector<std::uint32_t> neighbours_;
};

}  // namespace delmesh
