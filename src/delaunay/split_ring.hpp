#pragma once
// Rings of long thin facets, side by side, and threads of points around them.

#include "delaunay/ring_threads.hpp"
#include "delaunay/split_model.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delmesh {

/// In a ring no thread can end: all its edges are split, or none, and points vanish only by whole threads.
class SplitRing {
public:
    explicit SplitRing(SplitModel& model) : model_(model), threads_(model) {}

    /// Finds the ring that an edge lies in, if it has no more than `most` rungs. A facet joins two rungs if these are
    /// much longer than the rest of its sides.
    bool gather(std::uint32_t e, std::size_t most);
    [[nodiscard]] std::span<const Rung> rungs() const { return rungs_; }
    [[nodiscard]] std::size_t point_count() const;

    /// Replaces all points of the ring by `count` threads: parallel to the borders where these are straight, and the
    /// denser the nearer they are to a border, as facets of other directions are there.
    void lay_threads(std::size_t count);
    /// Plans threads by the shape of the ring, see RingThreads. Returns their number, or 0.
    [[nodiscard]] std::size_t plan(bool is_quick);
    /// Replaces all points of the ring by what was planned for it.
    void lay_planned_threads();

private:
    struct Step {
        Rung rung;
        int side = 0;  ///< where the ring goes on
        double width = 0;
    };
    [[nodiscard]] std::uint32_t across(const Facet& facet, std::uint32_t side) const;
    bool advance(Step& step) const;

    SplitModel& model_;
    RingThreads threads_;
    std::vector<Rung> rungs_;
    std::vector<double> places_;
    std::vector<double> reversed_places_;
    double width_ = 0;  ///< of the facets, as a part of their rungs
};

}  // namespace delmesh
