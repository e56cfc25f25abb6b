#include "delaunay/split_planner.hpp"

#include "base/let_go.hpp"

#include <utility>

namespace delmesh {

SplitChooser& SplitPlanner::chooser() {
    if (chooser_) return *chooser_;
    chooser_.emplace(marked_, bad_, options_);
    if (!baseline_.empty()) chooser_->set_baseline(baseline_);
    if (is_large_) let_go(baseline_);
    chooser_->resume(plan_);
    plan_ = {};
    return *chooser_;
}

std::vector<SplitPoint> SplitPlanner::hand_over() {
    if (!is_large_) return chooser_->splits();
    rest();
    return plan_.splits;
}

void SplitPlanner::rest() {
    if (!is_large_) return;
    plan_ = chooser_->plan();
    const std::vector<PlacedPoint> points = chooser_->take_baseline();
    chooser_.reset();
    baseline_.reserve(points.size());
    for (const PlacedPoint& point : points)
        baseline_.push_back(split_at(marked_.mesh(), HalfedgeId(point.edge), point.at));
}

std::vector<SplitPoint> SplitPlanner::search(const Context* context) {
    chooser().search(context);
    proved_bound_ = chooser_->proved_bound();
    return hand_over();
}

std::vector<SplitPoint> SplitPlanner::close_by_baseline() {
    chooser().close_by_baseline();
    return hand_over();
}

std::optional<std::vector<SplitPoint>> SplitPlanner::lay_slices(const SliceOptions& options,
                                                                std::span<const std::array<VertexId, 2>> distrusted,
                                                                const Context* context) {
    if (chooser().lay_slices(options, distrusted, context)) return hand_over();
    rest();
    return std::nullopt;
}

std::optional<std::vector<SplitPoint>> SplitPlanner::mend(std::span<const std::array<VertexId, 2>> edges) {
    if (chooser().mend(edges)) return hand_over();
    rest();
    return std::nullopt;
}

std::optional<std::vector<SplitPoint>> SplitPlanner::take_better_regions(std::span<const SplitPoint> truth) {
    if (baseline_.empty() || (!chooser_ && plan_.is_compared && truth.size() == plan_.splits.size()))
        return std::nullopt;
    if (chooser().take_better_regions(truth)) return hand_over();
    rest();
    return std::nullopt;
}

}  // namespace delmesh
