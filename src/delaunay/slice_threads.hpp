#pragma once
// Threads in parallel planes, for needles of which each leans a little.

#include "delaunay/split_model.hpp"
#include "delaunay/split_repair.hpp"
#include "delmesh/base/vec3.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delmesh {

/// Lines at right angles to needles that lean wind on and on. Where a plane at right angles to most of them cuts them,
/// threads close after one turn instead, and a part of length l between two planes is Delaunay while l times the lean
/// is less than the widths beside it.
class SliceThreads {
public:
    SliceThreads(SplitModel& model, const SplitRepair& limits) : model_(model), limits_(limits) {}

    /// The edges to be solved with e: all that are split, open or not Delaunay, as far as they are connected through
    /// facets, or through one more edge.
    void gather(std::uint32_t e);
    [[nodiscard]] const std::vector<std::uint32_t>& edges() const { return edges_; }

    /// Replaces all points on the gathered edges: each bad part is split where the plane through what it sees cuts it,
    /// and in the middle only when no plane is left. False after `steps` steps, or beyond the limits.
    [[nodiscard]] bool solve(std::size_t steps);

private:
    struct Levels {
        double from = 0;
        double to = 0;
        [[nodiscard]] double at(double t) const { return from + t * (to - from); }
    };

    void visit(std::uint32_t e, bool is_rim);
    [[nodiscard]] bool reach(std::uint32_t e);
    [[nodiscard]] bool is_concerned(std::uint32_t e) const;
    void find_axis();
    [[nodiscard]] Levels levels(std::uint32_t e) const;
    [[nodiscard]] double level_of(std::uint32_t side, const Contact& seen) const;
    [[nodiscard]] double slice(std::uint32_t e, std::size_t part) const;
    [[nodiscard]] bool split(std::uint32_t e, bool halves);

    SplitModel& model_;
    const SplitRepair& limits_;
    std::vector<std::uint32_t> edges_;
    std::vector<std::uint32_t> rim_;
    std::vector<bool> reached_;
    Vec3 axis_;
};

}  // namespace delmesh
