#include "delaunay/split_model.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Points this near to the line of a side do not see it.
constexpr double flat = 1e-14;
/// Ties are no violations: what the model can not tell is left to the exact signs at the end.
constexpr double tie_interior = 1e-13;
constexpr double tie_boundary = 1e-12;
/// Half of what new points keep.
constexpr double distance = 1e-10;
constexpr std::size_t few = 6;
/// Room for them.
constexpr std::size_t parts_per_edge = 3;

/// Those of the sorted points p + u d that may see [a,b] under the largest angle: the angle rises to its maximum along
/// the line and falls behind it.
std::span<const double> worth_a_look(std::span<const double> points, double a, double b, Point2 p, Point2 d) {
    if (points.size() <= few) return points;
    const double top = largest_angle_on_line(a, b, p, d);
    const auto above = static_cast<std::size_t>(std::lower_bound(points.begin(), points.end(), top) - points.begin());
    const std::size_t first = above == 0 ? 0 : above - 1;
    return points.subspan(first, std::min<std::size_t>(2, points.size() - first));
}

}  // namespace

double largest_angle_on_line(double a, double b, Point2 p, Point2 d) {
    const double middle = 0.5 * (a + b);
    const double half = 0.5 * (b - a);
    const double length2 = dot(d, d);
    const Point2 c{p.x - middle, p.y};
    const double linear = dot(c, d);
    const double constant = dot(c, c) - half * half;
    if (d.y * d.y < 1e-28 * length2) return -linear / length2;
    const double discriminant = p.y * p.y - d.y * (2 * linear * p.y - constant * d.y) / length2;
    return (std::sqrt(std::max(discriminant, 0.0)) - p.y) / d.y;
}

// --- storage ---

void SplitModel::grow_states() {
    if (states_.size() < layout_.edge_count()) states_.resize(layout_.edge_count());
}

std::uint32_t SplitModel::allocate(std::uint8_t size_class) {
    auto& list = free_[size_class];
    if (!list.empty()) {
        const std::uint32_t first = list.back();
        list.pop_back();
        return first;
    }
    const auto first = static_cast<std::uint32_t>(pool_.size());
    pool_.resize(pool_.size() + (std::size_t{1} << size_class));
    return first;
}

/// No facet has points when its sides are made.
double SplitModel::cot_at_corner(std::uint32_t s) const {
    const Side side = layout_.side(s);
    work_ += layout_.facet(side.facet).single ? 1 : corner_work;
    return cot_of(0, 1, side.apex);
}

void SplitModel::make(std::uint32_t e) {
    grow_states();
    if (states_[e].made) return;
    layout_.complete(e);
    grow_states();
    Part part;
    for (int k = 0; k < 2; ++k) {
        const std::uint32_t s = layout_.edge(e).side[k];
        if (s == none) continue;
        part.cot[k] = trusts_triangles_ ? cot_at_corner(s) : nearest(s, 0, 1).cot;
    }
    State& state = states_[e];
    state.made = true;
    state.count = 1;
    state.first = allocate(0);
    state.movable = state.movable && layout_.edge(e).is_usable;
    pool_[state.first] = part;
}

void SplitModel::prepare(std::uint32_t e) {
    if (is_prepared(e)) return;
    make(e);
    const std::array<std::uint32_t, 2> sides = layout_.edge(e).side;  // a copy, as the layout grows
    for (const std::uint32_t s : sides) {
        if (s == none) continue;
        const Facet facet = layout_.facet(layout_.facet_at(s));
        for (std::uint32_t i = 0; i < facet.side_count; ++i) make(layout_.edge_at(facet.first_side + i));
    }
    states_[e].prepared = true;
}

void SplitModel::expect(std::size_t edges) {
    constexpr std::size_t facets_around = 6;
    layout_.expect(std::min(facets_around * edges, layout_.marked().mesh().face_count()));
    const std::size_t most = layout_.edge_capacity();
    states_.reserve(most);
    pool_.reserve(pool_.size() + parts_per_edge * (most - layout_.edge_count()));
}

