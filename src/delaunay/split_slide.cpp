#include "delaunay/split_slide.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

/// How far beyond a tie a part is brought, in terms of what it has where the points around it lie on parallel lines.
constexpr double aim = 0.1;
/// Points of an edge keep this distance, as a part of the edge.
constexpr double least_room = 1e-7;
/// A point comes no nearer to its neighbours than by this part of the distance in one step.
constexpr double most_step = 0.4;
constexpr double damping = 1e-3;
constexpr int most_inner = 60;
/// What a part asks for at most, in terms of the distances between points: what can not be had must not rule the rest.
constexpr double most_missing = 0.5;
constexpr double inner_precision = 1e-2;
/// Parts with more than this are not looked at.
constexpr double plenty = 2;

}  // namespace

void SplitSlide::make_slots() {
    if (slots_.size() >= model_.edge_count()) return;
    slots_.reserve(model_.layout().edge_capacity());  // to grow step by step costs it twice
    slots_.resize(model_.edge_count());
}

void SplitSlide::watch_suspects() {
    make_slots();
    while (model_.suspect_count() > 0) {
        const std::uint32_t e = model_.suspect(model_.suspect_count() - 1);
        model_.drop_suspect(model_.suspect_count() - 1);
        if (slots_[e].watched == run_) continue;
        slots_[e].watched = run_;
        model_.prepare(e);
        watched_.push_back(e);
    }
    make_slots();
}

void SplitSlide::add_entry(Row& row, std::uint32_t edge, std::size_t point, double slope) {
    if (!model_.is_movable(edge)) return;
    Slot& slot = slots_[edge];
    if (slot.round != round_) {
        slot.round = round_;
        slot.first = static_cast<std::uint32_t>(room_.size());
        edges_.push_back(edge);
        double before = 0;
        const auto parts = model_.parts(edge);
        for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
            room_.push_back(
                std::max(0.0, std::min(parts[i].end - before, parts[i + 1].end - parts[i].end) - least_room));
            before = parts[i].end;
        }
    }
    const auto variable = static_cast<std::uint32_t>(slot.first + point);
    row.variable[row.count] = variable;
    row.slope[row.count++] = slope * room_[variable];
}

bool SplitSlide::add_row(std::uint32_t e, std::size_t part) {
    const FacetLayout& layout = model_.layout();
    const double a = model_.part_start(e, part);
    const double b = model_.parts(e)[part].end;
    double sum = 0;
    double slope_a = 0;
    double slope_b = 0;
    double height = 0;
    Row row;
    for (const std::uint32_t s : layout.edge(e).side) {
        if (s == SplitModel::none) continue;
        const Contact seen = model_.nearest(s, a, b);
        const double d = seen.at.y * (b - a);
        sum += seen.cot;
        height += seen.at.y;
        slope_a += (b - seen.at.x) / d + seen.cot / (b - a);
        slope_b += (a - seen.at.x) / d - seen.cot / (b - a);
        if (seen.edge == SplitModel::none) continue;
        model_.prepare(seen.edge);
        make_slots();
        const std::size_t k = layout.side_within(seen.edge, layout.facet_at(s));
        const Point2 along = layout.side(s).turn(layout.side(layout.edge(seen.edge).side[k]).along);
        const double by_x = (2 * seen.at.x - a - b) / d;
        const double by_y = (2 - seen.cot * (b - a) / seen.at.y) / (b - a);
        add_entry(row, seen.edge, model_.part_at(seen.edge, seen.along), by_x * along.x + by_y * along.y);
    }
    const double goal = aim * height / (b - a);
    if (sum >= goal) return true;
    if (part > 0) add_entry(row, e, part - 1, slope_a);
    if (part + 1 < model_.parts(e).size()) add_entry(row, e, part, slope_b);
    double squares = 0;
    for (std::uint32_t i = 0; i < row.count; ++i) squares += row.slope[i] * row.slope[i];
    if (!(squares > 0) || !std::isfinite(squares)) return sum >= 0;
    const double scale = 1 / std::sqrt(squares);
    for (std::uint32_t i = 0; i < row.count; ++i) row.slope[i] *= scale;
    row.missing = std::min((goal - sum) * scale, most_missing);
    rows_.push_back(row);
    return true;
}

