#include "delaunay/best_response.hpp"

#include "delaunay/thread_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

/// New points keep this distance from violations, relative to the cotangents involved: aligned points would make exact
/// ties, and rounding would break them.
constexpr double margin_interior = 4e-10;
constexpr double margin_boundary = 2e-10;
/// Points this near to the line of a side do not see it.
constexpr double flat = 1e-14;
/// Points of an edge keep this distance, as a part of the edge.
constexpr double least_room = 1e-7;
/// The same where rounding has broken what was here.
constexpr double wide_room = 1e-4;
constexpr std::size_t few_points = 4;
constexpr double centre_share = 0.4;
constexpr double align_share = 0.5;
constexpr int max_newton = 60;
/// Among more points a search by the model is faster.
constexpr std::size_t longest_list = 24;
/// What a response costs beside the evaluations that are counted one by one.
constexpr std::size_t response_work = 100;

/// How narrow a place is, as a cost: a point that has to be exact drifts and is not worth much.
int narrowness(double from, double to, double begin, double end) {
    const double middle = 0.5 * (from + to);
    const double room = (to - from) / std::min(middle - begin, end - middle);
    if (room > 1e-3) return 0;
    return room > 1e-6 ? 4 : 9;
}

}  // namespace

// --- what the edge itself needs ---

/// Lists what both sides see, since many questions about it follow. Unless `far`, only what parts of the stretch may
/// see under the largest angle.
void BestResponse::look(std::uint32_t e, bool far) {
    const FacetLayout& layout = model_.layout();
    for (int k = 0; k < 2; ++k) {
        View& view = views_[k];
        view.side = layout.edge(e).side[k];
        view.points.clear();
        view.listed = false;
        if (view.side == SplitModel::none) continue;
        const Side side = layout.side(view.side);
        const Facet& facet = layout.facet(side.facet);
        if (!facet.single) continue;
        view.listed = true;
        view.points.push_back({side.apex.x, side.apex.y, 1 / side.apex.y});
        for (std::uint32_t s = facet.first_side; s < facet.first_side + 3; ++s)
            if (s != view.side) look_at(side, view.side, s, far, view.points);
        view.listed = view.points.size() <= longest_list;
    }
    is_listed_ = std::all_of(views_.begin(), views_.end(),
                             [](const View& view) { return view.side == SplitModel::none || view.listed; });
}

void BestResponse::look_at(const Side& side, std::uint32_t s, std::uint32_t other, bool far,
                           std::vector<Seen>& points) const {
    const std::uint32_t edge = model_.layout().edge_at(other);
    const std::size_t n = model_.point_count(edge);
    if (n == 0) return;
    const auto [p, d] = model_.layout().seen_from(side, s, other);
    auto parts = model_.parts(edge).first(n);
    if (!far && n > few_points) parts = around_stretch(parts, p, d);
    for (const Part& part : parts) {
        const Point2 q = p + part.end * d;
        if (q.y > 0) points.push_back({q.x, q.y, 1 / q.y});
    }
}

/// Of the points p + u d, those that a part of the stretch may see under the largest angle. The angle is largest where
/// a circle through the part's ends touches the line, as far from where the line meets that of the edge as the
/// geometric mean of their distances: so that place moves one way as the ends do.
std::span<const Part> BestResponse::around_stretch(std::span<const Part> parts, Point2 p, Point2 d) const {
    const double at_low = largest_angle_on_line(low_, low_, p, d);
    const double at_high = largest_angle_on_line(high_, high_, p, d);
    const auto before = [](const Part& part, double value) { return part.end < value; };
    auto first = std::lower_bound(parts.begin(), parts.end(), std::min(at_low, at_high), before);
    auto last = std::lower_bound(first, parts.end(), std::max(at_low, at_high), before);
    if (first != parts.begin()) --first;
    if (last != parts.end()) ++last;
    return {first, last};
}

/// Of what is listed.
Point2 BestResponse::nearest(const View& view, double a, double b, double& cot) const {
    model_.count_work(view.points.size());
    Point2 best;
    cot = std::numeric_limits<double>::infinity();
    for (const Seen& seen : view.points) {
        const double candidate = cot_of(a, b, {seen.x, seen.y});
        if (candidate >= cot) continue;
        cot = candidate;
        best = {seen.x, seen.y};
    }
    return best;
}

