#include "delaunay/split_search.hpp"

#include "delaunay/foot_threads.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace delmesh {
namespace {

constexpr int first_rounds = 6;
constexpr std::size_t first_steps = 50;
constexpr std::array<std::size_t, 4> quick_steps{12, 48, 48, 96};
/// In later rounds, see SplitRepair. In the first one edges mend themselves: that takes fewer steps, and no more
/// points.
constexpr double quick_self_share = 0.65;
constexpr std::size_t most_quickly_weaved = 128;
constexpr std::uint64_t ring_share = 5;  ///< of quick work, where there are rings
constexpr std::uint64_t foot_share = 2;  ///< the same, where edges are open in the end
constexpr std::uint64_t look_share = 2;  ///< the same: facets of very many sides are not worth a look
constexpr int mend_tries = 6;
constexpr int shake_tries = 20;
constexpr int close_tries = 3;
constexpr int no_way = -2;
constexpr int foot_way = -1;
constexpr std::size_t weave_steps = 25;  ///< for each edge that may borrow instead
constexpr std::size_t least_feet = 32;
/// The farther feet go the more it matters what shells would cost. Only where few edges are bad that is often much.
constexpr std::size_t most_feet = 512;
constexpr std::size_t most_feet_of_few = 2048;
constexpr std::size_t few_bad_edges = 1000;
constexpr std::size_t most_weaved = 1024;
constexpr std::size_t short_slide = 8;
constexpr std::size_t most_slid_at_once = 400;
constexpr double open_share = 0.5;      ///< of the work, for what is open
constexpr double any_move_share = 0.1;  ///< of the work, for all moves alike
constexpr std::size_t steps_per_point = 3;
constexpr std::size_t least_steps = 8;
constexpr std::size_t few_threads = 3;
constexpr double pair_share = 0.5;
constexpr std::size_t memory = 512;  ///< tries after which what moves have gained counts half
/// The search ends when it takes away less than 1/400 of the points in a stretch of work.
constexpr std::uint64_t work_per_point = 10'000;
constexpr std::uint64_t least_attempt = 100;
constexpr std::uint64_t least_stretch = 2'000'000;
/// Small meshes get more time for each point, as it hardly counts.
constexpr std::uint64_t small_stretch = 25'000'000;
constexpr std::uint64_t small_work_per_point = 60'000;

}  // namespace

// --- construction ---

void SplitSearch::begin_on(std::uint32_t e) {
    model_.begin();
    model_.give_up(e, false);
    model_.add_suspect(e);
}

/// Ends what `begin_on` began.
bool SplitSearch::settle(std::uint32_t e, bool closed) {
    if (closed) {
        model_.commit();
    } else {
        model_.rollback();
        model_.give_up(e, true);
    }
    return closed;
}

/// Tries to make one open edge Delaunay, for a few points more.
bool SplitSearch::attempt(std::uint32_t e, std::size_t steps, bool clear_first) {
    begin_on(e);
    const std::size_t most = model_.point_count() + 10 + steps / 4;
    if (clear_first) {
        targets_.take_edges(e, 2 + random_.below(random_.chance(0.5) ? 8 : 40));
        steps += 6 * targets_.size();
        targets_.remove();
    }
    return settle(e, repair_.run(most, steps, random_.chance(0.8)));
}

void SplitSearch::construct(const std::vector<std::uint32_t>& bad_edges, std::uint64_t work) {
    limit_work(work);
    set_open(bad_edges);
    for (int round = 0; round < first_rounds && !open_.empty(); ++round)
        close_each([&](std::uint32_t e) { return attempt(e, first_steps, round > 0 && random_.chance(0.7)); });
}

void SplitSearch::construct_quickly(const std::vector<std::uint32_t>& bad_edges, std::uint64_t work) {
    is_quick_ = true;
    repair_.be_quick();
    model_.favour_large_facets();
    const std::uint64_t end = model_.work() + work;
    repair_.set_work_limit(model_.work() + work / look_share);
    std::size_t known = 0;
    for (; known < bad_edges.size() && !repair_.is_exhausted(); ++known) model_.prepare(bad_edges[known]);
    set_open({bad_edges.begin(), bad_edges.begin() + static_cast<std::ptrdiff_t>(known)});
    for (std::size_t round = 0; round < quick_steps.size(); ++round) {
        repair_.set_work_limit(end);
        repair_.set_self_share(round == 0 ? 1 : quick_self_share);
        close_each([&](std::uint32_t e) {
            return !repair_.is_exhausted() && attempt(e, quick_steps[round], round > 0 && random_.chance(0.7));
        });
        if (round == 0) close_rings(ring_share * work);
    }
    close_by_feet(foot_share * work, bad_edges.size() < few_bad_edges ? most_feet_of_few : most_feet);
    repair_.set_work_limit(end);
    close_by_weaving();
}

