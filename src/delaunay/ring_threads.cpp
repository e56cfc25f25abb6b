#include "delaunay/ring_threads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double farthest = 0.75;  ///< from the border, of the shortest rung
constexpr double nearest = 1e-8;
constexpr double finer = 0.85;       ///< distances that are tried
constexpr double coarser = 0.5;      ///< the same, where there is little work to do that with
constexpr double far_enough = 0.05;  ///< threads that come so far may meet those from the other border
/// A thread that is stiffer may be nearer by so much.
constexpr double near_enough = 0.3;
constexpr int refinements = 3;
/// If nothing else fits, small steps beyond the last thread.
constexpr std::array<double, 4> small_steps{1.15, 1.1, 1.06, 1.03};
constexpr std::size_t most_tries = 2000;
constexpr std::size_t least_tries = 300;
constexpr std::size_t most_work = 60'000'000;  ///< tries times rungs
constexpr int most_dead_ends = 3;
constexpr std::size_t few_bad = 16;        ///< one rung in so many may be left to those who slide points
constexpr std::size_t most_threads = 128;  ///< from each border
/// With so few threads no others are tried.
constexpr std::size_t few_threads = 4;
constexpr double stiffest = 1e5;
/// Styles: threads that rise where facets are wide, or where both beside a rung are, or nowhere; and those that leave
/// steep borders only step by step.
constexpr std::size_t plain = 2;
constexpr std::size_t gentle = 3;
constexpr double softest = 0x1p-6;
/// What a part must have, against ties.
constexpr double margin = 1e-8;
constexpr double flat = 1e-14;

double length_of(Point2 d) {
    return std::sqrt(dot(d, d));
}

double cross(Point2 a, Point2 b) {
    return a.x * b.y - a.y * b.x;
}

/// The cotangent at which p sees [a,b]; p may lie on the line, where it sees nothing.
double cot_from(double a, double b, Point2 p, double scale) {
    return p.y > flat * scale ? cot_of(a, b, p) : infinity;
}

}  // namespace

RingThreads::Joint RingThreads::joint(const Side& from, const Side& to, const Rung& rung, const Rung& next,
                                      double length, bool mirrored) const {
    const auto place = [&](double t) {
        Point2 p = from.to_frame(to.at(t));
        if (rung.reversed != mirrored) p.x = 1 - p.x;
        return length * p;
    };
    const bool backward = next.reversed != mirrored;
    Joint joint;
    joint.start = place(backward ? 1 : 0);
    const Point2 end = place(backward ? 0 : 1);
    const Point2 d = end - joint.start;
    joint.along = (1 / length_of(d)) * d;
    Point2 middle = Point2{1, 0} + joint.along;
    middle = (1 / length_of(middle)) * middle;
    joint.lean = dot(joint.start, middle) / middle.x;
    joint.width = std::fabs(cross(middle, joint.start));
    joint.widening = (std::fabs(cross(middle, end - Point2{length, 0})) - joint.width) / length;
    return joint;
}

/// False if the shape is not to be had in doubles.
bool RingThreads::lay_out(std::span<const Rung> rungs) {
    const FacetLayout& layout = model_.layout();
    const std::size_t n = rungs.size();
    lengths_.assign(n, 1);
    for (Joints& joints : joints_) joints.assign(n, {});
    const auto side_of = [&](std::size_t i, std::uint32_t facet) {
        const std::uint32_t e = rungs[i].edge;
        return layout.edge(e).side[layout.side_within(e, facet)];
    };
    int k = 1;  // where the ring begins
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = i + 1 == n ? 0 : i + 1;
        const std::array<std::uint32_t, 2>& sides = layout.edge(rungs[i].edge).side;
        const Side from = layout.side(sides[k]);
        const std::uint32_t arrival = side_of(next, from.facet);
        const Side to = layout.side(arrival);
        for (const bool mirrored : {false, true})
            joints_[mirrored ? 1 : 0][i] = joint(from, to, rungs[i], rungs[next], lengths_[i], mirrored);
        if (next > 0) lengths_[next] = lengths_[i] * length_of(to.along) / length_of(from.along);
        k = layout.edge(rungs[next].edge).side[0] == arrival ? 1 : 0;
    }
    find_sizes();
    shortest_ = *std::min_element(lengths_.begin(), lengths_.end());
    return std::isfinite(shortest_) && shortest_ > 0;
}

