// The search's way with rings and regions of long thin facets: whole threads of points, laid anew.

#include "delaunay/split_search.hpp"

namespace delmesh {
namespace {

constexpr std::size_t most_rungs = 1 << 20;
constexpr std::size_t long_ring = 32;
constexpr std::size_t largest_ring = 1024;  ///< that is tried with more and more threads
constexpr std::size_t few_threads = 2;      ///< that are tried first in long rings
constexpr std::size_t many_threads = 6;
constexpr std::size_t few_suspects = 16;  ///< one for so many rungs
constexpr std::size_t most_threads = 40;
constexpr std::size_t slide_steps = 60;
constexpr std::size_t most_slid = 20'000;
constexpr std::size_t short_slide = 8;
/// Of a region that is laid anew, and points for each.
constexpr std::size_t least_edges = 8;
constexpr std::size_t dense = 3;

}  // namespace

/// Replaces the points of the ring that has been gathered by that many threads, or, if 0, by those that are planned.
/// Within a transaction.
bool SplitSearch::solve_ring(std::size_t threads) {
    const std::size_t n = ring_.rungs().size();
    const auto weave = [&](std::size_t most) { return repair_.weave(model_.point_count() + most, 3 * most); };
    if (threads > 0) {
        ring_.lay_threads(threads);
        return slide_.run(slide_steps, most_slid) || weave(n > long_ring ? n / few_suspects : n);
    }
    ring_.lay_planned_threads();
    const bool is_near = few_suspects * model_.suspect_count() <= n;
    return (is_near && slide_.run(short_slide, most_slid)) || weave(4 * n);
}

/// Calls solve(threads) with numbers of threads to try, until one is enough: long rings rely on their plan.
template <class Solve>
bool SplitSearch::try_threads(std::size_t most, Solve&& solve) {
    const std::size_t n = ring_.rungs().size();
    const std::size_t planned = ring_.plan(is_quick_);
    bool is_due = planned > 0 && planned <= most;
    if (is_due && n > long_ring) {
        // A plan of many threads tells that few will not do.
        const bool may_do_with_few = !is_quick_ && planned <= many_threads && n <= largest_ring;
        for (std::size_t threads = 1; may_do_with_few && threads < planned && threads <= few_threads; ++threads)
            if (solve(threads)) return true;
        if (solve(0)) return true;
        is_due = false;
    }
    for (std::size_t threads = 1; threads <= most && n <= largest_ring; threads += 1 + threads / 3) {
        if (repair_.is_exhausted()) return false;
        if (is_due && threads >= planned) {
            is_due = false;
            if (solve(0)) return true;
        }
        if (solve(threads)) return true;
    }
    return is_due && solve(0);
}

/// All edges of the ring that has been gathered, as no thread ends in it.
bool SplitSearch::close_ring() {
    edges_.clear();
    for (const Rung& rung : ring_.rungs())
        if (model_.is_given_up(rung.edge)) edges_.push_back(rung.edge);
    return try_threads(most_threads, [&](std::size_t threads) {
        model_.begin();
        for (const std::uint32_t e : edges_) {
            model_.give_up(e, false);
            model_.add_suspect(e);
        }
        if (solve_ring(threads)) {
            model_.commit();
            return true;
        }
        model_.rollback();
        for (const std::uint32_t e : edges_) model_.give_up(e, true);
        return false;
    });
}

void SplitSearch::close_rings(std::uint64_t work) {
    limit_work(work);
    std::vector<bool> tried;
    close_each([&](std::uint32_t e) {
        if ((e < tried.size() && tried[e]) || repair_.is_exhausted() || !ring_.gather(e, most_rungs)) return false;
        if (close_ring()) return true;
        tried.resize(model_.edge_count());
        for (const Rung& rung : ring_.rungs()) tried[rung.edge] = true;
        return false;
    });
    slide_.rest();
}

void SplitSearch::thin_rings(std::uint64_t work) {
    limit_work(work);
    std::vector<bool> done(model_.edge_count());
    for (std::uint32_t e = 0; e < done.size() && !repair_.is_exhausted(); ++e) {
        if (done[e] || model_.point_count(e) == 0 || !model_.is_movable(e)) continue;
        if (!ring_.gather(e, most_rungs)) continue;
        for (const Rung& rung : ring_.rungs())
            if (rung.edge < done.size()) done[rung.edge] = true;
        const std::size_t before = model_.point_count();
        const std::size_t most = (ring_.point_count() - 1) / ring_.rungs().size();
        try_threads(most, [&](std::size_t threads) {
            model_.begin();
            const bool solved = solve_ring(threads) && model_.point_count() < before;
            solved ? model_.commit() : model_.rollback();
            return solved;
        });
    }
    slide_.rest();
}

void SplitSearch::lay_regions(std::uint64_t work, const Context* context) {
    // What comes of it is luck, and must not change the luck of the rest where nothing does.
    Random random = random_;
    RegionThreads region(model_, repair_, random.next());
    std::vector<bool> done(model_.edge_count(), false);
    for (const std::uint32_t e : open_) done[e] = true;
    // False if some were done before.
    const auto mark = [&] {
        bool all = true;
        for (const std::uint32_t e : region.edges()) {
            if (e >= done.size()) continue;
            all = all && !done[e];
            done[e] = true;
        }
        return all;
    };
    const double work_per_point = static_cast<double>(work) / static_cast<double>(model_.point_count() + 1);
    for (std::uint32_t e = 0; e < done.size() && !is_cancelled(context); ++e) {
        if (done[e] || model_.point_count(e) == 0 || !model_.is_movable(e)) continue;
        region.gather(e);
        const std::size_t count = region.point_count();
        const bool is_dense = region.edges().size() >= least_edges && count >= dense * region.edges().size();
        if (!mark() || !is_dense) continue;
        if (!region.thin(static_cast<std::uint64_t>(work_per_point * static_cast<double>(count)), context)) continue;
        region.gather(e);
        (void)mark();
    }
}

/// Lays new threads around the ring of an edge.
bool SplitSearch::relay(std::uint32_t e) {
    if (!ring_.gather(e, largest_ring)) return false;
    for (std::size_t threads = 2; threads <= most_threads && !repair_.is_exhausted(); threads += 1 + threads / 3) {
        model_.begin();
        if (solve_ring(threads)) {
            model_.commit();
            return true;
        }
        model_.rollback();
    }
    return false;
}

}  // namespace delmesh
