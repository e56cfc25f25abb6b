#include "delaunay/edge_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include "base/sort_unique.hpp"

namespace delmesh {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Parts this short are never called bad.
constexpr double least_length = 1e-12;

struct Place {
    double x = 0;
    double y = 0;
};

[[nodiscard]] Place middle(const FramePoint& p) {
    return {p.x.middle(), p.y.middle()};
}
[[nodiscard]] Place between(const FramePoint& a, const FramePoint& b, double t) {
    const Place p = middle(a);
    const Place q = middle(b);
    return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
}
[[nodiscard]] double cot_at(double from, double to, const Place& p) {
    if (!(p.y > 0)) return infinity;
    return ((from - p.x) * (to - p.x) + p.y * p.y) / (p.y * (to - from));
}

}  // namespace

EdgeScene::EdgeScene(BoundView& view, EdgeId e) : edge_(e.value()) {
    const Mesh& mesh = view.mesh();
    const HalfedgeId h = Mesh::halfedge(e);
    BoundView::Frame frame;
    if (!view.make_frame(mesh.origin(h), mesh.target(h), frame)) return;
    slack_ = frame.slack;
    look(view, frame, h);
    if (!mesh.is_boundary(h)) look(view, frame, mesh.twin(h));
    sort_unique(neighbours_);
}

void EdgeScene::look(BoundView& view, const BoundView::Frame& frame, HalfedgeId h) {
    const Mesh& mesh = view.mesh();
    ConvexView seen;
    view.look(h, seen);
    SideScene& scene = scenes_[sides_++];
    for (const VertexId v : seen.corners) {
        const FramePoint p = view.locate(frame, v);
        if (is_usable(p)) scene.corners.push_back(p);
    }
    for (const HalfedgeId side : seen.sides) {
        const EdgeId other = mesh.edge(side);
        if (other.value() == edge_) continue;
        const HalfedgeId name = Mesh::halfedge(other);
        scene.lines.push_back(
            {other.value(), view.locate(frame, mesh.origin(name)), view.locate(frame, mesh.target(name))});
        neighbours_.push_back(other.value());
    }
    size_ += scene.corners.size() + scene.lines.size();
}

/// Parts between points are the easiest to keep Delaunay where they are shortest, so these are what a proof is about.
template <class Test>
bool EdgeScene::all_parts(std::span<const VaguePoint> points, Test&& test) const {
    double from = 0;
    for (const VaguePoint& point : points) {
        if (point.edge != edge_) continue;
        if (!test(Part{from, point.at.from})) return false;
        from = point.at.to;
    }
    return test(Part{from, 1});
}

/// In doubles. A corner counts as it is; a point at the end of its stretch that sees less, as all between see no less.
EdgeScene::Seen EdgeScene::look_from(const SideScene& side, const Part& part,
                                     std::span<const VaguePoint> points) const {
    Seen best;
    best.cot = infinity;
    for (const FramePoint& corner : side.corners) {
        const double cot = cot_at(part.from, part.to, middle(corner));
        if (!(cot < best.cot)) continue;
        best.cot = cot;
        best.corner = &corner;
    }
    for (const VaguePoint& point : points) {
        for (const Line& line : side.lines) {
            if (line.edge != point.edge) continue;
            const double cot = std::max(cot_at(part.from, part.to, between(line.start, line.end, point.at.from)),
                                        cot_at(part.from, part.to, between(line.start, line.end, point.at.to)));
            if (!(cot < best.cot)) continue;
            best = {cot, nullptr, &line, point.at};
        }
    }
    return best;
}

bool EdgeScene::looks_good(std::span<const VaguePoint> points) const {
    std::array<VaguePoint, most_vague_points> centres;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double t = 0.5 * (points[i].at.from + points[i].at.to);
        centres[i] = {points[i].edge, {t, t}};
    }
    const std::span<const VaguePoint> all(centres.data(), points.size());
    return all_parts(all, [&](const Part& part) {
        double sum = 0;
        for (int k = 0; k < sides_; ++k) sum += look_from(scenes_[k], part, all).cot;
        return part.from < part.to && sum >= 0;
    });
}

double EdgeScene::margin(std::span<const VaguePoint> points) const {
    double least = 1;
    (void)all_parts(points, [&](const Part& part) {
        double sum = 0;
        double size = 0;
        for (int k = 0; k < sides_; ++k) {
            const double cot = look_from(scenes_[k], part, points).cot;
            sum += cot;
            size += std::fabs(cot);
        }
        least = part.from < part.to ? std::min(least, sum / size) : -1;
        return part.from < part.to;
    });
    return least;
}

bool EdgeScene::is_bad(std::span<const VaguePoint> points) const {
    return !all_parts(points, [&](const Part& part) { return !is_bad(part, points); });
}

bool EdgeScene::is_bad(const Part& part, std::span<const VaguePoint> points) const {
    if (sides_ == 0 || part.to - part.from < least_length) return false;
    std::array<Seen, 2> seen;
    double sum = 0;
    for (int k = 0; k < sides_; ++k) sum += (seen[k] = look_from(scenes_[k], part, points)).cot;
    if (!(sum < 0)) return false;
    double proved = 0;
    for (int k = 0; k < sides_; ++k) proved = round_up(proved + highest_cot(part, seen[k]));
    return proved < 0;
}

/// The points that see a part under at least a given angle form a disc: where both ends of a stretch do, all of it
/// does.
double EdgeScene::highest_cot(const Part& part, const Seen& seen) const {
    if (seen.corner != nullptr) return highest_cot(part, *seen.corner);
    const auto at = [&](double t) {
        const Interval here = exactly(t);
        const Interval rest = exactly(1) - here;
        return FramePoint{seen.line->start.x * rest + seen.line->end.x * here,
                          seen.line->start.y * rest + seen.line->end.y * here};
    };
    return std::max(highest_cot(part, at(seen.at.from)), highest_cot(part, at(seen.at.to)));
}

/// An upper bound, whatever rounding does to split points; see EdgeStudy::proved_reach.
double EdgeScene::highest_cot(const Part& part, const FramePoint& p) const {
    const double from = round_up(part.from + slack_);
    const double to = round_down(part.to - slack_);
    if (!(to - from > 0.5 * least_length)) return infinity;
    const Interval left = p.x - exactly(from);
    const double distance = std::max(std::fabs(left.low), std::fabs(left.high)) + p.y.high;
    const double off = round_up(slack_ * (2 + 8 * distance / (to - from)));
    const Interval y = widened(p.y, off);
    if (!is_usable({left, y})) return infinity;
    const Interval x = widened(left, off);
    const Interval length = exactly(to) - exactly(from);
    return ((x * (x - length) + square(y)) / (y * length)).high;
}

}  // namespace delmesh
