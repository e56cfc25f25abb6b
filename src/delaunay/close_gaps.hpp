#pragma once
// Fewer points where a solution has more than the proved bound, by an exhaustive search of a few edges at a time.

#include "base/random.hpp"
#include "delaunay/split_bound.hpp"
#include "delaunay/split_model.hpp"
#include "delaunay/split_repair.hpp"
#include "delmesh/base/context.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delmesh {

class GapCloser {
public:
    /// `bad`: the edges that must be split.
    GapCloser(SplitModel& model, std::span<const EdgeId> bad, const SplitBoundOptions& options, std::uint64_t seed,
              const Context* context);
    GapCloser(const GapCloser&) = delete;
    GapCloser& operator=(const GapCloser&) = delete;

    /// Takes points away, and raises the bound, for about so many units of the model's work. All edges must be Delaunay
    /// as the points are. Deterministic.
    void run(std::uint64_t work, const Context* context);
    /// No method needs fewer points.
    [[nodiscard]] std::size_t bound() const { return bound_.points(); }

private:
    void count_points();
    bool replace(std::span<const std::uint32_t> edges, std::span<const VaguePoint> places);
    bool replace_once(std::span<const std::uint32_t> edges, std::span<const VaguePoint> places, std::size_t steps);
    [[nodiscard]] std::uint32_t id_of(std::uint32_t e) const;
    [[nodiscard]] double along_edge(std::uint32_t id, double t) const;

    SplitModel& model_;
    Random random_;
    SplitRepair repair_;
    SplitBound bound_;
    GapTask task_;
    std::vector<double> points_;
};

}  // namespace delmesh
