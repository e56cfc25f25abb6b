#include "delaunay/split_search.hpp"

#include <algorithm>
#include <limits>

namespace delmesh {
namespace {

constexpr int first_rounds = 6;
constexpr std::size_t first_steps = 50;
constexpr int mend_tries = 6;
constexpr int shake_tries = 20;
constexpr int close_tries = 3;
constexpr std::size_t weave_steps = 25;  ///< for each edge that may borrow instead
constexpr std::size_t most_weaved = 1024;
constexpr std::size_t largest_ring = 1024;
constexpr std::size_t most_threads = 40;
constexpr std::size_t slide_steps = 60;
constexpr std::size_t most_slid = 20'000;
constexpr double open_share = 0.3;
constexpr double any_move_share = 0.4;
constexpr std::size_t memory = 512;  ///< tries after which what moves have gained counts half
constexpr std::size_t many_sides = 8;
constexpr std::size_t very_many_sides = 64;
constexpr std::size_t most_taken = 400;
/// The search ends when it takes away less than 1/400 of the points in a stretch of work.
constexpr std::uint64_t work_per_point = 10'000;
constexpr std::uint64_t least_stretch = 2'000'000;
/// Small meshes get more time for each point, as it hardly counts.
constexpr std::uint64_t small_stretch = 25'000'000;
constexpr std::uint64_t small_work_per_point = 60'000;
constexpr double infinity = std::numeric_limits<double>::infinity();

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

/// Tries to make one open edge Delaunay, for a few points more.
bool SplitSearch::attempt(std::uint32_t e, std::size_t steps, bool clear_first) {
    begin_on(e);
    const std::size_t most = model_.point_count() + 10 + steps / 4;
    if (clear_first) {
        take_edges(e, 2 + random_.below(random_.chance(0.5) ? 8 : 40));
        steps += 6 * taken_.size();
        remove_taken();
    }
    return settle(e, repair_.run(most, steps, random_.chance(0.8)));
}

void SplitSearch::construct(const std::vector<std::uint32_t>& bad_edges, std::uint64_t work) {
    limit_work(work);
    set_open(bad_edges);
    for (int round = 0; round < first_rounds && !open_.empty(); ++round)
        close_each([&](std::uint32_t e) { return attempt(e, first_steps, round > 0 && random_.chance(0.7)); });
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
            const Facet facet = model_.layout().facet(model_.layout().side(s).facet);
            for (std::uint32_t i = facet.first_side; i < facet.first_side + facet.side_count; ++i) {
                const std::uint32_t other = model_.layout().side(i).edge;
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
    return settle(e, repair_.run(most, 50 + 4 * edges_.size(), random_.chance(0.5)));
}

/// Adds points until all is Delaunay again.
bool SplitSearch::weave(std::uint32_t e, std::size_t steps, bool clear_first) {
    begin_on(e);
    if (clear_first) {
        take_edges(e, 2 + random_.below(40));
        remove_taken();
    }
    return settle(e, repair_.weave(model_.point_count() + steps, steps));
}

void SplitSearch::close_open(std::uint64_t work) {
    limit_work(work);
    for (std::size_t size = 8; !open_.empty() && !repair_.is_exhausted(); size *= 2) {
        std::size_t largest = other_.empty() && size < most_weaved ? size : 0;
        close_each([&](std::uint32_t e) {
            bool closed = false;
            for (int i = 0; i < close_tries && !closed && !repair_.is_exhausted(); ++i)
                closed = weave(e, weave_steps * size, i > 0);
            for (int i = 0; i < close_tries && !closed && !other_.empty() && !repair_.is_exhausted(); ++i) {
                closed = borrow(e, size);
                largest = std::max(largest, edges_.size());
            }
            return closed;
        });
        if (largest < size) return;
    }
}

// --- rings ---

/// Replaces the points of the ring that has been gathered by that many threads. Within a transaction.
bool SplitSearch::solve_ring(std::size_t threads) {
    const std::size_t n = ring_.rungs().size();
    ring_.lay_threads(threads);
    return slide_.run(slide_steps, most_slid) || repair_.weave(model_.point_count() + n, 4 * n);
}

void SplitSearch::close_rings(std::uint64_t work) {
    limit_work(work);
    close_each([&](std::uint32_t e) {
        if (!ring_.gather(e, largest_ring)) return false;
        for (std::size_t threads = 1; threads <= most_threads && !repair_.is_exhausted(); threads += 1 + threads / 3) {
            begin_on(e);
            if (settle(e, solve_ring(threads))) return true;
        }
        return false;
    });
}

void SplitSearch::thin_rings(std::uint64_t work) {
    limit_work(work);
    std::vector<bool> done(model_.edge_count());
    for (std::uint32_t e = 0; e < done.size() && !repair_.is_exhausted(); ++e) {
        if (done[e] || model_.point_count(e) == 0 || !model_.is_movable(e)) continue;
        if (!ring_.gather(e, largest_ring)) continue;
        for (const Rung& rung : ring_.rungs())
            if (rung.edge < done.size()) done[rung.edge] = true;
        const std::size_t before = model_.point_count();
        const std::size_t most = ring_.point_count() / ring_.rungs().size();
        bool solved = false;
        for (std::size_t threads = 1; threads <= most && !solved; threads += 1 + threads / 3) {
            model_.begin();
            solved = solve_ring(threads) && model_.point_count() < before;
            solved ? model_.commit() : model_.rollback();
        }
    }
}

// --- mending ---

/// Puts the points around an edge elsewhere.
bool SplitSearch::shake(std::uint32_t e) {
    for (int i = 0; i < shake_tries && !repair_.is_exhausted(); ++i) {
        take_edges(e, std::size_t{4} << (i / 4));
        if (taken_.empty()) continue;
        const std::size_t most = model_.point_count() + 2 + taken_.size() / 2;
        model_.begin();
        remove_taken();
        if (repair_.run(most, 6 * taken_.size() + 20, random_.chance(0.5))) {
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
    for (const std::uint32_t e : edges) {
        model_.prepare(e);
        model_.distrust(e);
    }
    for (const std::uint32_t e : edges) {
        if (model_.is_given_up(e)) continue;
        if (model_.first_bad(e) < 0) {
            // The model can not tell what is wrong.
            changed = shake(e) || changed;
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
        if (is_spare(e) && model_.is_movable(e)) spare_.push_back(e);
}

void SplitSearch::improve(std::uint64_t work, const Context* context) {
    limit_work(work);
    const std::uint64_t start = model_.work();
    const std::uint64_t points_now = model_.point_count();
    const std::uint64_t stretch = std::max(
        {work_per_point * points_now, std::min(small_work_per_point * points_now, small_stretch), least_stretch});
    std::uint64_t check = start + stretch;
    std::size_t points_then = model_.point_count() + open_.size();
    std::size_t since = 0;
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
        if (!open_.empty() && (spare_.empty() || random_.chance(open_share))) {
            attempt_any_open();
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

SplitSearch::Move& SplitSearch::choose_move() {
    if (random_.chance(any_move_share)) return moves_[random_.below(moves_.size())];
    double sum = 0;
    for (const Move& move : moves_) sum += move.gain / move.work;
    double left = sum * random_.uniform();
    for (Move& move : moves_) {
        left -= move.gain / move.work;
        if (left < 0) return move;
    }
    return moves_.front();
}

void SplitSearch::forget_gains() {
    for (Move& move : moves_) {
        move.gain = 0.5 * move.gain + 1e-3;
        move.work = 0.5 * move.work + 1e-3;
    }
}

void SplitSearch::try_once(std::uint32_t edge) {
    Move& move = choose_move();
    take(move, edge);
    const std::size_t before = model_.point_count();
    const std::uint64_t work_before = model_.work();
    const std::size_t steps = 6 * taken_.size() + 20;
    model_.begin();
    remove_taken();
    if (random_.chance(0.5))
        for (std::size_t i = model_.suspect_count(); i > 1; --i) model_.swap_suspects(i - 1, random_.below(i));
    if (move.weaves ? repair_.weave(before, 2 * steps) : repair_.run(before, steps, random_.chance(0.5))) {
        model_.commit();
        move.gain += static_cast<double>(before - model_.point_count());
    } else {
        model_.rollback();
    }
    move.work += 1e-4 * static_cast<double>(model_.work() - work_before);
    if (++tries_ % memory == 0) forget_gains();
}

// --- what to take away ---

void SplitSearch::take(const Move& move, std::uint32_t edge) {
    const std::size_t n = model_.point_count(edge);
    const Target seed{edge, model_.parts(edge)[n == 1 ? 0 : random_.below(n)].end};
    const std::size_t size = move.least + random_.below(move.most - move.least + 1);
    switch (move.kind) {
        case Kind::cluster:
            return take_cluster(seed, size);
        case Kind::edges:
            return take_edges(edge, size);
        case Kind::thread:
            return take_thread(seed, size);
    }
}

bool SplitSearch::is_taken(const Target& t) const {
    return std::any_of(taken_.begin(), taken_.end(),
                       [&](const Target& other) { return other.edge == t.edge && other.at == t.at; });
}

/// The nearest points on the other sides of a facet; in a facet with many sides, the nearest one of all.
void SplitSearch::add_nearest(const Side& from, Point2 at) {
    const Facet& facet = model_.layout().facet(from.facet);
    Target nearest;
    double least = infinity;
    for (std::uint32_t s = facet.first_side; s < facet.first_side + facet.side_count; ++s) {
        const Side& side = model_.layout().side(s);
        const std::size_t n = model_.point_count(side.edge);
        if (n == 0 || side.edge == from.edge || !model_.is_movable(side.edge)) continue;
        const auto parts = model_.parts(side.edge);
        std::size_t i = 0;
        if (n > 1) {
            const double t = dot(at - side.start, side.x_row);
            i = std::min(model_.part_at(side.edge, t), n - 1);
            if (i > 0 && t - parts[i - 1].end < parts[i].end - t) --i;
        }
        const Target target{side.edge, parts[i].end};
        if (facet.side_count <= many_sides) {
            nearby_.push_back(target);
            continue;
        }
        const Point2 d = side.at(target.at) - at;
        if (dot(d, d) >= least) continue;
        least = dot(d, d);
        nearest = target;
    }
    if (least < infinity) nearby_.push_back(nearest);
}

void SplitSearch::add_neighbours(const Target& of) {
    const std::size_t i = model_.part_at(of.edge, of.at);
    const auto parts = model_.parts(of.edge);
    if (i > 0) nearby_.push_back({of.edge, parts[i - 1].end});
    if (i + 2 < parts.size()) nearby_.push_back({of.edge, parts[i + 1].end});
    for (const std::uint32_t s : model_.layout().edge(of.edge).side)
        if (s != SplitModel::none) add_nearest(model_.layout().side(s), model_.layout().side(s).at(of.at));
}

/// Neighbouring points, in random order.
void SplitSearch::take_cluster(Target seed, std::size_t size) {
    nearby_.clear();
    taken_.assign(1, seed);
    if (size > 1) add_neighbours(seed);
    while (taken_.size() < size && !nearby_.empty()) {
        const std::size_t i = random_.below(nearby_.size());
        const Target next = nearby_[i];
        nearby_[i] = nearby_.back();
        nearby_.pop_back();
        if (is_taken(next)) continue;
        taken_.push_back(next);
        add_neighbours(next);
    }
}

/// All points of neighbouring edges.
void SplitSearch::take_edges(std::uint32_t edge, std::size_t size) {
    const FacetLayout& layout = model_.layout();
    taken_.clear();
    edges_.assign(1, edge);
    for (std::size_t done = 0; done < edges_.size() && done < size && taken_.size() < most_taken; ++done) {
        if (done > 0) std::swap(edges_[done], edges_[done + random_.below(edges_.size() - done)]);
        const std::uint32_t e = edges_[done];
        for (const Part& part : model_.parts(e).first(model_.point_count(e))) taken_.push_back({e, part.end});
        for (const std::uint32_t s : layout.edge(e).side) {
            if (s == SplitModel::none) continue;
            const Facet& facet = layout.facet(layout.side(s).facet);
            if (facet.side_count > very_many_sides) continue;
            for (std::uint32_t i = facet.first_side; i < facet.first_side + facet.side_count; ++i) {
                const std::uint32_t other = layout.side(i).edge;
                if (model_.point_count(other) == 0 || !model_.is_movable(other)) continue;
                if (std::find(edges_.begin(), edges_.end(), other) == edges_.end()) edges_.push_back(other);
            }
        }
    }
}

/// Moves `at` across the facet at side k of its edge to the nearest point there, and k to the far side of the edge that
/// it comes to.
bool SplitSearch::move_across(int& k, Target& at) {
    const FacetLayout& layout = model_.layout();
    const std::uint32_t s = layout.edge(at.edge).side[k];
    if (s == SplitModel::none) return false;
    const Side& from = layout.side(s);
    const Point2 p = from.at(at.at);
    nearby_.clear();
    add_nearest(from, p);
    double least = infinity;
    for (const Target& t : nearby_) {
        if (is_taken(t)) continue;
        const auto& sides = layout.edge(t.edge).side;
        const int near = sides[0] != SplitModel::none && layout.side(sides[0]).facet == from.facet ? 0 : 1;
        const Point2 d = layout.side(sides[near]).at(t.at) - p;
        if (dot(d, d) >= least) continue;
        least = dot(d, d);
        at = t;
        k = 1 - near;
    }
    return least < infinity;
}

/// A chain of points, each the nearest to the one before across a facet: in strips points vanish only all together.
void SplitSearch::take_thread(Target seed, std::size_t size) {
    taken_.assign(1, seed);
    for (const int direction : {0, 1}) {
        Target at = seed;
        int k = direction;
        while (taken_.size() < size && move_across(k, at)) taken_.push_back(at);
    }
}

void SplitSearch::remove_taken() {
    for (const Target& t : taken_) {
        if (!model_.is_movable(t.edge)) continue;
        model_.prepare(t.edge);
        const std::size_t i = model_.part_at(t.edge, t.at);
        if (i < model_.point_count(t.edge) && model_.parts(t.edge)[i].end == t.at) model_.cut(t.edge, i, i + 1, {});
    }
}

}  // namespace delmesh
