#pragma once
// Threads of points around a ring of long thin facets, chosen so that no part between two of them is bad.

#include "delaunay/split_model.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delmesh {

/// An edge between two facets of a ring. The ring has two borders; the edge runs from the first to the second, unless
/// it is reversed.
struct Rung {
    std::uint32_t edge = 0;
    bool reversed = false;
};

/// A thread at distance d from a border follows it where facets are wide against d, and crosses facets that are narrow
/// against d at right angles: there a part between two threads is Delaunay, however long it is. It is the minimum of a
/// quadratic, one linear equation for each rung. From each border the next thread is the farthest of these that leaves
/// no part bad, and so on until the threads from both borders meet. Cost: linear in the length of the ring.
class RingThreads {
public:
    explicit RingThreads(const SplitModel& model) : model_(model) {}

    /// False if no threads are found. The last rung is joined to the first one.
    /// Quick: the first threads that are found, which may not be the fewest.
    [[nodiscard]] bool plan(std::span<const Rung> rungs, bool is_quick);
    /// The number of threads planned.
    [[nodiscard]] std::size_t count() const { return from_border_[0] + from_border_[1]; }
    /// Their places on a rung, in the direction of its edge.
    void places(std::size_t rung, std::vector<double>& places) const;

private:
    static constexpr std::size_t styles = 5;
    using Thread = std::vector<double>;  ///< for each rung the distance from a border

    /// The facet between a rung and the next one, in the frame of the rung: the border is at 0, the rung the x axis.
    struct Joint {
        Point2 start;      ///< of the next rung
        Point2 along;      ///< its direction
        double lean = 0;   ///< how much farther from the border the next rung begins, as seen along both of them
        double width = 0;  ///< at the border
        double widening = 0;
    };
    /// Which threads are preferred: none does best everywhere.
    struct Taste {
        double stiffness = 1;
        bool prefers_stiff = false;
    };
    static constexpr std::array<Taste, 4> tastes{{{10, true}, {10, false}, {1, true}, {1, false}}};
    struct Try {
        std::size_t number = 0;
        double distance = 0;
    };
    /// From one border.
    struct Growth {
        std::vector<Try> chosen;  ///< the tries that the threads come from
        std::size_t from = 0;     ///< the number of the next one
        std::size_t tries = 0;
        int dead_ends = 0;
    };
    using Joints = std::vector<Joint>;  ///< as seen from one border

    bool lay_out(std::span<const Rung> rungs);
    [[nodiscard]] Joint joint(const Side& from, const Side& to, const Rung& rung, const Rung& next, double length,
                              bool mirrored) const;
    void find_sizes();
    void relax(int border, std::size_t style, double distance, Thread& thread);
    void solve(std::vector<double> diagonal, std::vector<double> right, Thread& solution) const;
    [[nodiscard]] std::size_t bad_parts(int border, const Thread& below, const Thread& above, std::size_t most) const;
    [[nodiscard]] bool fits(int border, const Thread& below, const Thread& above) const {
        return bad_parts(border, below, above, 0) == 0;
    }
    void start(int border);
    [[nodiscard]] bool grow_once(int border);
    void grow(int border);
    [[nodiscard]] bool grow_until_joined();
    void list_distances(double last);
    [[nodiscard]] bool find_next(int border, const Thread& below, double last, Try& next, std::size_t& tries);
    [[nodiscard]] bool join(std::size_t most);
    [[nodiscard]] bool meets_last(int border);
    void mirror(const Thread& thread, Thread& other) const;

    const SplitModel& model_;
    std::span<const Rung> rungs_;
    std::vector<double> distances_;
    Taste taste_;
    double step_ = 0;      ///< from one distance that is tried to the next, as a factor
    double shortest_ = 0;  ///< rung
    std::vector<double> lengths_;
    std::array<std::vector<double>, styles> sizes_;  ///< for each rung: what is wide enough for threads to go farther
    std::array<Joints, 2> joints_;
    std::array<std::vector<Thread>, 2> threads_;
    std::array<Growth, 2> growth_;
    std::array<std::vector<Thread>, 2> best_;
    std::array<std::size_t, 2> from_border_{};
    std::vector<double> stiffness_;
    Thread thread_;
};

}  // namespace delmesh
