#pragma once
// A large-neighbourhood search for few split points: take some away, repair what becomes bad, keep what is not worse.

#include "base/random.hpp"
#include "delaunay/region_threads.hpp"
#include "delaunay/slice_threads.hpp"
#include "delaunay/split_model.hpp"
#include "delaunay/split_regions.hpp"
#include "delaunay/split_repair.hpp"
#include "delaunay/split_ring.hpp"
#include "delaunay/split_slide.hpp"
#include "delaunay/split_targets.hpp"
#include "delmesh/base/context.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace delmesh {

class SplitSearch {
public:
    SplitSearch(SplitModel& model, std::uint64_t seed)
        : model_(model),
          random_(seed),
          repair_(model, random_),
          targets_(model, random_),
          slide_(model),
          ring_(model) {}

    /// Tries to make these edges Delaunay, in several rounds of short attempts. What is left stays `open`: such edges
    /// are not Delaunay, and nothing tries to mend them but further attempts.
    void construct(const std::vector<std::uint32_t>& bad_edges, std::uint64_t work);

    /// The same in a fraction of the time, and less well: few and short attempts, rings, and a little weaving.
    /// Edges need not be prepared, and may be neither Delaunay nor `open` in the end.
    void construct_quickly(const std::vector<std::uint32_t>& bad_edges, std::uint64_t work);

    /// Solves the rings of long thin facets that open edges lie in.
    void close_rings(std::uint64_t work);
    /// Solves rings that have points with fewer ones, where that is possible.
    void thin_rings(std::uint64_t work);

    /// Lays threads at right angles to needles in place of all points of a region, where that takes fewer.
    void lay_regions(std::uint64_t work, const Context* context = nullptr);

    /// A solution to borrow from, sorted; must outlive the search.
    void set_other(std::span<const PlacedPoint> other) { other_ = other; }

    /// Weaves points around each open edge, or takes the other solution's points around it and repairs the rim,
    /// whichever takes fewer points.
    void close_open(std::uint64_t work);

    /// Lays threads in parallel planes around each open edge, in place of all that is there.
    void close_by_slices(std::uint64_t work, const SliceOptions& options, const Context* context);

    /// Lets these edges keep a distance from ties, and repairs them. False if nothing has changed.
    bool mend(const std::vector<std::uint32_t>& edges, std::uint64_t work);

    /// Takes points away, and tries to close open edges, until that much work is done or little has come of the last
    /// stretch of it. The number of points never grows but to close an edge.
    void improve(std::uint64_t work, const Context* context = nullptr);

    /// Reports no progress from now on, as a search on another thread must.
    void be_quiet() { is_quiet_ = true; }

    /// `improve` looks at so many times as long a stretch of work before it finds that little comes of it.
    void be_patient(std::uint64_t times) { patience_ = times; }

    /// Takes these edges, which are not Delaunay, for open ones.
    void set_open(const std::vector<std::uint32_t>& edges) {
        open_ = edges;
        for (const std::uint32_t e : open_) model_.give_up(e, true);
    }
    /// Edges that someone else has made Delaunay are open no more.
    void drop_closed();

    /// Edges that are not Delaunay.
    [[nodiscard]] const std::vector<std::uint32_t>& open() const { return open_; }

    /// Moves points away from each other while all stays Delaunay.
    void spread(std::uint64_t work);

    /// Places points around small angles anew, where that leaves larger ones and as few points.
    void polish(std::uint64_t work, const Context* context = nullptr);

private:
    using Target = SplitTargets::Point;
    enum class Kind { cluster, edges, thread, slide };
    /// A way to choose what to take away, and what came of it.
    struct Move {
        Kind kind = Kind::cluster;
        std::size_t least = 1;
        std::size_t most = 1;
        bool weaves = false;
        double gain = 1;
        double work = 1;
        double tries = 1;
    };

    void limit_work(std::uint64_t more) { repair_.set_work_limit(model_.work() + more); }
    bool attempt(std::uint32_t e, std::size_t steps, bool clear_first);
    template <class Close>
    void close_each(Close&& close);
    void begin_on(std::uint32_t e);
    bool settle(std::uint32_t e, bool closed);
    bool weave(std::uint32_t e, std::size_t steps, bool clear_first);
    void close_by_feet(std::uint64_t work, std::size_t most);
    void close_by_weaving();
    bool lay_feet(std::uint32_t e, std::size_t steps);
    bool borrow(std::uint32_t e, std::size_t size);
    std::size_t close_by(int way, std::uint32_t e, std::size_t size);
    bool solve_ring(std::size_t threads);
    template <class Solve>
    bool try_threads(std::size_t most, Solve&& solve);
    bool close_ring();
    bool shake(std::uint32_t e);
    bool relay(std::uint32_t e);
    void gather_ball(std::uint32_t e, std::size_t size);
    [[nodiscard]] std::span<const PlacedPoint> others_on(std::uint32_t e) const;
    void attempt_any_open();
    void try_once(std::uint32_t edge);
    Move& choose_move();
    void forget_gains();
    void find_spare_edges();
    [[nodiscard]] bool is_spare(std::uint32_t e) const;

    void take(const Move& move, std::uint32_t edge);
    [[nodiscard]] double smallest_angle(std::uint32_t e, Target& near);
    [[nodiscard]] double penalty_before(std::uint32_t e) const;
    void polish_edge(std::uint32_t e);
    void try_to_polish(const Target& near);
    void find_small_angles(std::vector<std::uint32_t>& edges);
    [[nodiscard]] double point_at(const Side& side, std::uint32_t on, Point2 place) const;
    [[nodiscard]] Target point_near(std::uint32_t e, std::size_t i, std::size_t k, Point2 apex);

    SplitModel& model_;
    bool is_quiet_ = false;
    bool is_quick_ = false;
    std::uint64_t patience_ = 1;
    Random random_;
    SplitRepair repair_;
    SplitTargets targets_;
    SplitSlide slide_;
    SplitRing ring_;
    std::array<Move, 12> moves_{{
        {Kind::cluster, 1, 1},
        {Kind::cluster, 2, 2},
        {Kind::cluster, 3, 7},
        {Kind::cluster, 8, 20},
        {Kind::edges, 2, 7},
        {Kind::edges, 8, 20},
        {Kind::edges, 21, 50},
        {Kind::edges, 4, 40, true},
        {Kind::thread, 2, 13},
        {Kind::thread, 14, 100},
        {Kind::slide, 1, 4},
        {Kind::slide, 5, 50},
    }};
    std::size_t tries_ = 0;
    std::span<const PlacedPoint> other_;
    std::vector<std::uint32_t> open_;
    std::vector<std::uint32_t> spare_;
    std::vector<std::uint32_t> edges_;
    std::vector<double> borrowed_;
    std::vector<std::uint32_t> reached_;  ///< per edge: the last ball that it was reached by
    std::uint32_t ball_ = 0;
    std::vector<double> angles_;  ///< per edge, while polishing: the sine of the smallest angle of its triangles
    std::vector<double> new_angles_;
};

/// Keeps those edges open that are neither Delaunay by now nor get closed.
template <class Close>
void SplitSearch::close_each(Close&& close) {
    std::size_t left = 0;
    for (const std::uint32_t e : open_) {
        if (model_.first_bad(e) < 0) {
            model_.give_up(e, false);
        } else if (!close(e)) {
            open_[left++] = e;
        }
    }
    open_.resize(left);
}

}  // namespace delmesh
