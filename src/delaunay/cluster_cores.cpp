#include "delaunay/cluster_cores.hpp"

#include "base/sort_unique.hpp"

#include <algorithm>

namespace delmesh {
namespace {

constexpr std::size_t largest_cluster = 4;
constexpr std::size_t most_gain = 4;
constexpr std::size_t largest_core = 4;
constexpr std::size_t most_boxes = 1000;
/// In corners and lines that are looked at, for each edge or core that something is tried for.
constexpr std::size_t most_work = 100'000;
constexpr std::size_t most_scenes = 20000;
constexpr double least_width = 1e-7;
/// The same, where there is a gap.
constexpr std::size_t most_gap_boxes = 100'000;
constexpr std::size_t most_gap_work = 4'000'000;

[[nodiscard]] bool contains(const std::vector<std::uint32_t>& ids, std::uint32_t id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

ClusterCores::ClusterCores(BoundView& view, const CorePacking& packing, const std::vector<bool>& is_open)
    : view_(view),
      needs_(packing.needs()),
      is_open_(is_open) {
    for (std::uint32_t i = 0; i < needs_.size(); ++i) need_of_.insert(needs_[i].edge, i);
    packing.for_each_core([&](std::uint32_t split, const std::vector<std::uint32_t>& blockers) {
        const auto id = static_cast<std::uint32_t>(cores_.size());
        cores_.emplace_back().split = {split};
        join(split, id);
        for (const std::uint32_t e : blockers) join(e, id);
    });
}

void ClusterCores::join(std::uint32_t edge, std::uint32_t core) {
    core_of_.insert(edge, core);
    cores_[core].edges.push_back(edge);
}

std::uint32_t ClusterCores::owner(std::uint32_t edge) const {
    std::uint32_t core = core_of_.find(edge);
    while (core != none && cores_[core].into != none) core = cores_[core].into;
    return core;
}

const EdgeScene& ClusterCores::scene(std::uint32_t edge) {
    const std::uint32_t known = scene_of_.find(edge);
    if (known != none) return *scenes_[known];
    scene_of_.insert(edge, static_cast<std::uint32_t>(scenes_.size()));
    scenes_.push_back(std::make_unique<EdgeScene>(view_, EdgeId(edge)));
    return *scenes_.back();
}

void ClusterCores::start_trying() {
    work_ = 0;
    if (scenes_.size() < most_scenes) return;
    scenes_.clear();
    scene_of_ = IdMap();
}

bool ClusterCores::is_candidate(std::uint32_t edge) const {
    return is_open_[edge] && core_of_.find(edge) == none && needs_[need_of_.find(edge)].points == 1;
}

std::size_t ClusterCores::run(const Context* context) {
    std::size_t gain = 0;
    for (std::size_t size = 2; size <= largest_cluster; ++size) {
        for (const EdgeNeed& need : needs_) {
            if (is_cancelled(context)) return gain;
            if (!is_candidate(need.edge)) continue;
            start_trying();
            cluster_.assign(1, need.edge);
            if (grow_cluster(size)) ++gain;
        }
    }
    for (std::size_t level = 1; level < most_gain; ++level)
        gain += improve(
            context, [&](const Core& core) { return core.gain == level; }, &ClusterCores::raise);
    return gain + improve(
                      context, [](const Core& core) { return core.gain < most_gain; }, &ClusterCores::join_edge);
}

/// Tries to make more of all cores that may be tried; returns how much more.
template <class May>
std::size_t ClusterCores::improve(const Context* context, May&& may, bool (ClusterCores::*step)(std::uint32_t)) {
    std::size_t gain = 0;
    for (std::uint32_t core = 0; core < cores_.size() && !is_cancelled(context); ++core) {
        if (!may(cores_[core]) || cores_[core].split.size() > largest_core || has_several_points(cores_[core]))
            continue;
        start_trying();
        if ((this->*step)(core)) ++gain;
    }
    return gain;
}

bool ClusterCores::raise(std::uint32_t core) {
    return prove(std::vector<std::uint32_t>(cores_[core].split), core, cores_[core].gain);
}

bool ClusterCores::has_several_points(const Core& core) const {
    return needs_[need_of_.find(core.split.front())].points > 1;
}

/// The edges near those of `cluster_` that must be split and belong to no core, sorted.
std::vector<std::uint32_t> ClusterCores::candidates_around(std::uint32_t core) {
    std::vector<std::uint32_t> around;
    const auto consider = [&](std::uint32_t other) {
        if (is_candidate(other) && !contains(cluster_, other)) around.push_back(other);
    };
    for (const std::uint32_t e : cluster_) {
        work_ += scene(e).size();
        for (const std::uint32_t other : scene(e).neighbours()) {
            consider(other);
            const std::uint32_t of = core_of_.find(other);
            if (is_open_[other] || (of != none && of != core)) continue;
            work_ += scene(other).size();
            for (const std::uint32_t beyond : scene(other).neighbours()) consider(beyond);
        }
    }
    sort_unique(around);
    return around;
}

/// Takes one more edge that must be split into a core, where both together need a point more than each for itself.
bool ClusterCores::join_edge(std::uint32_t core) {
    cluster_ = cores_[core].split;
    for (const std::uint32_t other : candidates_around(core)) {
        cluster_.push_back(other);
        if (prove(cluster_, core, cores_[core].gain)) return true;
        cluster_.pop_back();
    }
    return false;
}

/// Adds edges nearby until the cluster has its size, and tries to prove it.
bool ClusterCores::grow_cluster(std::size_t size) {
    if (work_ > most_work) return false;
    if (cluster_.size() == size) return prove(cluster_, none, 0);
    for (const std::uint32_t other : candidates_around(none)) {
        if (other < cluster_.front()) continue;
        cluster_.push_back(other);
        if (grow_cluster(size)) return true;
        cluster_.pop_back();
    }
    return false;
}

/// Tries to show that one point on each edge of `split`, and `more` points wherever they are, do not do; makes a core
/// of that.
bool ClusterCores::prove(const std::vector<std::uint32_t>& split, std::uint32_t core, std::size_t more) {
    own_.clear();
    if (core != none) own_.push_back(core);
    points_ = split;
    in_proof_ = split;
    if (!refute_all(more)) return false;
    if (core == none) {
        core = static_cast<std::uint32_t>(cores_.size());
        cores_.emplace_back();
    }
    cores_[core].split = split;
    cores_[core].gain = more + 1;
    for (const std::uint32_t e : in_proof_)
        if (core_of_.find(e) == none) join(e, core);
    return true;
}

/// A refutation of what there is stays one wherever more points are, but for points on the edges that it uses. So these
/// are all that have to be tried.
bool ClusterCores::refute_all(std::size_t more) {
    if (!refute()) return false;
    std::vector<std::uint32_t> used;
    for (std::size_t i = 0; i < watchers_.size(); ++i)
        if (is_used_[i]) used.push_back(watchers_[i]);
    for (const std::uint32_t e : used)
        if (!contains(in_proof_, e)) in_proof_.push_back(e);
    if (more == 0) return true;
    for (const std::uint32_t e : used) {
        points_.push_back(e);
        const bool refuted = points_.size() <= most_vague_points && refute_all(more - 1);
        points_.pop_back();
        if (!refuted) return false;
    }
    return true;
}

ClusterCores::Box ClusterCores::all_places() const {
    Box box;
    std::vector<std::uint32_t> edges = points_;
    sort_unique(edges);
    for (const std::uint32_t e : edges) {
        const auto count = static_cast<std::size_t>(std::count(points_.begin(), points_.end(), e));
        const std::size_t first = box.size();
        box.resize(first + count, {e, {0, 1}});
        if (!is_open_[e]) continue;
        const std::vector<Stretch>& alone = needs_[need_of_.find(e)].stretches;
        for (std::size_t i = 0; i < std::min(alone.size(), count); ++i) {
            Stretch& from_start = box[first + i].at;
            from_start.to = std::min(from_start.to, alone[i].to);
            Stretch& from_end = box[box.size() - 1 - i].at;
            from_end.from = std::max(from_end.from, alone[alone.size() - 1 - i].from);
        }
    }
    return box;
}

bool ClusterCores::is_in_proof(std::uint32_t edge) const {
    return contains(in_proof_, edge) || contains(own_, owner(edge));
}

/// Edges with points, and others nearby that may be spoilt by them.
void ClusterCores::gather_watchers() {
    watchers_ = points_;
    sort_unique(watchers_);
    const std::vector<std::uint32_t> split = watchers_;
    std::vector<std::uint32_t> others;
    for (const std::uint32_t e : split) {
        work_ += scene(e).size();
        for (const std::uint32_t other : scene(e).neighbours()) {
            if (is_open_[other] || contains(split, other)) continue;
            if (core_of_.find(other) == none || is_in_proof(other)) others.push_back(other);
        }
    }
    sort_unique(others);
    watchers_.insert(watchers_.end(), others.begin(), others.end());
    is_used_.assign(watchers_.size(), false);
    // Where their points can be holds only for as many as there are.
    for (std::size_t i = 0; i < split.size(); ++i) is_used_[i] = is_open_[split[i]];
}

/// Tries to show that the points can not be on their edges and nowhere else: cuts the box of all places into smaller
/// ones until in each of them an edge is bad for certain.
bool ClusterCores::refute() {
    gather_watchers();
    std::vector<Box> boxes{all_places()};
    const std::size_t most = gap_ == nullptr ? most_boxes : most_gap_boxes;
    for (std::size_t count = 0; !boxes.empty(); ++count) {
        if (count == most || work_ > (gap_ == nullptr ? most_work : most_gap_work)) return false;
        Box box = std::move(boxes.back());
        boxes.pop_back();
        if (is_refuted(box)) continue;
        if (gap_ != nullptr && halve(box)) {
            boxes.push_back(std::move(box));
            continue;
        }
        const auto widest = std::max_element(box.begin(), box.end(), [](const VaguePoint& a, const VaguePoint& b) {
            return a.at.to - a.at.from < b.at.to - b.at.from;
        });
        if (widest->at.to - widest->at.from < least_width ||
            std::all_of(watchers_.begin(), watchers_.end(),
                        [&](std::uint32_t e) { return scene(e).looks_good(box); })) {
            if (gap_ != nullptr) try_places(box);
            return false;
        }
        const double middle = 0.5 * (widest->at.from + widest->at.to);
        boxes.push_back(box);
        boxes.back()[static_cast<std::size_t>(widest - box.begin())].at.to = middle;
        widest->at.from = middle;
        boxes.push_back(std::move(box));
    }
    return true;
}

/// Where one half of the box is refuted at once, leaves the other one.
bool ClusterCores::halve(Box& box) {
    for (VaguePoint& point : box) {
        const Stretch whole = point.at;
        if (whole.to - whole.from < least_width) continue;
        const double middle = 0.5 * (whole.from + whole.to);
        point.at.to = middle;
        const bool low = is_refuted(box);
        point.at = {middle, whole.to};
        if (low) return true;
        if (is_refuted(box)) {
            point.at = {whole.from, middle};
            return true;
        }
        point.at = whole;
    }
    return false;
}

/// Edges that the proof is about anyway are tried first.
bool ClusterCores::is_refuted(const Box& box) {
    for (std::size_t i = 0; i + 1 < box.size(); ++i)
        if (box[i].edge == box[i + 1].edge && box[i].at.from > box[i + 1].at.to) return true;
    for (const int round : {0, 1, 2}) {
        for (std::size_t i = 0; i < watchers_.size(); ++i) {
            const int turn = is_used_[i] ? 0 : is_in_proof(watchers_[i]) ? 1 : 2;
            if (turn != round) continue;
            work_ += scene(watchers_[i]).size();
            if (!scene(watchers_[i]).is_bad(box)) continue;
            is_used_[i] = true;
            return true;
        }
    }
    return false;
}

}  // namespace delmesh