/// What makes the part [a,b] bad, or false if it is not. Where that takes a walk through a facet, it is asked for no
/// more than that.
bool BestResponse::see(double a, double b, std::array<Point2, 2>& at, std::array<double, 2>& cot) const {
    const auto look_through = [&](std::size_t k, double bound) {
        const Contact contact = model_.nearest(views_[k].side, a, b, bound);
        cot[k] = contact.cot;
        at[k] = contact.at;
        return contact.cot < bound;
    };
    // What the other side may have at least.
    const auto enough = [&](std::size_t k) { return -cot[k] + 4 * margin_interior * std::fabs(cot[k]); };
    const auto is_listed = [&](std::size_t k) { return views_[k].listed; };
    for (std::size_t k = 0; k < 2; ++k) {
        if (is_listed(k)) at[k] = nearest(views_[k], a, b, cot[k]);
        if (views_[1 - k].side != SplitModel::none) continue;
        return is_listed(k) ? cot[k] < margin_boundary : look_through(k, margin_boundary);
    }
    if (!is_listed(0) && !is_listed(1)) {
        if (look_through(0, 0)) {
            if (!look_through(1, enough(0))) return false;
        } else if (!look_through(1, 0) || !look_through(0, enough(1))) {
            return false;
        }
    } else if (!is_listed(0) || !is_listed(1)) {
        const std::size_t k = is_listed(0) ? 1 : 0;
        if (!look_through(k, enough(1 - k))) return false;
    }
    return cot[0] + cot[1] < 0.5 * margin_interior * (std::fabs(cot[0]) + std::fabs(cot[1]));
}

/// The length of the part [a,b] if it is Delaunay, else the length at which the points that it sees now would let it
/// be, with one end fixed (a if `up`). For a point at distance x along the edge from the fixed end and y above it, the
/// cotangent of a part of length l is (x^2 + y^2 - x l) / (y l).
double BestResponse::step(double a, double b, bool up) const {
    std::array<Point2, 2> at;
    std::array<double, 2> cot{};
    if (!see(a, b, at, cot)) return b - a;
    double constant = 0;
    double slope = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        if (views_[k].side == SplitModel::none) continue;
        const double x = up ? at[k].x - a : b - at[k].x;
        constant += x * x / at[k].y + at[k].y;
        slope += x / at[k].y;
    }
    const double length = constant / slope * (1 - 1e-9);
    return length < b - a ? length : (b - a) * (1 - 1e-7);
}

/// The same, where all that both sides see is listed: from `from` on upwards or downwards as far as a part is Delaunay.
/// Of x^2 + y^2 - x l, over y, only the least matters.
template <bool up>
double BestResponse::listed_reach(double from) const {
    const double whole = up ? high_ - from : from - low_;
    const bool is_boundary = views_[0].side == SplitModel::none || views_[1].side == SplitModel::none;
    const std::size_t evaluations = views_[0].points.size() + views_[1].points.size();
    double length = whole;
    for (int i = 0; i < max_newton && length > 0; ++i) {
        model_.count_work(evaluations);
        double sum = 0;
        double size = 0;
        double constant = 0;
        double slope = 0;
        for (const View& view : views_) {
            double least = std::numeric_limits<double>::infinity();
            double least_constant = 0;
            double least_slope = 0;
            for (const Seen& seen : view.points) {
                const double x = up ? seen.x - from : from - seen.x;
                const double ratio = x * seen.inverse;
                const double value = (x - length) * ratio + seen.y;
                if (value >= least) continue;
                least = value;
                least_constant = x * ratio + seen.y;
                least_slope = ratio;
            }
            if (view.points.empty()) continue;
            sum += least;
            size += std::fabs(least);
            constant += least_constant;
            slope += least_slope;
        }
        if (!(sum < (is_boundary ? margin_boundary * length : 0.5 * margin_interior * size))) break;
        const double shorter = constant / slope * (1 - 1e-9);
        length = shorter < length ? shorter : length * (1 - 1e-7);
    }
    if (length == whole) return up ? high_ : low_;
    return up ? from + length : from - length;
}

/// The farthest end of a part that starts at `from` and is Delaunay. Newton's method on a concave function.
double BestResponse::reach_up(double from) const {
    if (is_listed_) return listed_reach<true>(from);
    double end = high_;
    for (int i = 0; i < max_newton && end > from; ++i) {
        const double length = step(from, end, true);
        if (length == end - from) return end;
        end = from + length;
    }
    return end;
}

double BestResponse::reach_down(double from) const {
    if (is_listed_) return listed_reach<false>(from);
    double start = low_;
    for (int i = 0; i < max_newton && start < from; ++i) {
        const double length = step(start, from, false);
        if (length == from - start) return start;
        start = from - length;
    }
    return start;
}

// --- what the other edges allow ---