std::size_t SplitModel::part_at(std::uint32_t e, double at) const {
    const auto all = parts(e);
    const auto found =
        std::lower_bound(all.begin(), all.end(), at, [](const Part& part, double value) { return part.end < value; });
    return static_cast<std::size_t>(found - all.begin());
}

// --- transactions ---

void SplitModel::begin() {
    in_transaction_ = true;
    ++transaction_;
}

void SplitModel::save(std::uint32_t e) {
    State& state = states_[e];
    if (!in_transaction_ || state.transaction == transaction_) return;
    state.transaction = transaction_;
    saved_.push_back({e, state.first, state.count, state.size_class});
    const std::uint32_t copy = allocate(state.size_class);
    std::copy_n(pool_.begin() + state.first, state.count, pool_.begin() + copy);
    state.first = copy;
}

void SplitModel::add_weight(std::uint32_t e, int more) {
    if (states_[e].weight == base_weight) touched_weights_.push_back(e);
    states_[e].weight += more;
}

void SplitModel::commit() {
    for (const Saved& saved : saved_) release(saved.first, saved.size_class);
    saved_.clear();
    for (const std::uint32_t e : touched_weights_) states_[e].weight = base_weight;
    touched_weights_.clear();
    in_transaction_ = false;
}

void SplitModel::rollback() {
    for (const Saved& saved : saved_) {
        State& state = states_[saved.edge];
        points_ += saved.count;
        points_ -= state.count;
        release(state.first, state.size_class);
        state.first = saved.first;
        state.count = saved.count;
        state.size_class = saved.size_class;
    }
    saved_.clear();
    for (const std::uint32_t e : suspects_) states_[e].suspected = false;
    suspects_.clear();
    commit();
}

// --- judgement ---

bool SplitModel::is_bad(std::uint32_t e, const Part& part) const {
    const FacetLayout::Edge& edge = layout_.edge(e);
    if (states_[e].count == 1 && part.culprit[0] == none && part.culprit[1] == none) return !edge.is_delaunay;
    const double sum = part.cot[0] + part.cot[1];
    const double size = std::fabs(part.cot[0]) + std::fabs(part.cot[1]);
    if (states_[e].distrusted) return sum < distance * size;
    if (edge.side[0] == none || edge.side[1] == none) return sum < -tie_boundary;
    return sum < -tie_interior * size;
}

int SplitModel::first_bad(std::uint32_t e) const {
    const auto all = parts(e);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (is_bad(e, all[i])) return static_cast<int>(i);
    return -1;
}

void SplitModel::add_suspect(std::uint32_t e) {
    if (states_[e].suspected || states_[e].given_up) return;
    states_[e].suspected = true;
    suspects_.push_back(e);
}

void SplitModel::drop_suspect(std::size_t i) {
    states_[suspects_[i]].suspected = false;
    suspects_[i] = suspects_.back();
    suspects_.pop_back();
}

// --- changes ---

void SplitModel::replace_parts(std::uint32_t e, std::size_t first, std::size_t last, std::span<const double> points) {
    const FacetLayout::Edge& edge = layout_.edge(e);
    State& state = states_[e];
    const auto old = parts(e);
    scratch_.assign(old.begin(), old.begin() + static_cast<std::ptrdiff_t>(first));
    for (std::size_t i = 0; i <= points.size(); ++i) {
        Part part;
        part.end = i < points.size() ? points[i] : old[last].end;
        scratch_.push_back(part);
    }
    for (std::size_t k = 0; k < 2; ++k) {
        if (edge.side[k] == none) continue;
        double start = part_start(e, first);
        const Eye eye = eye_at(edge.side[k]);
        for (std::size_t i = first; i <= first + points.size(); ++i) {
            Part& part = scratch_[i];
            const Contact contact = nearest(eye, start, part.end, infinity);
            part.cot[k] = contact.cot;
            part.culprit[k] = contact.edge;
            start = part.end;
        }
    }
    scratch_.insert(scratch_.end(), old.begin() + static_cast<std::ptrdiff_t>(last) + 1, old.end());
    const auto size_class = static_cast<std::uint8_t>(std::bit_width(scratch_.size() - 1));
    if (size_class != state.size_class) {
        release(state.first, state.size_class);
        state.size_class = size_class;
        state.first = allocate(size_class);
    }
    points_ += scratch_.size();
    points_ -= state.count;
    state.count = static_cast<std::uint32_t>(scratch_.size());
    std::copy(scratch_.begin(), scratch_.end(), pool_.begin() + state.first);
    for (std::size_t i = first; i <= first + points.size(); ++i)
        if (is_bad(e, scratch_[i])) return add_suspect(e);
}

