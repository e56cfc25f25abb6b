#include "delaunay/split_ring.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {
namespace {

/// Sides that are shorter than this part of the longest one belong to a border; rungs are longer than the other.
constexpr double longest_border = 0.35;
constexpr double shortest_rung = 0.6;
constexpr std::uint32_t most_sides = 64;

/// The logarithm to base 2, linear between powers of two: the same bits everywhere, unlike the true one.
double rough_log2(double x) {
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent);
    return exponent - 2 + 2 * mantissa;
}

/// Its inverse.
double rough_exp2(double x) {
    const double whole = std::floor(x);
    return std::ldexp(1 + (x - whole), static_cast<int>(whole));
}

}  // namespace

/// The other rung of a facet that has exactly two, of which `side` is one; or none.
std::uint32_t SplitRing::across(const Facet& facet, std::uint32_t side) const {
    if (facet.side_count > most_sides) return SplitModel::none;
    const FacetLayout& layout = model_.layout();
    const auto length2 = [&](std::uint32_t s) { return dot(layout.side(s).along, layout.side(s).along); };
    double longest2 = 0;
    for (std::uint32_t s = facet.first_side; s < facet.first_side + facet.side_count; ++s)
        longest2 = std::max(longest2, length2(s));
    std::uint32_t other = SplitModel::none;
    for (std::uint32_t s = facet.first_side; s < facet.first_side + facet.side_count; ++s) {
        if (length2(s) < longest_border * longest_border * longest2) {
            if (s == side) return SplitModel::none;
            continue;
        }
        if (length2(s) < shortest_rung * shortest_rung * longest2) return SplitModel::none;
        if (s == side) continue;
        if (other != SplitModel::none) return SplitModel::none;
        other = s;
    }
    return other;
}

/// Goes on to the next rung. False at the end of a strip that is no ring.
bool SplitRing::advance(Step& step) const {
    const FacetLayout& layout = model_.layout();
    const std::uint32_t s = layout.edge(step.rung.edge).side[step.side];
    if (s == SplitModel::none) return false;
    const Side from = layout.side(s);
    const std::uint32_t next = across(layout.facet(from.facet), s);
    if (next == SplitModel::none) return false;
    const Side to = layout.side(next);
    if (!model_.is_movable(to.edge)) return false;
    step.width = std::fabs(from.to_frame(to.at(0.5)).y);
    step.rung.reversed = step.rung.reversed != (dot(from.along, to.along) < 0);
    step.rung.edge = to.edge;
    step.side = layout.edge(to.edge).side[0] == next ? 1 : 0;
    return true;
}

bool SplitRing::gather(std::uint32_t e, std::size_t most) {
    rungs_.clear();
    double widths = 0;
    Step step{{e, false}, 1};
    do {
        if (rungs_.size() == most) return false;
        rungs_.push_back(step.rung);
        model_.prepare(step.rung.edge);
        if (!advance(step)) return false;
        widths += step.width;
    } while (step.rung.edge != e);
    width_ = std::clamp(widths / static_cast<double>(rungs_.size()), 1e-9, 0.25);
    return rungs_.size() > 2 && step.side == 1 && !step.rung.reversed;
}

std::size_t SplitRing::point_count() const {
    std::size_t count = 0;
    for (const Rung& rung : rungs_) count += model_.point_count(rung.edge);
    return count;
}

void SplitRing::lay_threads(std::size_t count) {
    places_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t from_border = std::min(i, count - 1 - i);
        const double share = (2 * static_cast<double>(from_border) + 1) / static_cast<double>(count);
        const double distance = 0.5 * rough_exp2((1 - share) * rough_log2(2 * width_));
        places_[i] = i == from_border ? distance : 1 - distance;
    }
    reversed_places_.assign(places_.rbegin(), places_.rend());
    for (double& place : reversed_places_) place = 1 - place;
    for (const Rung& rung : rungs_)
        model_.cut(rung.edge, 0, model_.point_count(rung.edge), rung.reversed ? reversed_places_ : places_);
}

std::size_t SplitRing::plan(bool is_quick) {
    return threads_.plan(rungs_, is_quick) ? threads_.count() : 0;
}

void SplitRing::lay_planned_threads() {
    for (std::size_t i = 0; i < rungs_.size(); ++i) {
        threads_.places(i, places_);
        model_.cut(rungs_[i].edge, 0, model_.point_count(rungs_[i].edge), places_);
    }
}

}  // namespace delmesh
