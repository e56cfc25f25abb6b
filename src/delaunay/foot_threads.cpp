#include "delaunay/foot_threads.hpp"

#include "delaunay/split_at_seen.hpp"

namespace delmesh {
namespace {

/// Negative if there is none.
double foot(const SplitModel& model, std::uint32_t e, std::size_t part) {
    return split_at_what_is_seen(model, e, part, [](std::uint32_t, const Contact& seen) { return seen.at.x; });
}

}  // namespace

bool lay_foot_threads(SplitModel& model, const SplitRepair& limits, std::size_t max_points, std::size_t steps) {
    for (std::size_t step = 0; model.suspect_count() > 0;) {
        const std::uint32_t e = model.suspect(model.suspect_count() - 1);
        const int bad = model.first_bad(e);
        model.drop_suspect(model.suspect_count() - 1);
        if (bad < 0) continue;
        if (++step > steps || limits.is_exhausted() || model.point_count() >= max_points || !model.is_movable(e))
            return false;
        model.prepare(e);
        const auto part = static_cast<std::size_t>(bad);
        const double at = foot(model, e, part);
        if (at < 0) return false;
        model.cut(e, part, part, {&at, 1});
        if (model.first_bad(e) >= 0) model.add_suspect(e);
    }
    return true;
}

}  // namespace delmesh
