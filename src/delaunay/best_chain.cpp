// Several new points for a stretch of an edge.

#include "delaunay/best_response.hpp"

#include <algorithm>
#include <limits>

namespace delmesh {
namespace {

constexpr std::size_t max_chain = 64;
constexpr int never = std::numeric_limits<int>::max() / 2;

}  // namespace

/// Several points: the cheapest chain over some places in each cell.
void BestResponse::place_many() {
    candidates_.clear();
    if (is_quick_) {
        add_quick_candidates();
        sort_candidates();
    } else {
        add_candidates();
    }
    finish_candidates();
    if (cheapest_chain()) return;
    if (!is_quick_) {
        add_farthest_candidates();
        sort_candidates();
        finish_candidates();
        if (cheapest_chain()) return;
    }
    plain_chain();
}

/// Into its place among those before it: they come nearly in order.
void BestResponse::insert_candidate(double at) {
    candidates_.push_back({at});
    std::size_t i = candidates_.size() - 1;
    for (; i > 0 && candidates_[i - 1].at > at; --i) candidates_[i].at = candidates_[i - 1].at;
    candidates_[i].at = at;
}

void BestResponse::add_candidates() {
    const int extra = cells_.size() < 12 ? 2 : cells_.size() < 40 ? 1 : 0;
    std::size_t aligned = 0;
    for (const Cell& cell : cells_) {
        insert_candidate(pick(cell.begin, cell.end));
        if (cell.weight > 0)
            for (const double t : near_ends(cell.begin, cell.end)) insert_candidate(t);
        for (int i = 0; i < extra; ++i) insert_candidate(cell.begin + (cell.end - cell.begin) * random_.uniform());
        for (; aligned < aligned_.size() && aligned_[aligned] <= cell.end; ++aligned)
            insert_candidate(aligned_[aligned]);
    }
    if (first_reach_ < high_) insert_candidate(first_reach_);
    if (last_reach_ > low_) insert_candidate(last_reach_);
}

/// As far as one gets from each end, again and again.
void BestResponse::add_farthest_candidates() {
    const auto add = [&](double t) { candidates_.push_back({t}); };
    const double least_step = 1e-12 * (high_ - low_);
    double at = low_;
    for (std::size_t i = 0; i < max_chain; ++i) {
        const double next = reach_up(at);
        if (!(next > at + least_step) || next >= high_) break;
        add(at = next);
    }
    at = high_;
    for (std::size_t i = 0; i < max_chain; ++i) {
        const double next = reach_down(at);
        if (!(next < at - least_step) || next <= low_) break;
        add(at = next);
    }
}

/// One for each cell, and as far as one gets from `low_` on.
void BestResponse::add_quick_candidates() {
    for (const Cell& cell : cells_) candidates_.push_back({pick(cell.begin, cell.end)});
    const double least_step = 1e-12 * (high_ - low_);
    double at = first_reach_;
    for (std::size_t i = 0; i < max_chain && at < high_; ++i) {
        Candidate& here = candidates_.emplace_back();
        here.at = at;
        here.reach = reach_up(at);
        if (!(here.reach > at + least_step)) break;
        at = here.reach;
    }
}

void BestResponse::sort_candidates() {
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return a.at < b.at; });
}

/// Takes out what lies too near to the ends or twice at the same place, and weighs the rest.
void BestResponse::finish_candidates() {
    std::size_t kept = 0;
    for (const Candidate& c : candidates_) {
        if (c.at < low_ + room_ || c.at > high_ - room_) continue;
        if (kept == 0 || candidates_[kept - 1].at < c.at) candidates_[kept++] = c;
    }
    candidates_.resize(kept);
    model_.count_work(kept * (4 + blocked_.size() + kept / 4) / 4);
    weigh_candidates();
    cost_.resize(kept);
    before_.resize(kept);
}

/// As `soft_weight`, for all at once: that takes a fraction of the time.
void BestResponse::weigh_candidates() {
    load_.assign(candidates_.size(), 0);
    const auto before = [](const Candidate& c, double at) { return c.at < at; };
    for (const Cell& b : blocked_) {
        const auto first = std::lower_bound(candidates_.begin(), candidates_.end(), b.begin, before);
        const double inverse = 1 / (b.end - b.begin);
        for (auto i = static_cast<std::size_t>(first - candidates_.begin()); i < candidates_.size(); ++i) {
            const double t = candidates_[i].at;
            if (t >= b.end) break;
            load_[i] += b.weight * std::min(1.0, 0.5 + 2 * inverse * std::min(t - b.begin, b.end - t));
        }
    }
}

/// The cheapest way from low to high in Delaunay steps, by Dijkstra's algorithm; fills `chosen_`. A step reaches the
/// farther the farther it begins, and what a point costs does not depend on the way to it. So the first way to a point
/// is the cheapest, and ways to points before one that has been gone on from lead to nothing new.
bool BestResponse::cheapest_chain() {
    int least = never;
    int last = -1;
    std::size_t reached = 0;
    const auto reach = [&](double limit, double from, int before_it, int before) {
        for (; reached < candidates_.size() && candidates_[reached].at <= limit; ++reached) {
            const double at = candidates_[reached].at;
            const bool is_last = at >= last_reach_;
            cost_[reached] = never;
            if (at < from || before_it > (is_last ? least : least - point_cost)) continue;
            const int cost = before_it + static_cast<int>(load_[reached]);
            before_[reached] = before;
            if (!is_last) cost_[reached] = cost;
            if (!is_last || cost > least) continue;
            if (cost == least && (is_quick_ || random_.chance(0.5))) continue;
            least = cost;
            last = static_cast<int>(reached);
        }
    };
    reach(first_reach_, low_, point_cost, -1);
    for (int i = cheapest_candidate(0, reached, least); i >= 0;) {
        Candidate& from = candidates_[i];
        if (from.reach < 0) from.reach = reach_up(from.at);
        reach(from.reach, from.at + room_, cost_[i] + point_cost, i);
        i = cheapest_candidate(static_cast<std::size_t>(i) + 1, reached, least);
    }
    if (last < 0) return false;
    for (int i = last; i >= 0; i = before_[i]) chosen_.push_back(candidates_[i].at);
    std::reverse(chosen_.begin(), chosen_.end());
    return true;
}

/// Of some, to go on from, if that may lead to a way that costs less than `least`; or -1.
int BestResponse::cheapest_candidate(std::size_t first, std::size_t last, int least) {
    int cost = least - point_cost;
    std::uint32_t count = 0;
    for (std::size_t i = first; i < last; ++i) {
        count = (cost_[i] < cost ? 0u : count) + (cost_[i] <= cost ? 1u : 0u);
        cost = std::min(cost, cost_[i]);
    }
    if (cost >= least - point_cost) return -1;
    std::uint32_t skipped = is_quick_ ? 0 : random_.below(count);
    for (std::size_t i = first;; ++i)
        if (cost_[i] == cost && skipped-- == 0) return static_cast<int>(i);
}

/// As few points as the edge itself needs, whatever they block.
void BestResponse::plain_chain() {
    double at = low_;
    for (std::size_t i = 0; i < max_chain; ++i) {
        const double reach = reach_up(at);
        if (reach >= high_) return;
        const double next = at + (reach - at) * 0.999;
        if (!(next > at)) return;
        chosen_.push_back(at = next);
    }
}

}  // namespace delmesh