/// False if some part can not be helped by moving points.
bool SplitSlide::linearise(std::size_t most_points) {
    ++round_;
    edges_.clear();
    room_.clear();
    rows_.clear();
    for (const std::uint32_t e : watched_) {
        for (std::size_t i = 0; i < model_.parts(e).size(); ++i) {
            const Part& part = model_.parts(e)[i];
            if (part.cot[0] + part.cot[1] > plenty) continue;
            if (!add_row(e, i) || room_.size() > most_points) return false;
        }
    }
    model_.count_work(4 * rows_.size());
    return true;
}

/// Minimises |J change - missing|^2 + damping |change|^2 by conjugate gradients.
void SplitSlide::solve() {
    const std::size_t n = room_.size();
    change_.assign(n, 0);
    residual_.resize(rows_.size());
    image_.resize(rows_.size());
    gradient_.assign(n, 0);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        residual_[r] = rows_[r].missing;
        for (std::uint32_t i = 0; i < rows_[r].count; ++i)
            gradient_[rows_[r].variable[i]] += rows_[r].slope[i] * residual_[r];
    }
    direction_ = gradient_;
    double norm2 = 0;
    for (const double g : gradient_) norm2 += g * g;
    // Where the wishes of the parts balance, the gradient is rounding and no direction.
    const double enough = std::max(inner_precision * inner_precision * norm2, 1e-16);
    for (int k = 0; k < most_inner && norm2 > enough; ++k) {
        model_.count_work(rows_.size() / 2 + n / 4);
        double curvature = 0;
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            double value = 0;
            for (std::uint32_t i = 0; i < rows_[r].count; ++i)
                value += rows_[r].slope[i] * direction_[rows_[r].variable[i]];
            image_[r] = value;
            curvature += value * value;
        }
        for (std::size_t v = 0; v < n; ++v) curvature += damping * direction_[v] * direction_[v];
        const double step = norm2 / curvature;
        for (std::size_t v = 0; v < n; ++v) {
            change_[v] += step * direction_[v];
            gradient_[v] = -damping * change_[v];
        }
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            residual_[r] -= step * image_[r];
            for (std::uint32_t i = 0; i < rows_[r].count; ++i)
                gradient_[rows_[r].variable[i]] += rows_[r].slope[i] * residual_[r];
        }
        const double before = norm2;
        norm2 = 0;
        for (const double g : gradient_) norm2 += g * g;
        const double keep = norm2 / before;
        for (std::size_t v = 0; v < n; ++v) direction_[v] = gradient_[v] + keep * direction_[v];
    }
}

/// False if nothing has moved.
bool SplitSlide::move() {
    bool changed = false;
    for (const std::uint32_t e : edges_) {
        const std::uint32_t first = slots_[e].first;
        const std::size_t n = model_.point_count(e);
        std::size_t from = n;
        std::size_t to = 0;
        places_.clear();
        for (std::size_t i = 0; i < n; ++i) {
            const double at = model_.parts(e)[i].end;
            const double by = std::clamp(change_[first + i], -most_step, most_step) * room_[first + i];
            places_.push_back(at + by);
            if (at + by == at) continue;
            from = std::min(from, i);
            to = i + 1;
        }
        if (from >= to) continue;
        model_.cut(e, from, to, std::span<const double>(places_).subspan(from, to - from));
        changed = true;
    }
    return changed;
}

bool SplitSlide::run(std::size_t steps, std::size_t most_points) {
    ++run_;
    watched_.clear();
    for (std::size_t step = 0; step < steps; ++step) {
        watch_suspects();
        if (!linearise(most_points)) break;
        solve();
        if (!move()) break;
        for (const std::uint32_t e : watched_)
            if (model_.first_bad(e) >= 0) model_.add_suspect(e);
        if (model_.suspect_count() == 0) return true;
    }
    for (const std::uint32_t e : watched_)
        if (model_.first_bad(e) >= 0) model_.add_suspect(e);
    return model_.suspect_count() == 0;
}

}  // namespace delmesh