/// A single narrow facet between wide ones is as good as a wide one.
void RingThreads::find_sizes() {
    const std::size_t n = lengths_.size();
    const auto size = [&](std::size_t i) { return std::max(joints_[0][i].width, joints_[1][i].width); };
    const auto closed = [&](std::size_t i) {
        const std::size_t before = i == 0 ? n - 1 : i - 1;
        const std::size_t next = i + 1 == n ? 0 : i + 1;
        return std::max(size(i), std::min(size(before), size(next)));
    };
    for (std::vector<double>& sizes : sizes_) sizes.assign(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = i == 0 ? n - 1 : i - 1;
        sizes_[0][i] = std::min(closed(before), closed(i));
        sizes_[1][i] = std::min(size(before), size(i));
    }
}

/// A system that is tridiagonal but for the corners: it minimises what `relax` states.
void RingThreads::solve(std::vector<double> diagonal, std::vector<double> right, Thread& solution) const {
    const std::size_t n = diagonal.size();
    // Sherman and Morrison: without the corners, and a correction.
    const double corner = -stiffness_[n - 1];
    const double pivot = -diagonal[0];
    std::vector<double> update(n, 0);
    update[0] = pivot;
    update[n - 1] = corner;
    diagonal[0] -= pivot;
    diagonal[n - 1] -= corner * corner / pivot;
    for (std::size_t i = 1; i < n; ++i) {
        const double factor = stiffness_[i - 1] / diagonal[i - 1];
        diagonal[i] -= factor * stiffness_[i - 1];
        right[i] += factor * right[i - 1];
        update[i] += factor * update[i - 1];
    }
    for (std::size_t i = n; i-- > 0;) {
        const bool last = i + 1 == n;
        right[i] = (right[i] + (last ? 0 : stiffness_[i] * right[i + 1])) / diagonal[i];
        update[i] = (update[i] + (last ? 0 : stiffness_[i] * update[i + 1])) / diagonal[i];
    }
    const double share = corner / pivot;
    const double by = (right[0] + share * right[n - 1]) / (1 + update[0] + share * update[n - 1]);
    solution.resize(n);
    for (std::size_t i = 0; i < n; ++i) solution[i] = right[i] - by * update[i];
}

/// Minimises the sum over rungs of (x - d)^2 / d^2, and over facets of (step along the rungs)^2 (d / w^2)^2, where d is
/// larger where facets are wide against the distance that is asked for.
void RingThreads::relax(int border, std::size_t style, double distance, Thread& thread) {
    const Joints& joints = joints_[border];
    const std::size_t n = joints.size();
    const auto target = [&](std::size_t i) {
        const double w = sizes_[std::min(style, plain)][i];
        return distance < w ? std::sqrt(std::sqrt(distance * w) * w) : distance;
    };
    stiffness_.assign(n, 0);
    std::vector<double> diagonal(n, 0);
    std::vector<double> right(n, 0);
    double d = target(0);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = i + 1 == n ? 0 : i + 1;
        const double d_next = target(next);
        diagonal[i] += 1 / (d * d);
        right[i] += 1 / d;
        const double nearer = std::min(d, d_next);
        const double width = joints[i].width + joints[i].widening * std::min(nearer, lengths_[i]);
        const double ratio = nearer * nearer / (width * width);
        const double stiff = std::min(ratio, stiffest);
        const double k =
            (style >= gentle ? (style == gentle ? 0.25 : softest) * stiff : taste_.stiffness * stiff * stiff) /
            (nearer * nearer);
        stiffness_[i] = k;
        diagonal[i] += k;
        diagonal[next] += k;
        right[i] += k * joints[i].lean;
        right[next] -= k * joints[i].lean;
        d = d_next;
    }
    solve(std::move(diagonal), std::move(right), thread);
    model_.count_work(6 * n);
}