void SplitSearch::close_by_weaving() {
    for (std::size_t size = 8; size <= most_quickly_weaved; size *= 4)
        close_each(
            [&](std::uint32_t e) { return !repair_.is_exhausted() && settle(e, weave(e, weave_steps * size, false)); });
}

void SplitSearch::close_by_feet(std::uint64_t work, std::size_t most) {
    limit_work(work);
    for (std::size_t steps = least_feet; steps <= most && !open_.empty(); steps *= 4)
        close_each([&](std::uint32_t e) { return !repair_.is_exhausted() && settle(e, lay_feet(e, steps)); });
}

void SplitSearch::close_by_slices(std::uint64_t work, const SliceOptions& options, const Context* context) {
    limit_work(work);
    SliceThreads slices(model_, repair_, options);
    std::vector<bool> failed;
    close_each([&](std::uint32_t e) {
        if ((e < failed.size() && failed[e]) || repair_.is_exhausted() || is_cancelled(context)) return false;
        slices.gather(e);
        std::vector<std::uint32_t> open;
        std::copy_if(slices.edges().begin(), slices.edges().end(), std::back_inserter(open),
                     [&](std::uint32_t i) { return model_.is_given_up(i); });
        model_.begin();
        if (slices.solve(context)) {
            model_.commit();
            return true;
        }
        model_.rollback();
        failed.resize(model_.edge_count(), false);
        for (const std::uint32_t i : open) {
            model_.give_up(i, true);
            failed[i] = true;
        }
        return false;
    });
}

void SplitSearch::drop_closed() {
    close_each([](std::uint32_t) { return false; });
}

void SplitSearch::attempt_any_open() {
    const std::size_t i = random_.below(open_.size());
    const std::uint32_t e = open_[i];
    if (model_.first_bad(e) < 0) {
        model_.give_up(e, false);
    } else if (!attempt(e, first_steps << random_.below(5), random_.chance(0.5))) {
        return;
    }
    open_[i] = open_.back();
    open_.pop_back();
}

// --- borrowing ---

std::span<const PlacedPoint> SplitSearch::others_on(std::uint32_t e) const {
    const auto by_edge = [](const PlacedPoint& a, const PlacedPoint& b) { return a.edge < b.edge; };
    const auto [first, last] = std::equal_range(other_.begin(), other_.end(), PlacedPoint{e, 0}, by_edge);
    return {first, last};
}

/// The edges nearest to e by facets, of those that are split here or there.
void SplitSearch::gather_ball(std::uint32_t e, std::size_t size) {
    edges_.assign(1, e);
    ++ball_;
    const auto reach = [&](std::uint32_t other) {
        if (reached_.size() <= other) reached_.resize(model_.layout().edge_count() + 1, 0);
        if (reached_[other] == ball_) return false;
        reached_[other] = ball_;
        return true;
    };
    reach(e);
    for (std::size_t done = 0; done < edges_.size() && edges_.size() < size; ++done) {
        model_.prepare(edges_[done]);
        const std::array<std::uint32_t, 2> sides = model_.layout().edge(edges_[done]).side;
        for (const std::uint32_t s : sides) {
            if (s == SplitModel::none) continue;
            const Facet facet = model_.layout().facet(model_.layout().facet_at(s));
            for (std::uint32_t i = facet.first_side; i < facet.first_side + facet.side_count; ++i) {
                const std::uint32_t other = model_.layout().edge_at(i);
                if (!model_.is_movable(other) || (model_.point_count(other) == 0 && others_on(other).empty())) continue;
                if (reach(other)) edges_.push_back(other);
            }
        }
    }
}

/// Takes over the other solution's points on `size` edges around e, then mends what does not fit at the rim.
bool SplitSearch::borrow(std::uint32_t e, std::size_t size) {
    gather_ball(e, size);
    begin_on(e);
    for (const std::uint32_t edge : edges_) {
        borrowed_.clear();
        for (const PlacedPoint& point : others_on(edge)) borrowed_.push_back(point.at);
        model_.prepare(edge);
        model_.cut(edge, 0, model_.point_count(edge), borrowed_);
    }
    const std::size_t most = model_.point_count() + 20 + edges_.size();
    return repair_.run(most, 50 + 4 * edges_.size(), random_.chance(0.5));
}