void BestResponse::block(std::uint32_t e) {
    events_.clear();
    blocked_.clear();
    for (const std::uint32_t own : model_.layout().edge(e).side) {
        if (own == SplitModel::none) continue;
        const Facet& facet = model_.layout().facet(model_.layout().facet_at(own));
        for (std::uint32_t s = facet.first_side; s < facet.first_side + facet.side_count; ++s)
            if (model_.layout().edge_at(s) != e) block_by_side(own, s);
    }
    find_cells();
}

/// A point (x,y) makes a part [a,b] of side s bad where (a-x)(b-x) + y^2 < level * y * (b-a): inside a circle, so in an
/// interval of the edge.
void BestResponse::block_by_side(std::uint32_t own_side, std::uint32_t s) {
    const Side side = model_.layout().side(s);
    const auto [p, d] = model_.layout().seen_from(side, s, own_side);
    if (p.y <= flat && p.y + d.y <= flat) return;
    const FacetLayout::Edge& other = model_.layout().edge(side.edge);
    const int k = other.side[0] == s ? 0 : 1;
    const bool boundary = other.side[1 - k] == SplitModel::none;
    const int weight = model_.weight(side.edge);
    const double length2 = dot(d, d);
    const auto parts = model_.parts(side.edge);
    model_.count_work(parts.size());
    double a = 0;
    for (const Part& part : parts) {
        const double start = a;
        const double b = part.end;
        a = b;
        const double facing = part.cot[1 - k];
        const double level = boundary ? margin_boundary : -facing + margin_interior * std::fabs(facing);
        const double linear = dot(p, d) - 0.5 * ((start + b) * d.x + level * (b - start) * d.y);
        const double constant = (start - p.x) * (b - p.x) + p.y * p.y - level * (b - start) * p.y;
        const double discriminant = linear * linear - length2 * constant;
        if (!(discriminant > 0)) continue;
        const double root = linear > 0 ? -linear - std::sqrt(discriminant) : -linear + std::sqrt(discriminant);
        const double from = (linear > 0 ? root / length2 : constant / root) - 1e-13;
        const double to = (linear > 0 ? constant / root : root / length2) + 1e-13;
        if (to <= low_ || from >= high_) continue;
        if (!model_.reaches(s, start, b, level, own_side)) continue;
        blocked_.push_back({from, to, weight});
        events_.push_back({std::max(from, low_), weight});
        if (to < high_) events_.push_back({to, -weight});
    }
}

void BestResponse::find_cells() {
    std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
    cells_.clear();
    double last = low_;
    int weight = 0;
    for (const Event& event : events_) {
        if (event.at > last) {
            cells_.push_back({last, event.at, weight});
            last = event.at;
        }
        weight += event.weight;
    }
    if (last < high_) cells_.push_back({last, high_, weight});
}

/// What a point at t makes bad; less where it does so by a hair, since that is easy to mend.
int BestResponse::soft_weight(double t) const {
    double sum = 0;
    for (const Cell& b : blocked_) {
        if (t <= b.begin || t >= b.end) continue;
        const double depth = std::min(t - b.begin, b.end - t) / (b.end - b.begin);
        sum += b.weight * std::min(1.0, 0.5 + 2 * depth);
    }
    return static_cast<int>(sum);
}

// --- places to try ---

/// Places near the ends of a cell, at a random scale: what is blocked there is blocked by a hair.
std::array<double, 2> BestResponse::near_ends(double begin, double end) {
    const double distance = 0.2 * std::ldexp(end - begin, -static_cast<int>(random_.below(16)));
    return {begin + distance, end - distance};
}

double BestResponse::pick(double low, double high) {
    return low + (high - low) * (random_.chance(centre_share) ? 0.5 : random_.uniform());
}

// --- the choice ---

std::span<const double> BestResponse::solve(std::uint32_t e, std::size_t first, std::size_t last) {
    chosen_.clear();
    low_ = model_.part_start(e, first);
    high_ = model_.parts(e)[last].end;
    room_ = std::min(model_.is_distrusted(e) ? wide_room : least_room, 0.01 * (high_ - low_));
    model_.count_work(response_work);
    look(e, false);
    const double up = reach_up(low_);
    first_reach_ = up;
    if (up >= high_ && last > first) return chosen_;
    block(e);
    aligned_.clear();
    if (!is_quick_ && random_.chance(align_share)) add_aligned_places(model_, e, {low_, high_}, aligned_);
    const double down = reach_down(high_);
    last_reach_ = down;
    if (!place_one(std::max(down, low_ + room_), std::min(up, high_ - room_))) place_many();
    return chosen_;
}