/// The parts between the two threads that are bad, up to `most` and one more.
std::size_t RingThreads::bad_parts(int border, const Thread& below, const Thread& above, std::size_t most) const {
    const Joints& joints = joints_[border];
    const std::size_t n = joints.size();
    for (std::size_t i = 0; i < n; ++i)
        if (!(below[i] < above[i]) || !(above[i] <= lengths_[i])) return most + 1;
    std::size_t bad = 0;
    const auto seen_after = [&](std::size_t i, double a, double b, double x) {
        const Joint& joint = joints[i];
        return cot_from(a, b, joint.start + x * joint.along, lengths_[i]);
    };
    const auto seen_before = [&](std::size_t before, double a, double b, double x) {
        const Joint& joint = joints[before];
        const Point2 d = Point2{x, 0} - joint.start;
        return cot_from(a, b, {dot(d, joint.along), std::fabs(cross(d, joint.along))}, lengths_[before]);
    };
    for (std::size_t i = 0; i < n; ++i) {
        const double a = below[i];
        const double b = above[i];
        const std::size_t next = i + 1 == n ? 0 : i + 1;
        const std::size_t before = i == 0 ? n - 1 : i - 1;
        const double after = std::min(seen_after(i, a, b, below[next]), seen_after(i, a, b, above[next]));
        const double front =
            std::min(seen_before(before, a, b, below[before]), seen_before(before, a, b, above[before]));
        const bool good =
            after + front >= margin * (std::fabs(after) + std::fabs(front)) || after == infinity || front == infinity;
        if (!good && ++bad > most) {
            model_.count_work(2 * n / 3 + 4 * i);
            return bad;
        }
    }
    model_.count_work(5 * n);
    return bad;
}

/// One thread more from a border, as far from the last one as can be; where that leads nowhere, one less. False at the
/// end.
bool RingThreads::grow_once(int border) {
    std::vector<Thread>& threads = threads_[border];
    auto& [chosen, from, tries, dead_ends] = growth_[border];
    const std::size_t most = std::clamp(most_work / rungs_.size(), least_tries, most_tries);
    if (threads.size() > most_threads || tries >= most) return false;
    Try next{from, 0};
    if (find_next(border, threads.back(), chosen.back().distance, next, tries)) {
        threads.push_back(thread_);
        chosen.push_back(next);
        from = 0;
        return true;
    }
    if (threads.size() == 1 || chosen.back().distance >= far_enough * shortest_) return false;
    if (++dead_ends > most_dead_ends) return false;
    from = chosen.back().number + 1;
    threads.pop_back();
    chosen.pop_back();
    return true;
}

/// Begins at a border.
void RingThreads::start(int border) {
    threads_[border].assign(1, Thread(rungs_.size(), 0));
    growth_[border] = {{{0, nearest * shortest_}}, 0, 0, 0};
}

void RingThreads::grow(int border) {
    start(border);
    while (grow_once(border)) {
    }
}

/// From both borders by turns, no farther than is needed if that is not far.
bool RingThreads::grow_until_joined() {
    for (const int border : {0, 1}) start(border);
    if (meets_last(0)) return true;
    for (std::array<bool, 2> grows{true, true}; grows[0] || grows[1];) {
        for (const int border : {0, 1}) {
            if (!grows[border]) continue;
            const std::size_t before = threads_[border].size();
            grows[border] = grow_once(border);
            if (threads_[border].size() > before && meets_last(border)) return true;
        }
    }
    return join(0);
}

/// Distances to try beyond a thread at `last`, the farthest first.
void RingThreads::list_distances(double last) {
    distances_.clear();
    for (double d = farthest * shortest_; d > small_steps[0] * last; d *= step_) distances_.push_back(d);
    for (const double step : small_steps) distances_.push_back(step * last);
}

