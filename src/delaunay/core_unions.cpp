// Where a solution has more points than the bound: several cores together.

#include "base/random.hpp"
#include "base/sort_unique.hpp"
#include "delaunay/cluster_cores.hpp"

#include <algorithm>

namespace delmesh {
namespace {

constexpr std::size_t largest_union = 5;
constexpr int climb_tries = 40;
constexpr double climb_start = 0.1;
constexpr double climb_end = 1e-7;

[[nodiscard]] bool contains(const std::vector<std::uint32_t>& ids, std::uint32_t id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

std::size_t ClusterCores::close_gaps(GapTask& task, const Context* context) {
    gap_ = &task;
    std::size_t more = 0;
    const auto try_size = [&](std::size_t size) {
        for (const Union& gap : find_gaps()) {
            if (is_cancelled(context) || gap_work_ > task.work) return false;
            const Outcome outcome = try_unions(gap, size);
            if (outcome == Outcome::more_needed) ++more;
            if (outcome != Outcome::nothing) return true;
        }
        return false;
    };
    // Small ones first, again after each success.
    for (std::size_t size = 1; size <= largest_union;) size = try_size(size) ? 1 : size + 1;
    gap_ = nullptr;
    return more;
}

/// Cores and edges of none that have points too many; and those around points that belong to none.
std::vector<ClusterCores::Union> ClusterCores::find_gaps() {
    std::vector<Union> gaps;
    for (std::uint32_t core = 0; core < cores_.size(); ++core) {
        if (cores_[core].into != none) continue;
        std::size_t points = 0;
        std::size_t needed = cores_[core].gain;
        for (const std::uint32_t e : cores_[core].edges) points += gap_->count[e];
        for (const std::uint32_t e : cores_[core].split) needed += need(e);
        if (points > needed) gaps.push_back({{core}, {}});
    }
    for (std::uint32_t e = 0; e < gap_->count.size(); ++e) {
        if (gap_->count[e] == 0 || owner(e) != none) continue;
        if (!is_open_[e])
            for (const Union& near : find_around({}, {e})) gaps.push_back(near);
        else if (gap_->count[e] > need(e))
            gaps.push_back({{}, {e}});
    }
    return gaps;
}

std::vector<std::uint32_t> ClusterCores::edges_of(const Union& cores) const {
    std::vector<std::uint32_t> edges = cores.edges;
    for (const std::uint32_t core : cores.cores)
        edges.insert(edges.end(), cores_[core].edges.begin(), cores_[core].edges.end());
    sort_unique(edges);
    return edges;
}

void ClusterCores::Union::add(const Union& other) {
    cores.insert(cores.end(), other.cores.begin(), other.cores.end());
    edges.insert(edges.end(), other.edges.begin(), other.edges.end());
}

/// What these edges belong to, or what shares facets with them.
std::vector<ClusterCores::Union> ClusterCores::find_around(const Union& cores,
                                                           const std::vector<std::uint32_t>& edges) {
    std::vector<std::uint32_t> found_cores;
    std::vector<std::uint32_t> found_edges;
    const auto consider = [&](std::uint32_t e) {
        const std::uint32_t of = owner(e);
        if (of != none && !contains(cores.cores, of)) found_cores.push_back(of);
        if (of == none && is_open_[e] && !contains(cores.edges, e)) found_edges.push_back(e);
    };
    for (const std::uint32_t e : edges) {
        consider(e);
        for (const std::uint32_t other : scene(e).neighbours()) consider(other);
    }
    sort_unique(found_cores);
    sort_unique(found_edges);
    std::vector<Union> found;
    found.reserve(found_cores.size() + found_edges.size());
    for (const std::uint32_t core : found_cores) found.push_back({{core}, {}});
    for (const std::uint32_t e : found_edges) found.push_back({{}, {e}});
    return found;
}

/// Tries unions of so many cores and edges that begin with these: with what their places would break.
ClusterCores::Outcome ClusterCores::try_unions(const Union& from, std::size_t size) {
    if (from.size() == size) return try_union(from);
    const auto known = tried_.find(edges_of(from));
    if (known == tried_.end()) return Outcome::nothing;
    const std::vector<Union> next = known->second;
    for (const Union& one : next) {
        Union larger = from;
        larger.add(one);
        const Outcome outcome = try_unions(larger, size);
        if (outcome != Outcome::nothing) return outcome;
    }
    return Outcome::nothing;
}

/// Tries to show that they need one point more together.
ClusterCores::Outcome ClusterCores::try_union(const Union& cores) {
    const auto [place, is_new] = tried_.try_emplace(edges_of(cores));
    if (gap_work_ > gap_->work || !is_new) return Outcome::nothing;
    start_trying();
    std::vector<std::uint32_t> split = cores.edges;
    std::size_t gain = 0;
    for (const std::uint32_t core : cores.cores) {
        split.insert(split.end(), cores_[core].split.begin(), cores_[core].split.end());
        gain += cores_[core].gain;
    }
    own_ = cores.cores;
    in_proof_ = split;
    points_.clear();
    for (const std::uint32_t e : split) points_.insert(points_.end(), need(e), e);
    if (points_.size() + gain > most_vague_points) return Outcome::nothing;
    is_fewer_ = false;
    broken_.clear();
    const bool refuted = refute_all(gain);
    gap_work_ += work_;
    place->second = find_around(cores, broken_);
    if (refuted) merge(cores, split, gain + 1);
    return refuted ? Outcome::more_needed : is_fewer_ ? Outcome::fewer_found : Outcome::nothing;
}

void ClusterCores::merge(const Union& cores, const std::vector<std::uint32_t>& split, std::size_t gain) {
    const auto id = static_cast<std::uint32_t>(cores_.size());
    Core core;
    core.split = split;
    core.gain = gain;
    for (const std::uint32_t part : cores.cores)
        core.edges.insert(core.edges.end(), cores_[part].edges.begin(), cores_[part].edges.end());
    cores_.push_back(std::move(core));
    for (const std::uint32_t part : cores.cores) cores_[part].into = id;
    for (const std::uint32_t e : in_proof_)
        if (core_of_.find(e) == none) join(e, id);
}

// --- places for fewer points ---

double ClusterCores::margin(const Box& box) {
    double least = 1;
    for (const std::uint32_t e : watchers_) {
        work_ += scene(e).size();
        least = std::min(least, scene(e).margin(box));
    }
    return least;
}

/// To where nothing is bad by a hair: what lies beyond the watchers needs some room.
ClusterCores::Box ClusterCores::climb(const Box& box) {
    Box best = box;
    for (VaguePoint& point : best) point.at.from = point.at.to = 0.5 * (point.at.from + point.at.to);
    double highest = margin(best);
    Random random(1);
    for (double step = climb_start; step > climb_end; step *= 0.5) {
        for (int i = 0; i < climb_tries; ++i) {
            Box next = best;
            for (VaguePoint& point : next) {
                point.at.from = std::clamp(point.at.from + step * (2 * random.uniform() - 1), 0.0, 1.0);
                point.at.to = point.at.from;
            }
            const double high = margin(next);
            if (high <= highest) continue;
            highest = high;
            best = std::move(next);
        }
    }
    return best;
}

/// These points seem to do, as far as the watchers are concerned. Points nearby that nobody is known to need go as
/// well.
void ClusterCores::try_places(const Box& box) {
    std::vector<std::uint32_t> edges = in_proof_;
    for (const std::uint32_t core : own_)
        edges.insert(edges.end(), cores_[core].edges.begin(), cores_[core].edges.end());
    edges.insert(edges.end(), points_.begin(), points_.end());
    sort_unique(edges);
    const std::vector<std::uint32_t> inner = edges;
    for (const std::uint32_t e : inner)
        for (const std::uint32_t other : scene(e).neighbours())
            if (!is_open_[other] && owner(other) == none && gap_->count[other] > 0) edges.push_back(other);
    sort_unique(edges);
    const Box places = climb(box);
    is_fewer_ = gap_->replace(edges, places);
    if (!is_fewer_) broken_ = gap_->broken;
}

}  // namespace delmesh
