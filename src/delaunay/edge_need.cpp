#include "delaunay/edge_need.hpp"

#include <cmath>
#include <optional>

namespace delmesh {
namespace {

constexpr std::size_t most_points = 1000;
constexpr int most_steps = 60;

/// A straight line of points in the frame of another edge, and the circle through that edge in which a point makes it
/// bad.
struct Crossing {
    FramePoint start;
    FramePoint end;
    Interval facing;  ///< the cotangent at the other side; 0 at the boundary
    double slack = 0;

    /// True if the point at t makes the edge bad wherever rounding puts it; proved.
    [[nodiscard]] bool is_blocked(double t) const {
        const Interval at = exactly(t);
        const Interval rest = exactly(1) - at;
        const FramePoint p{widened(start.x * rest + end.x * at, slack), widened(start.y * rest + end.y * at, slack)};
        return p.y.is_positive() && (scaled_cot(p) + facing * p.y).is_negative();
    }

    /// The roots, in doubles.
    [[nodiscard]] std::optional<Stretch> estimate() const {
        const double px = start.x.middle();
        const double py = start.y.middle();
        const double dx = end.x.middle() - px;
        const double dy = end.y.middle() - py;
        const double c = facing.middle();
        const double a = dx * dx + dy * dy;
        const double b = 0.5 * (2 * (px * dx + py * dy) - dx + c * dy);
        const double constant = px * (px - 1) + py * py + c * py;
        const double discriminant = b * b - a * constant;
        if (!(discriminant > 0) || !(a > 0)) return std::nullopt;
        const double root = b > 0 ? -b - std::sqrt(discriminant) : -b + std::sqrt(discriminant);
        return Stretch{b > 0 ? root / a : constant / root, b > 0 ? constant / root : root / a};
    }
};

}  // namespace

EdgeNeed EdgeStudy::study(EdgeId e, const std::vector<bool>& is_open) {
    EdgeNeed need;
    need.edge = e.value();
    const Mesh& mesh = view_.mesh();
    const HalfedgeId h = Mesh::halfedge(e);
    if (!view_.make_frame(mesh.origin(h), mesh.target(h), frame_)) return need;
    sides_ = 0;
    look(h);
    if (!mesh.is_boundary(h)) look(mesh.twin(h));
    find_stretches(need);
    find_blockers(need, is_open);
    return need;
}

void EdgeStudy::look(HalfedgeId h) {
    view_.look(h, views_[sides_]);
    points_[sides_].clear();
    for (const VertexId v : views_[sides_].corners) {
        const FramePoint p = view_.locate(frame_, v);
        if (is_usable(p)) points_[sides_].push_back(p);
    }
    ++sides_;
}

// --- what the edge needs ---

/// The farthest place where a part can end that begins at `from`, or before it; towards 0 if not `up`. For a point at
/// the distance x along the edge and y above it, the cotangent of a part of length l is (x^2 + y^2 - x l) / (y l).
double EdgeStudy::reach(double from, bool up) const {
    const double whole = up ? 1 : 0;
    for (int k = 0; k < sides_; ++k)
        if (points_[k].empty()) return whole;
    double length = up ? 1 - from : from;
    std::array<int, 2> seen{-1, -1};
    for (int step = 0; step < most_steps; ++step) {
        double constant = 0;
        double slope = 0;
        std::array<int, 2> now{-1, -1};
        for (int k = 0; k < sides_; ++k) {
            double least = std::numeric_limits<double>::infinity();
            double least_constant = 0;
            double least_slope = 0;
            for (std::size_t i = 0; i < points_[k].size(); ++i) {
                const double px = points_[k][i].x.middle();
                const double y = points_[k][i].y.middle();
                const double x = up ? px - from : from - px;
                const double cot = (x * x / y + y) - x / y * length;
                if (!(cot < least)) continue;
                least = cot;
                least_constant = x * x / y + y;
                least_slope = x / y;
                now[k] = static_cast<int>(i);
            }
            constant += least_constant;
            slope += least_slope;
        }
        if (now[0] < 0 || (sides_ == 2 && now[1] < 0) || !(constant - slope * length < 0)) break;
        const double shorter = constant / slope;
        if (!(shorter < length)) break;
        seen = now;
        const bool close = shorter > length * (1 - 1e-12);
        length = shorter;
        if (close) break;
    }
    return seen[0] < 0 ? whole : proved_reach(from, length, up, seen);
}

/// The same, from two points that see the part. Split points may be off by the slack. A part of at least half the
/// length that has such ends is turned back into the edge; points at the distance r then move by a slack and 2 r slack
/// / length at most, and along with them, the other end.
double EdgeStudy::proved_reach(double from, double length, bool up, const std::array<int, 2>& seen) const {
    const double least_length = 0.5 * length;
    const double begin = up ? round_up(from + frame_.slack) : round_down(from - frame_.slack);
    Interval constant;
    Interval slope;
    for (int k = 0; k < sides_; ++k) {
        const FramePoint& p = points_[k][static_cast<std::size_t>(seen[k])];
        const Interval along = up ? p.x - exactly(begin) : exactly(begin) - p.x;
        const double distance = std::max(std::fabs(along.low), std::fabs(along.high)) + p.y.high;
        const double off = round_up(frame_.slack * (2 + 8 * distance / least_length));
        const Interval x = widened(along, off);
        const Interval y = widened(p.y, off);
        if (!is_usable({x, y})) return up ? 1 : 0;
        constant = constant + square(x) / y + y;
        slope = slope + x / y;
    }
    if (!slope.is_positive()) return up ? 1 : 0;
    const double longest = std::max((constant / slope).high, least_length);
    const double reach = round_up(longest + 4 * frame_.slack);
    return up ? std::min(round_up(begin + reach), 1.0) : std::max(round_down(begin - reach), 0.0);
}

void EdgeStudy::find_stretches(EdgeNeed& need) const {
    std::vector<double> ups;
    for (double at = 0; ups.size() < most_points;) {
        const double next = reach(at, true);
        if (next >= 1 || !(next > at)) break;
        ups.push_back(at = next);
    }
    // Less than what is known: the doubles can not tell.
    if (ups.empty()) ups.push_back(1);
    need.points = ups.size();
    need.stretches.resize(need.points);
    double at = 1;
    for (std::size_t i = need.points; i-- > 0;) need.stretches[i] = {at = reach(at, false), ups[i]};
}

// --- what its points make bad ---

void EdgeStudy::find_blockers(EdgeNeed& need, const std::vector<bool>& is_open) const {
    const Mesh& mesh = view_.mesh();
    for (int k = 0; k < sides_; ++k) {
        for (const HalfedgeId side : views_[k].sides) {
            BlockedStretch blocker;
            blocker.edge = mesh.edge(side).value();
            if (!is_open[blocker.edge] && find_blocked(side, blocker)) need.blockers.push_back(blocker);
        }
    }
}

/// The stretch of the edge in which a point makes the given side bad. The points that do so lie in a circle, so where
/// two do, all between them do.
bool EdgeStudy::find_blocked(HalfedgeId side, BlockedStretch& blocker) const {
    const Mesh& mesh = view_.mesh();
    BoundView::Frame other;
    if (!view_.make_frame(mesh.origin(side), mesh.target(side), other)) return false;
    Crossing crossing{view_.locate(other, frame_.u), view_.locate(other, frame_.v), exactly(0), other.slack};
    if (!mesh.is_boundary(side)) {
        const HalfedgeId beyond = mesh.twin(side);
        if (!view_.is_certain(beyond)) return false;
        const FramePoint apex = view_.locate(other, mesh.apex(beyond));
        if (!is_usable(apex)) return false;
        crossing.facing = scaled_cot(apex) / apex.y;
    }
    const std::optional<Stretch> roots = crossing.estimate();
    if (!roots) return false;
    const double from = std::max(roots->from, 0.0);
    const double to = std::min(roots->to, 1.0);
    if (!(from < to)) return false;
    const auto certain = [&](double start, double step) -> std::optional<double> {
        for (double part = 0x1p-44; part < 0.4; part *= 64)
            if (crossing.is_blocked(start + part * step)) return start + part * step;
        return std::nullopt;
    };
    const std::optional<double> low = certain(from, to - from);
    const std::optional<double> high = low ? certain(to, from - to) : std::nullopt;
    if (!high || !(*low < *high)) return false;
    blocker.from = *low;
    blocker.to = *high;
    return true;
}

}  // namespace delmesh
