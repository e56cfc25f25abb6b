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
    is_quick_ ? add_quick_candidates() : add_candidates();
    sort_candidates();
    if (cheapest_chain()) return;
    if (!is_quick_) {
        add_farthest_candidates();
        sort_candidates();
        if (cheapest_chain()) return;
    }
    plain_chain();
}

void BestResponse::add_candidates() {
    const auto add = [&](double t, int weight = -1) { candidates_.push_back({t, -1, weight}); };
    const int extra = cells_.size() < 12 ? 2 : cells_.size() < 40 ? 1 : 0;
    for (const Cell& cell : cells_) {
        const int weight = cell.weight == 0 ? 0 : -1;
        add(pick(cell.begin, cell.end), weight);
        if (cell.weight > 0)
            for (const double t : near_ends(cell.begin, cell.end)) add(t);
        for (int i = 0; i < extra; ++i) add(cell.begin + (cell.end - cell.begin) * random_.uniform(), weight);
    }
    for (const double t : aligned_) add(t);
    if (first_reach_ < high_) add(first_reach_);
    if (last_reach_ > low_) add(last_reach_);
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
    const auto out = [&](const Candidate& c) { return c.at < low_ + room_ || c.at > high_ - room_; };
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), out), candidates_.end());
    const auto same = [](const Candidate& a, const Candidate& b) { return a.at == b.at; };
    candidates_.erase(std::unique(candidates_.begin(), candidates_.end(), same), candidates_.end());
    model_.count_work(candidates_.size() * (4 + blocked_.size() + candidates_.size() / 4) / 4);
    for (Candidate& candidate : candidates_) {
        candidate.cost = never;
        candidate.done = 0;
    }
    ahead_.assign(candidates_.size(), never);
}

/// The cheapest way from low to high in Delaunay steps, by Dijkstra's algorithm; fills `chosen_`. How far a step
/// reaches is only asked where that may be part of the answer.
bool BestResponse::cheapest_chain() {
    int least = never;
    int last = -1;
    const auto reach = [&](std::size_t i, int before_it, int before) {
        Candidate& here = candidates_[i];
        const bool is_last = here.at >= last_reach_;
        // Its weight is only asked for where that may matter.
        if (here.done != 0 || before_it >= here.cost || before_it > (is_last ? least : least - point_cost)) return;
        if (here.weight < 0) here.weight = soft_weight(here.at);
        const int cost = before_it + here.weight;
        if (cost >= here.cost) return;
        here.cost = cost;
        here.before = before;
        ahead_[i] = is_last ? never : cost;
        if (!is_last || cost > least) return;
        if (cost == least && (is_quick_ || random_.chance(0.5))) return;
        least = cost;
        last = static_cast<int>(i);
    };
    for (std::size_t i = 0; i < candidates_.size() && candidates_[i].at <= first_reach_; ++i) reach(i, point_cost, -1);
    for (int i = cheapest_candidate(least); i >= 0; i = cheapest_candidate(least)) {
        Candidate& from = candidates_[i];
        from.done = 1;
        ahead_[i] = never;
        if (from.reach < 0) from.reach = reach_up(from.at);
        for (std::size_t j = i + 1; j < candidates_.size() && candidates_[j].at <= from.reach; ++j)
            if (candidates_[j].at >= from.at + room_) reach(j, from.cost + point_cost, i);
    }
    if (last < 0) return false;
    for (int i = last; i >= 0; i = candidates_[i].before) chosen_.push_back(candidates_[i].at);
    std::reverse(chosen_.begin(), chosen_.end());
    return true;
}

/// To go on from, if that may lead to a way that costs less than `least`; or -1.
int BestResponse::cheapest_candidate(int least) {
    int best = -1;
    int cost = least - point_cost - 1;
    std::size_t count = 0;
    for (std::size_t i = 0; i < ahead_.size(); ++i) {
        if (ahead_[i] > cost) continue;
        if (ahead_[i] < cost) count = 0;
        cost = ahead_[i];
        if (is_quick_ ? count++ == 0 : random_.below(++count) == 0) best = static_cast<int>(i);
    }
    return best;
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
