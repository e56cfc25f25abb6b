#pragma once
// Makes parts Delaunay by sliding many points along their edges at once, without adding any.

#include "base/let_go.hpp"
#include "delaunay/split_model.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delmesh {

/// In long thin facets the place of each point is decided by its neighbours' to within a small part of their distance,
/// so single points have nowhere to go. Here all parts that are not Delaunay, each of which depends on four points at
/// most, are linearised, and the points move by the damped least-squares solution, step by step (Gauss-Newton, inner
/// problems by conjugate gradients). Deterministic.
class SplitSlide {
public:
    explicit SplitSlide(SplitModel& model) : model_(model) {}

    /// True if nothing is suspected any more. Gives up after `steps` steps, or as soon as more than `most_points`
    /// points would have to move; then something bad stays suspected.
    bool run(std::size_t steps, std::size_t most_points);

    /// Gives back the memory that it keeps for each edge between two runs.
    void rest() { let_go(slots_); }

private:
    /// A part that should have a larger sum of cotangents, to first order in how far points move.
    struct Row {
        std::array<std::uint32_t, 4> variable{};
        std::array<double, 4> slope{};
        std::uint32_t count = 0;
        double missing = 0;
    };
    struct Slot {
        std::uint32_t first = 0;  ///< variable of the edge's first point
        std::uint32_t round = 0;
        std::uint32_t watched = 0;
    };

    void make_slots();
    void watch_suspects();
    [[nodiscard]] bool linearise(std::size_t most_points);
    [[nodiscard]] bool add_row(std::uint32_t e, std::size_t part);
    void add_entry(Row& row, std::uint32_t edge, std::size_t point, double slope);
    void solve();
    [[nodiscard]] bool move();

    SplitModel& model_;
    std::vector<Slot> slots_;  ///< per edge
    std::uint32_t run_ = 0;
    std::uint32_t round_ = 0;
    std::vector<std::uint32_t> watched_;
    std::vector<std::uint32_t> edges_;  ///< with variables, in order
    std::vector<double> room_;          ///< per variable: how far it is to the next point, as a part of the edge
    std::vector<Row> rows_;
    std::vector<double> change_;
    std::vector<double> gradient_;
    std::vector<double> direction_;
    std::vector<double> residual_;
    std::vector<double> image_;
    std::vector<double> places_;
};

}  // namespace delmesh