void SplitModel::cut(std::uint32_t e, std::size_t first, std::size_t last, std::span<const double> points) {
    save(e);
    replace_parts(e, first, last, points);
    for (const std::uint32_t s : layout_.edge(e).side)
        if (s != none) touch_facet(e, s, points, last > first);
}

void SplitModel::touch_facet(std::uint32_t e, std::uint32_t side, std::span<const double> points, bool removed) {
    const Facet& facet = layout_.facet(layout_.facet_at(side));
    if (!facet.single) work_ += side_work_ * facet.side_count;  // beside its parts
    placed_.clear();
    if (!facet.single && !points.empty() && points.size() <= few) {
        const SideLine line = layout_.line(side);
        placed_ = {line.start, line.start + line.along};
        placed_along_ = line.along;
        for (const double u : points) placed_.push_back(line.start + u * line.along);
    }
    for (std::uint32_t s = facet.first_side; s < facet.first_side + facet.side_count; ++s)
        if (layout_.edge_at(s) != e && !stays(e, s, removed)) touch_side(e, side, s, points, removed);
}

/// What `touch_side` finds at first, to the last bit.
bool SplitModel::lies_flat(const SideLine& line) const {
    const double inverse = 1 / dot(line.along, line.along);
    const Point2 x_row = inverse * line.along;
    const Point2 y_row = (line.mirrored ? -1.0 : 1.0) * Point2{-x_row.y, x_row.x};
    const double y = dot(y_row, placed_[0] - line.start);
    return y <= flat && y + dot(y_row, placed_along_) <= flat;
}

/// True if it is clear, by more than rounding can change, that `touch_side` would find nothing: it is asked for each
/// side of a facet, and few of them see the new points under the largest angle.
bool SplitModel::stays(std::uint32_t e, std::uint32_t s, bool removed) const {
    constexpr double slack = 1e-12;
    if (placed_.empty()) return false;
    const SideLine line = layout_.line(s);
    const Point2 left{line.mirrored ? line.along.y : -line.along.y, line.mirrored ? -line.along.x : line.along.x};
    const double length2 = dot(line.along, line.along);
    bool is_seen = false;
    bool is_flat = true;
    for (std::size_t i = 0; i < 2; ++i) {
        const Point2 r = placed_[i] - line.start;
        const double height = dot(left, r);
        const double r2 = dot(r, r);
        is_seen = is_seen || height > 100 * slack * (length2 + r2);
        is_flat = is_flat && (height <= 0.5 * flat * length2 && r2 <= 100 * length2);
    }
    if (!is_seen) return is_flat || lies_flat(line);
    const std::uint32_t other = layout_.edge_at(s);
    const std::size_t k = layout_.edge(other).side[0] == s ? 0 : 1;
    const auto all = parts(other);
    for (std::size_t i = 2; i < placed_.size(); ++i) {
        const Point2 r = placed_[i] - line.start;
        const double r2 = dot(r, r);
        const double height = dot(left, r);
        const double along = dot(line.along, r);
        double a = 0;
        for (const Part& part : all) {
            const double cot = part.cot[k];
            const double excess = r2 - (a + part.end) * along + a * part.end * length2 - cot * (part.end - a) * height;
            if (!(excess > slack * (1 + std::fabs(cot)) * (r2 + length2)) || (removed && part.culprit[k] == e))
                return false;
            a = part.end;
        }
    }
    work_ += all.size() * (placed_.size() - 1);
    return true;
}

