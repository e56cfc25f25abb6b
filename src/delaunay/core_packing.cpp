#include "delaunay/core_packing.hpp"

#include <algorithm>

namespace delmesh {
namespace {

constexpr std::size_t most_blockers = 12;
constexpr int most_exchanges = 6;
constexpr std::size_t most_work = 4000;

}  // namespace

CorePacking::CorePacking(std::vector<EdgeNeed> needs)
    : needs_(std::move(needs)),
      members_(needs_.size()),
      locked_(needs_.size(), false) {
    IdMap index;
    for (EdgeNeed& need : needs_) {
        for (BlockedStretch& blocker : need.blockers) {
            std::uint32_t i = index.find(blocker.edge);
            if (i == none) {
                i = static_cast<std::uint32_t>(owner_.size());
                index.insert(blocker.edge, i);
                owner_.push_back(none);
                blocking_edges_.push_back(blocker.edge);
            }
            blocker.edge = i;
        }
        std::sort(need.blockers.begin(), need.blockers.end(), [](const BlockedStretch& a, const BlockedStretch& b) {
            return a.from != b.from ? a.from < b.from : a.to > b.to;
        });
    }
}

std::size_t CorePacking::run() {
    for (std::size_t limit = 1; limit <= most_blockers; ++limit)
        for (std::uint32_t core = 0; core < needs_.size(); ++core)
            if (members_[core].empty()) (void)take_free(core, limit);
    for (std::uint32_t core = 0; core < needs_.size(); ++core) {
        if (!members_[core].empty() || needs_[core].blockers.empty()) continue;
        for (int depth = 1; depth <= most_exchanges; ++depth) {
            changes_.clear();
            work_ = 0;
            if (augment(core, depth)) break;
        }
    }
    return static_cast<std::size_t>(
        std::count_if(members_.begin(), members_.end(), [](const auto& members) { return !members.empty(); }));
}

/// Fills `found_` with as few blockers as can cover the stretch; false if they can not, or not by so few.
bool CorePacking::cover(std::uint32_t core, const Stretch& stretch, Blocked blocked, std::size_t limit) {
    const std::vector<BlockedStretch>& blockers = needs_[core].blockers;
    work_ += blockers.size();
    found_.clear();
    double at = stretch.from;
    std::size_t i = 0;
    for (;;) {
        double farthest = at;
        std::uint32_t best = none;
        for (; i < blockers.size() && blockers[i].from <= at; ++i) {
            const std::uint32_t owner = owner_[blockers[i].edge];
            if (owner != none && owner != core && (blocked == Blocked::by_free || locked_[owner])) continue;
            if (blockers[i].to <= farthest && best != none) continue;
            farthest = blockers[i].to;
            best = blockers[i].edge;
        }
        if (best == none || found_.size() == limit) return false;
        found_.push_back(best);
        if (farthest >= stretch.to) return true;
        if (!(farthest > at)) return false;
        at = farthest;
    }
}

bool CorePacking::take_free(std::uint32_t core, std::size_t limit) {
    for (const Stretch& stretch : needs_[core].stretches) {
        if (!cover(core, stretch, Blocked::by_free, limit)) continue;
        assign(core, std::vector<std::uint32_t>(found_));
        return true;
    }
    return false;
}

void CorePacking::assign(std::uint32_t core, const std::vector<std::uint32_t>& edges) {
    for (const std::uint32_t edge : members_[core]) owner_[edge] = none;
    for (const std::uint32_t edge : edges) owner_[edge] = core;
    changes_.push_back({core, std::move(members_[core])});
    members_[core] = edges;
}

void CorePacking::undo(std::size_t changes) {
    for (; changes_.size() > changes; changes_.pop_back()) {
        Change& change = changes_.back();
        for (const std::uint32_t edge : members_[change.core]) owner_[edge] = none;
        members_[change.core] = std::move(change.before);
        for (const std::uint32_t edge : members_[change.core]) owner_[edge] = change.core;
    }
}

/// Finds a place for one core more; others may take other edges for that, but not the locked ones.
bool CorePacking::augment(std::uint32_t core, int depth) {
    if (take_free(core, most_blockers)) return true;
    if (depth == 0 || work_ > most_work) return false;
    locked_[core] = true;
    const bool done = take_from_others(core, depth);
    locked_[core] = false;
    return done;
}

bool CorePacking::take_from_others(std::uint32_t core, int depth) {
    const auto try_it = [&](const std::vector<std::uint32_t>& edges) {
        const std::size_t before = changes_.size();
        std::vector<std::uint32_t> robbed;
        for (const std::uint32_t edge : edges)
            if (owner_[edge] != none && std::find(robbed.begin(), robbed.end(), owner_[edge]) == robbed.end())
                robbed.push_back(owner_[edge]);
        for (const std::uint32_t other : robbed) assign(other, {});
        assign(core, edges);
        for (const std::uint32_t other : robbed) {
            if (augment(other, depth - 1)) continue;
            undo(before);
            return false;
        }
        return true;
    };
    for (const Stretch& stretch : needs_[core].stretches) {
        bool alone = false;
        for (std::size_t i = 0; i < needs_[core].blockers.size(); ++i) {
            const BlockedStretch& blocker = needs_[core].blockers[i];
            if (blocker.from > stretch.from || blocker.to < stretch.to) continue;
            alone = true;
            const std::uint32_t owner = owner_[blocker.edge];
            if ((owner == none || !locked_[owner]) && try_it({blocker.edge})) return true;
        }
        if (!alone && cover(core, stretch, Blocked::by_any, most_blockers) &&
            try_it(std::vector<std::uint32_t>(found_)))
            return true;
    }
    return false;
}

}  // namespace delmesh