/// A single point between low and high where it blocks next to nothing.
bool BestResponse::place_one(double low, double high) {
    if (!(low < high)) return false;
    constexpr int too_much = 15;
    int least = too_much - 1;
    std::size_t count = 0;
    double at = 0;
    double width = 0;
    const bool by_width = random_.chance(0.5);
    for (const Cell& cell : cells_) {
        const double from = std::max(cell.begin, low);
        const double to = std::min(cell.end, high);
        if (!(from < to) || cell.weight > least) continue;
        const int weight = cell.weight + narrowness(from, to, low_, high_);
        if (weight > least) continue;
        if (weight < least) {
            least = weight;
            count = 0;
            width = 0;
        }
        ++count;
        width += to - from;
        if (by_width ? random_.uniform() * width < to - from : random_.below(count) == 0) at = pick(from, to);
    }
    std::size_t cell = 0;
    std::size_t aligned_count = 0;
    for (const double t : aligned_) {
        if (t <= low || t >= high) continue;
        while (cell + 1 < cells_.size() && cells_[cell].end <= t) ++cell;
        if (cells_[cell].weight > least) continue;
        if (cells_[cell].weight < least) aligned_count = 0;
        least = cells_[cell].weight;
        if (random_.below(++aligned_count) == 0) at = t;
    }
    if (count + aligned_count == 0) return false;
    chosen_.push_back(at);
    return true;
}

/// In units of the edge, squared.
double BestResponse::distance2_to_others(double t) const {
    const double to_ends = std::min(t - low_, high_ - t);
    double least = to_ends * to_ends;
    for (const View& view : views_)
        for (const Seen& p : view.points) least = std::min(least, (p.x - t) * (p.x - t) + p.y * p.y);
    return least;
}

double BestResponse::spread(std::uint32_t e, std::size_t i) {
    constexpr int places = 7;
    const double now = model_.parts(e)[i].end;
    low_ = model_.part_start(e, i);
    high_ = model_.parts(e)[i + 1].end;
    model_.count_work(response_work);
    look(e, true);
    const double up = reach_up(low_);
    const double down = reach_down(high_);
    block(e);
    double best = now;
    double farthest = 1.01 * distance2_to_others(now);
    for (const Cell& cell : cells_) {
        const double from = std::max(cell.begin, down);
        const double to = std::min(cell.end, up);
        if (cell.weight > 0 || !(from < to)) continue;
        for (int k = 1; k <= places; ++k) {
            const double t = from + (to - from) * k / (places + 1);
            const double distance2 = distance2_to_others(t);
            if (distance2 <= farthest) continue;
            farthest = distance2;
            best = t;
        }
    }
    return best;
}

double BestResponse::weave(std::uint32_t e, std::size_t first) {
    aim_at(e, first);
    add_thread_places(model_, e, {low_, high_}, aligned_);
    return place_in_middle();
}

double BestResponse::halve(std::uint32_t e, std::size_t first) {
    aim_at(e, first);
    add_aligned_places(model_, e, {low_, high_}, aligned_);
    return place_in_middle();
}

void BestResponse::aim_at(std::uint32_t e, std::size_t first) {
    low_ = model_.part_start(e, first);
    high_ = model_.parts(e)[first].end;
    room_ = std::min(model_.is_distrusted(e) ? wide_room : least_room, 0.01 * (high_ - low_));
    chosen_.clear();
    aligned_.clear();
    model_.count_work(response_work);
    look(e, false);
    block(e);
}

double BestResponse::place_in_middle() {
    const double up = reach_up(low_);
    const double down = reach_down(high_);
    const double edge = 1e-6 * (high_ - low_);
    const double from = std::max(std::min(up, down), low_ + edge);
    const double to = std::min(std::max(up, down), high_ - edge);
    if (from < to && place_one(from, to)) return chosen_.front();
    int least = std::numeric_limits<int>::max();
    std::size_t count = 0;
    double at = 0.5 * (low_ + high_);
    const auto consider = [&](double t) {
        if (t <= from || t >= to) return;
        const int weight = soft_weight(t);
        if (weight > least) return;
        if (weight < least) count = 0;
        least = weight;
        if (random_.below(++count) == 0) at = t;
    };
    for (const Cell& cell : cells_) {
        const double begin = std::max(cell.begin, from);
        const double end = std::min(cell.end, to);
        if (!(begin < end)) continue;
        consider(pick(begin, end));
        for (const double t : near_ends(begin, end)) consider(t);
    }
    for (const double t : aligned_) consider(t);
    return at;
}

}  // namespace delmesh
