#pragma once
// Threads in parallel planes, for needles of which each leans a little.

#include "delaunay/slice_levels.hpp"
#include "delaunay/split_model.hpp"
#include "delaunay/split_repair.hpp"
#include "delmesh/base/context.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delmesh {

/// How far to keep from what rounding spoils.
struct SliceOptions {
    double rounding = 0;      ///< by how much coordinates may be off, relative
    bool everywhere = false;  ///< or only on edges that are distrusted
    bool dents_fans = false;  ///< see SliceLevels
};

/// Lines at right angles to needles that lean wind on and on. Where a plane at right angles to most of them cuts them,
/// threads close after one turn instead, and a part of length l between two planes is Delaunay while l times the lean
/// is less than the widths beside it.
class SliceThreads {
public:
    SliceThreads(SplitModel& model, const SplitRepair& limits, const SliceOptions& options)
        : model_(model),
          limits_(limits),
          options_(options),
          levels_(model, options.rounding, options.dents_fans) {}

    /// The edges to be solved with e: all that are split, open or not Delaunay, as far as they are connected through
    /// facets, or through one more edge.
    void gather(std::uint32_t e);
    [[nodiscard]] const std::vector<std::uint32_t>& edges() const { return edges_; }

    /// Replaces all points on the gathered edges: each bad part is split where the plane through what it sees cuts it,
    /// and halved only when no plane is left. Then the same for what rounding may make bad. Must be in a transaction.
    /// False after very many steps, beyond the limits or what so many edges are worth, or where a part is too short to
    /// be split.
    [[nodiscard]] bool solve(const Context* context);

private:
    enum class Found { nothing, cut, no_plane, no_room };

    void visit(std::uint32_t e, std::size_t rim);
    [[nodiscard]] bool reach(std::uint32_t e);
    [[nodiscard]] bool is_concerned(std::uint32_t e) const;
    [[nodiscard]] double slice(std::uint32_t e, std::size_t part);
    [[nodiscard]] double middle(std::uint32_t e, std::size_t part) const;
    [[nodiscard]] bool is_doubtful(std::uint32_t e, std::size_t part);
    [[nodiscard]] Found split(std::uint32_t e, bool halves);
    [[nodiscard]] bool cut(std::uint32_t e, std::size_t part, double at);
    [[nodiscard]] bool work_off(const Context* context);
    [[nodiscard]] bool split_doubtful(const Context* context);
    [[nodiscard]] bool is_exhausted() const { return limits_.is_exhausted() || model_.work() >= work_limit_; }

    SplitModel& model_;
    const SplitRepair& limits_;
    SliceOptions options_;
    SliceLevels levels_;
    std::vector<std::uint32_t> edges_;
    std::array<std::vector<std::uint32_t>, 3> rim_;
    std::vector<bool> reached_;
    std::size_t steps_ = 0;
    std::uint64_t work_limit_ = 0;
};

}  // namespace delmesh
