#include "delaunay/foot_threads.hpp"

#include <algorithm>
#include <limits>

namespace delmesh {
namespace {

/// Points keep this distance, as a share of their edge: what lies closer together is hard to tell apart.
constexpr double room = 1e-10;

/// Negative if there is none.
double foot(const SplitModel& model, std::uint32_t e, std::size_t part) {
    const double a = model.part_start(e, part);
    const double b = model.parts(e)[part].end;
    double least = std::numeric_limits<double>::infinity();
    double at = -1;
    for (const std::uint32_t s : model.layout().edge(e).side) {
        if (s == SplitModel::none) continue;
        const Contact seen = model.nearest(s, a, b);
        const double x = seen.at.x;
        if (seen.cot >= least || !(x > a + room) || !(x < b - room)) continue;
        least = seen.cot;
        at = x;
    }
    return at;
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