/// The farthest thread beyond `below`, from try number `next.number` on, or a stiffer one that is not much nearer; it
/// is left in `thread_`.
bool RingThreads::find_next(int border, const Thread& below, double last, Try& next, std::size_t& tries) {
    list_distances(last);
    const bool is_first = next.number == 0;
    Thread thread;
    const auto fits_at = [&](std::size_t style, double distance) {
        ++tries;
        relax(border, style, distance, thread);
        if (!fits(border, below, thread)) return false;
        thread_ = thread;
        next.distance = distance;
        return true;
    };
    const std::size_t end = distances_.size() * styles;
    while (next.number < end && !fits_at(next.number % styles, distances_[next.number / styles])) ++next.number;
    if (next.number == end) return false;
    std::size_t k = next.number / styles;
    std::size_t style = next.number % styles;
    for (std::size_t stiff = 0; is_first && taste_.prefers_stiff && stiff < style; ++stiff)
        for (std::size_t i = k + 1; i < distances_.size() && distances_[i] > near_enough * distances_[k]; ++i) {
            if (!fits_at(stiff, distances_[i])) continue;
            style = stiff;
            k = i;
            break;
        }
    double above = k > 0 ? distances_[k - 1] : next.distance;
    for (int i = 0; i < refinements && above > next.distance; ++i) {
        const double middle = std::sqrt(next.distance * above);
        if (!fits_at(style, middle)) above = middle;
    }
    return true;
}

void RingThreads::mirror(const Thread& thread, Thread& other) const {
    other.resize(thread.size());
    for (std::size_t i = 0; i < thread.size(); ++i) other[i] = lengths_[i] - thread[i];
}

/// The fewest threads from both borders that have no bad part between them; else those with the fewest, up to `most`.
bool RingThreads::join(std::size_t most) {
    bool found = false;
    Thread other;
    for (std::size_t sum = 0; sum + 2 <= threads_[0].size() + threads_[1].size(); ++sum) {
        // Rather as many from one border as from the other.
        for (std::size_t k = 0; k <= sum; ++k) {
            const std::size_t i = k % 2 == 0 ? (sum + k + 1) / 2 : (sum - k) / 2;
            if (i > sum || i >= threads_[0].size() || sum - i >= threads_[1].size()) continue;
            mirror(threads_[1][sum - i], other);
            const std::size_t bad = bad_parts(0, threads_[0][i], other, most);
            if (bad > most) continue;
            from_border_ = {i, sum - i};
            if (bad == 0) return true;
            found = true;
            most = bad - 1;
        }
    }
    return found;
}

/// Does the last thread from a border leave no part bad between itself and one from the other border, few in all?
bool RingThreads::meets_last(int border) {
    std::array<std::size_t, 2> at{threads_[0].size() - 1, threads_[1].size() - 1};
    Thread other;
    for (std::size_t i = 0; i < threads_[1 - border].size() && at[border] + i <= few_threads; ++i) {
        at[1 - border] = i;
        if (border == 0 || i == 0) mirror(threads_[1][at[1]], other);
        if (bad_parts(0, threads_[0][at[0]], other, 0) > 0) continue;
        from_border_ = at;
        return true;
    }
    return false;
}

bool RingThreads::plan(std::span<const Rung> rungs, bool is_quick) {
    rungs_ = rungs;
    step_ = is_quick ? coarser : finer;
    from_border_ = {};
    if (rungs.size() < 3 || !lay_out(rungs)) return false;
    std::size_t fewest = 0;
    for (const Taste& taste : tastes) {
        taste_ = taste;
        if (is_quick) {
            if (grow_until_joined()) return true;
            continue;
        }
        grow(0);
        grow(1);
        if (!join(0) || (fewest > 0 && count() >= fewest)) continue;
        fewest = count();
        for (std::size_t i = 0; i < 2; ++i) {
            best_[i] = threads_[i];
            best_[i].resize(from_border_[i] + 1);
        }
        if (fewest <= few_threads) break;
    }
    if (fewest == 0) return join(rungs.size() / few_bad);
    threads_ = best_;
    from_border_ = {threads_[0].size() - 1, threads_[1].size() - 1};
    return true;
}

void RingThreads::places(std::size_t rung, std::vector<double>& places) const {
    places.clear();
    const double length = lengths_[rung];
    const bool reversed = rungs_[rung].reversed;
    // From the border of each family, so that no digits are lost there.
    for (std::size_t i = 1; i <= from_border_[0]; ++i) {
        const double t = threads_[0][i][rung] / length;
        places.push_back(reversed ? 1 - t : t);
    }
    for (std::size_t i = from_border_[1]; i > 0; --i) {
        const double t = threads_[1][i][rung] / length;
        places.push_back(reversed ? t : 1 - t);
    }
    if (reversed) std::reverse(places.begin(), places.end());
}

}  // namespace delmesh