/// Adds points until all is Delaunay again.
bool SplitSearch::weave(std::uint32_t e, std::size_t steps, bool clear_first) {
    begin_on(e);
    if (clear_first) {
        targets_.take_edges(e, 2 + random_.below(40));
        targets_.remove();
    }
    return repair_.weave(model_.point_count() + steps, steps);
}

/// The same, at right angles to the edges.
bool SplitSearch::lay_feet(std::uint32_t e, std::size_t steps) {
    begin_on(e);
    return lay_foot_threads(model_, repair_, model_.point_count() + steps, steps);
}

/// One of several ways, in a transaction that is left open. Returns the number of points then.
std::size_t SplitSearch::close_by(int way, std::uint32_t e, std::size_t size) {
    const bool closed = way == foot_way     ? lay_feet(e, weave_steps * size)
                        : way < close_tries ? weave(e, weave_steps * size, way > 0)
                                            : borrow(e, size);
    return closed ? model_.point_count() : std::numeric_limits<std::size_t>::max();
}

void SplitSearch::close_open(std::uint64_t work) {
    limit_work(work);
    const std::uint64_t end = model_.work() + work;
    for (std::size_t size = 8; !open_.empty() && !repair_.is_exhausted(); size *= 2) {
        std::size_t largest = other_.empty() && size < most_weaved ? size : 0;
        close_each([&](std::uint32_t e) {
            Random best = random_;
            std::size_t fewest = std::numeric_limits<std::size_t>::max();
            int way = no_way;
            for (int i = foot_way; i < 2 * close_tries && !repair_.is_exhausted(); ++i) {
                if (i >= close_tries && other_.empty()) break;
                const Random before = random_;
                const std::size_t points = close_by(i, e, size);
                model_.rollback();
                model_.give_up(e, true);
                if (i >= close_tries) largest = std::max(largest, edges_.size());
                if (points >= fewest) continue;
                fewest = points;
                best = before;
                way = i;
            }
            if (way == no_way) return false;
            // Again, as it was then.
            random_ = best;
            repair_.set_work_limit(~std::uint64_t{0});
            const bool closed = settle(e, close_by(way, e, size) == fewest);
            repair_.set_work_limit(end);
            return closed;
        });
        if (largest < size) break;
    }
    close_by_feet(work / 4, most_feet_of_few);
    limit_work(work / 4);
    close_by_weaving();
}

// --- mending ---

/// Puts the points around an edge elsewhere.
bool SplitSearch::shake(std::uint32_t e) {
    for (const Part& part : model_.parts(e))
        for (const std::uint32_t culprit : part.culprit)
            if (culprit != SplitModel::none) model_.distrust(culprit);
    for (int i = 0; i < shake_tries && !repair_.is_exhausted(); ++i) {
        targets_.take_edges(e, std::size_t{4} << (i / 4));
        if (targets_.size() == 0) continue;
        const std::size_t steps = (6 * targets_.size() + 20) << (i / 4);
        const std::size_t most = model_.point_count() + 2 + steps / 10;
        model_.begin();
        targets_.remove();
        model_.add_suspect(e);
        if (repair_.run(most, steps, random_.chance(0.5))) {
            model_.commit();
            return true;
        }
        model_.rollback();
    }
    return false;
}

bool SplitSearch::mend(const std::vector<std::uint32_t>& edges, std::uint64_t work) {
    limit_work(work);
    bool changed = false;
    std::vector<bool> again;
    for (const std::uint32_t e : edges) {
        model_.prepare(e);
        again.push_back(model_.is_distrusted(e));
        model_.distrust(e);
    }
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const std::uint32_t e = edges[k];
        if (model_.is_given_up(e)) continue;
        if (model_.first_bad(e) < 0) {
            // The model can not tell what is wrong.
            changed = (again[k] && relay(e)) || shake(e) || changed;
            continue;
        }
        bool closed = false;
        for (int i = 0; i < mend_tries && !closed && !repair_.is_exhausted(); ++i)
            closed = attempt(e, first_steps << (i / 2), i > 0);
        if (!closed) open_.push_back(e);
        changed = changed || closed;
    }
    return changed;
}

// --- improvement ---

bool SplitSearch::is_spare(std::uint32_t e) const {
    return model_.point_count(e) > (model_.layout().edge(e).is_delaunay ? 0u : 1u);
}

void SplitSearch::find_spare_edges() {
    spare_.clear();
    for (std::uint32_t e = 0; e < model_.edge_count(); ++e)
        if (is_spare(e) && model_.is_movable(e)) spare_.insert(spare_.end(), 1 + model_.point_count(e) / 4, e);
}