/// Brings the minima of side s up to date after the points of edge e, at side `from` of the same facet, have changed.
void SplitModel::touch_side(std::uint32_t e, std::uint32_t from, std::uint32_t s, std::span<const double> points,
                            bool removed) {
    const std::uint32_t other = layout_.edge_at(s);
    const int k = layout_.edge(other).side[0] == s ? 0 : 1;
    const State& state = states_[other];
    const auto sees_it = [&](const Part& part) { return part.culprit[k] == e; };
    const auto all = parts(other);
    if (points.empty() && std::none_of(all.begin(), all.end(), sees_it)) {
        work_ += state.count;
        return;
    }
    const Eye eye = eye_at(s);
    const auto [p, d] = layout_.seen_from(eye.side, s, from);
    if (p.y <= flat && p.y + d.y <= flat) return;
    work_ += state.count * (1 + std::min(points.size(), few));
    double start = 0;
    for (std::uint32_t i = 0; i < state.count; ++i) {
        const Part& part = pool_[state.first + i];
        const double a = start;
        start = part.end;
        double cot = part.cot[k];
        std::uint32_t culprit = part.culprit[k];
        const bool lost = removed && culprit == e;
        if (!lost) {
            for (const double u : worth_a_look(points, a, part.end, p, d)) {
                const Point2 q = p + u * d;
                if (!(q.y > 0)) continue;
                const double candidate = cot_of(a, part.end, q);
                if (candidate < cot) {
                    cot = candidate;
                    culprit = e;
                }
            }
            if (!(cot < part.cot[k])) continue;
        }
        if (lost || !eye.single) {
            const Contact contact = nearest(eye, a, part.end, lost ? infinity : part.cot[k]);
            if (contact.cot == part.cot[k] && (!lost || contact.edge == part.culprit[k])) continue;
            cot = contact.cot;
            culprit = contact.edge;
        }
        save(other);
        Part& changed = pool_[state.first + i];
        changed.cot[k] = cot;
        changed.culprit[k] = culprit;
        if (is_bad(other, changed)) add_suspect(other);
    }
}

// --- what a part sees ---

SplitModel::Eye SplitModel::eye_at(std::uint32_t s) const {
    Eye eye;
    eye.id = s;
    eye.side = layout_.side(s);
    const Facet& facet = layout_.facet(eye.side.facet);
    eye.single = facet.single;
    if (!facet.single) return eye;
    const std::uint32_t i = s - facet.first_side;
    const std::uint32_t next = facet.first_side + (i == 2 ? 0 : i + 1);
    const std::uint32_t before = facet.first_side + (i == 0 ? 2 : i - 1);
    if (has_points(next)) eye.sights[eye.count++] = next;
    if (has_points(before)) eye.sights[eye.count++] = before;
    return eye;
}

Contact SplitModel::nearest(std::uint32_t s, double a, double b, double bound) const {
    return nearest(eye_at(s), a, b, bound);
}

Contact SplitModel::nearest(const Eye& eye, double a, double b, double bound) const {
    if (!eye.single) return flood(eye.id, a, b, bound);
    ++work_;
    Contact best{cot_of(a, b, eye.side.apex), eye.side.apex, none};
    for (std::size_t i = 0; i < eye.count; ++i) scan(eye.side, eye.id, eye.sights[i], a, b, best);
    return best;
}

/// Improves on `best` by the points of another side than s, which has some.
void SplitModel::scan(const Side& side, std::uint32_t s, std::uint32_t other, double a, double b, Contact& best) const {
    const std::uint32_t edge = layout_.edge_at(other);
    const auto points = parts(edge).first(point_count(edge));
    const auto [p, d] = layout_.seen_from(side, s, other);
    const auto consider = [&, p = p, d = d](double u) {
        const Point2 q = p + u * d;
        if (!(q.y > 0)) return;
        const double cot = cot_of(a, b, q);
        if (cot < best.cot) best = {cot, q, edge, u};
    };
    if (points.size() <= few) {
        work_ += points.size();
        for (const Part& part : points) consider(part.end);
        return;
    }
    // The angle rises to its maximum along the line and falls behind it.
    work_ += few;
    const double top = largest_angle_on_line(a, b, p, d);
    const auto above = std::lower_bound(points.begin(), points.end(), top,
                                        [](const Part& part, double value) { return part.end < value; });
    if (above != points.end()) consider(above->end);
    if (above != points.begin()) consider((above - 1)->end);
}

}  // namespace delmesh
