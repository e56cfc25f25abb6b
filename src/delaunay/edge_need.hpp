#pragma once
// How many points an edge needs if there are no others, where they would have to be, and what they would make bad.

#include "delaunay/bound_view.hpp"
#include "delaunay/stretch.hpp"

#include <cstdint>
#include <vector>

namespace delmesh {

/// Points of the stretch make another edge bad that is not split; proved.
struct BlockedStretch {
    std::uint32_t edge = 0;
    double from = 0;
    double to = 0;
};

struct EdgeNeed {
    std::uint32_t edge = 0;
    std::size_t points = 1;          ///< so many at least
    std::vector<Stretch> stretches;  ///< if it has no more: where the first, the second, ... of them must be, or larger
    std::vector<BlockedStretch> blockers;  ///< by edges for which `may_block` holds
};

/// Studies one edge after the other; keeps its buffers.
class EdgeStudy {
public:
    explicit EdgeStudy(BoundView& view) : view_(view) {}

    /// `is_open`: by edge id, the edges that must be split anyway; they block nothing.
    [[nodiscard]] EdgeNeed study(EdgeId e, const std::vector<bool>& is_open);

private:
    void look(HalfedgeId h);
    [[nodiscard]] double reach(double from, bool up) const;
    [[nodiscard]] double proved_reach(double from, double length, bool up, const std::array<int, 2>& seen) const;
    void find_stretches(EdgeNeed& need) const;
    void find_blockers(EdgeNeed& need, const std::vector<bool>& is_open) const;
    [[nodiscard]] bool find_blocked(HalfedgeId side, BlockedStretch& blocker) const;

    BoundView& view_;
    BoundView::Frame frame_;
    int sides_ = 0;
    std::array<ConvexView, 2> views_;
    std::array<std::vector<FramePoint>, 2> points_;
};

}  // namespace delmesh