void SplitSearch::improve(std::uint64_t work, const Context* context) {
    limit_work(work);
    const std::uint64_t start = model_.work();
    const std::uint64_t points_now = model_.point_count();
    const std::uint64_t stretch =
        patience_ * std::max({work_per_point * points_now, std::min(small_work_per_point * points_now, small_stretch),
                              least_stretch});
    std::uint64_t check = start + stretch;
    std::size_t points_then = model_.point_count() + open_.size();
    std::size_t since = 0;
    std::uint64_t open_work = 0;
    find_spare_edges();
    while (!spare_.empty() || !open_.empty()) {
        if (model_.work() - start >= work || is_cancelled(context)) return;
        if (model_.work() >= check) {
            const std::size_t points = model_.point_count() + open_.size();
            if (open_.empty() && points <= points_then && 400 * (points_then - points) < points_then) return;
            points_then = points;
            check = model_.work() + stretch;
            if (!is_quiet_)
                report_progress(context, "place",
                                static_cast<double>(model_.work() - start) / static_cast<double>(work));
        }
        const std::uint64_t done = model_.work() - start;
        if (!open_.empty() &&
            (spare_.empty() || static_cast<double>(open_work) <= open_share * static_cast<double>(done))) {
            attempt_any_open();
            // Where nothing may move, attempts end before they have done any work, and would never use it up.
            const std::uint64_t spent = model_.work() - start - done;
            if (spent < least_attempt) model_.count_work(least_attempt - spent);
            open_work += model_.work() - start - done;
        } else {
            const std::size_t i = random_.below(spare_.size());
            const std::uint32_t e = spare_[i];
            if (is_spare(e)) {
                try_once(e);
                ++since;
            } else {
                spare_[i] = spare_.back();
                spare_.pop_back();
            }
        }
        if (!spare_.empty() && since <= 2 * spare_.size() + 50) continue;
        find_spare_edges();
        since = 0;
    }
}

/// Each gets work in proportion to what it has gained per work, and a little more.
SplitSearch::Move& SplitSearch::choose_move() {
    double rates = 0;
    for (const Move& move : moves_) rates += move.gain / move.work;
    const double more = any_move_share / (1 - any_move_share) * rates / static_cast<double>(moves_.size());
    const auto share = [&](const Move& move) { return (move.gain / move.work + more) * move.tries / move.work; };
    double sum = 0;
    for (const Move& move : moves_) sum += share(move);
    double left = sum * random_.uniform();
    for (Move& move : moves_) {
        left -= share(move);
        if (left < 0) return move;
    }
    return moves_.front();
}

void SplitSearch::forget_gains() {
    for (Move& move : moves_) {
        move.gain = 0.5 * move.gain + 1e-3;
        move.work = 0.5 * move.work + 1e-3;
        move.tries = 0.5 * move.tries + 1e-3;
    }
}

void SplitSearch::try_once(std::uint32_t edge) {
    Move& move = choose_move();
    take(move, edge);
    const std::size_t before = model_.point_count();
    const std::uint64_t work_before = model_.work();
    const std::size_t steps = steps_per_point * targets_.size() + least_steps;
    model_.begin();
    targets_.remove();
    if (move.kind == Kind::slide) slide_.run(short_slide, most_slid_at_once);
    if (random_.chance(0.5))
        for (std::size_t i = model_.suspect_count(); i > 1; --i) model_.swap_suspects(i - 1, random_.below(i));
    if (move.weaves ? repair_.weave(before, 2 * steps) : repair_.run(before, steps, random_.chance(0.5))) {
        model_.commit();
        move.gain += static_cast<double>(before - model_.point_count());
    } else {
        model_.rollback();
    }
    ++move.tries;
    move.work += 1e-4 * static_cast<double>(model_.work() - work_before);
    if (++tries_ % memory == 0) forget_gains();
}

void SplitSearch::take(const Move& move, std::uint32_t edge) {
    const std::size_t n = model_.point_count(edge);
    const SplitTargets::Point seed{edge, model_.parts(edge)[n == 1 ? 0 : random_.below(n)].end};
    const std::size_t size = move.least + random_.below(move.most - move.least + 1);
    switch (move.kind) {
        case Kind::cluster:
            return targets_.take_cluster(seed, size);
        case Kind::edges:
            return targets_.take_edges(edge, size);
        case Kind::thread:
        case Kind::slide:
            // Threads of a strip lean to one side and the other by turns, so one alone can seldom go.
            if (n >= few_threads && random_.chance(pair_share)) return targets_.take_threads(seed, 2 * size);
            return targets_.take_thread(seed, size);
    }
}

}  // namespace delmesh
