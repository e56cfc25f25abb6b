#include "delaunay/split_repair.hpp"

#include <algorithm>
#include <limits>

namespace delmesh {
namespace {

constexpr int weight_step = 7;
/// From this weight on, an edge may also get a point more instead of new points.
constexpr int heavy = SplitModel::base_weight + 20;
/// In tenths of a point.
constexpr std::size_t suspect_price = 4;
constexpr std::size_t few_points = 3;
constexpr std::size_t many_points = 16;
constexpr double whole_share = 0.7;

}  // namespace

void SplitRepair::replace(std::uint32_t e, std::size_t first, std::size_t last) {
    model_.cut(e, first, last, response_.solve(e, first, last));
}

bool SplitRepair::takes_whole_edge(std::size_t points) {
    return points <= few_points || (points <= many_points && random_.chance(whole_share));
}

void SplitRepair::resolve(std::uint32_t e, std::size_t part) {
    model_.prepare(e);
    const std::size_t n = model_.point_count(e);
    if (model_.weight(e) > heavy && random_.chance(0.5)) {
        const double at = response_.halve(e, part);
        model_.cut(e, part, part, {&at, 1});
    } else if (takes_whole_edge(n)) {
        replace(e, 0, n);
    } else {
        replace(e, part == 0 ? 0 : part - 1, std::min(part + 1, n));
    }
    if (model_.first_bad(e) >= 0) model_.add_suspect(e);
}

/// The point of the culprit that the part sees from its side k.
std::size_t SplitRepair::point_seen(std::uint32_t e, std::size_t part, int k) const {
    const FacetLayout& layout = model_.layout();
    const Part bad = model_.parts(e)[part];
    const double start = model_.part_start(e, part);
    const std::uint32_t culprit = bad.culprit[k];
    const Side side = layout.side(layout.edge(e).side[k]);
    const Side other = layout.side(layout.edge(culprit).side[layout.side_within(culprit, side.facet)]);
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    const auto parts = model_.parts(culprit);
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
        const Point2 q = side.to_frame(other.at(parts[i].end));
        if (!(q.y > 0)) continue;
        const double cot = cot_of(start, bad.end, q);
        if (cot >= least) continue;
        least = cot;
        best = i;
    }
    return best;
}

/// Moves the point that a bad part sees instead of the part's own ends.
bool SplitRepair::resolve_culprit(std::uint32_t e, std::size_t part) {
    const Part bad = model_.parts(e)[part];
    std::array<int, 2> sides{};
    std::size_t count = 0;
    for (int k = 0; k < 2; ++k)
        if (bad.culprit[k] != SplitModel::none && model_.is_movable(bad.culprit[k])) sides[count++] = k;
    if (count == 0) return false;
    const int k = sides[count == 1 ? 0 : random_.below(2)];
    const std::uint32_t culprit = bad.culprit[k];
    model_.prepare(culprit);
    const std::size_t n = model_.point_count(culprit);
    if (takes_whole_edge(n)) {
        replace(culprit, 0, n);
    } else {
        const std::size_t i = point_seen(e, part, k);
        replace(culprit, i, i + 1);
    }
    return true;
}

void SplitRepair::spread(std::uint32_t e, std::size_t i) {
    model_.prepare(e);
    const double at = response_.spread(e, i);
    if (at == model_.parts(e)[i].end) return;
    model_.begin();
    model_.cut(e, i, i + 1, {&at, 1});
    if (run(model_.point_count(), 0, true)) {
        model_.commit();
    } else {
        model_.rollback();
    }
}

bool SplitRepair::run(std::size_t max_points, std::size_t steps, bool last_first) {
    for (std::size_t step = 0; model_.suspect_count() > 0;) {
        const std::size_t i = last_first ? model_.suspect_count() - 1 : random_.below(model_.suspect_count());
        const std::uint32_t e = model_.suspect(i);
        const int bad = model_.first_bad(e);
        if (bad < 0) {
            model_.drop_suspect(i);
            continue;
        }
        if (++step > steps || is_exhausted()) return false;
        if (10 * model_.point_count() + suspect_price * model_.suspect_count() > 10 * max_points) return false;
        model_.add_weight(e, weight_step);
        const auto part = static_cast<std::size_t>(bad);
        if (self_share_ < 1 && !random_.chance(self_share_) && resolve_culprit(e, part)) continue;
        if (!model_.is_movable(e)) return false;
        model_.drop_suspect(i);
        resolve(e, part);
    }
    return model_.point_count() <= max_points;
}

bool SplitRepair::weave(std::size_t max_points, std::size_t steps) {
    for (std::size_t step = 0; model_.suspect_count() > 0;) {
        const std::size_t i = model_.suspect_count() - 1;
        const std::uint32_t e = model_.suspect(i);
        const int bad = model_.first_bad(e);
        model_.drop_suspect(i);
        if (bad < 0) continue;
        if (++step > steps || is_exhausted() || model_.point_count() >= max_points || !model_.is_movable(e))
            return false;
        model_.prepare(e);
        const double at = response_.weave(e, static_cast<std::size_t>(bad));
        model_.cut(e, static_cast<std::size_t>(bad), static_cast<std::size_t>(bad), {&at, 1});
        if (model_.first_bad(e) >= 0) model_.add_suspect(e);
    }
    return true;
}

}  // namespace delmesh
