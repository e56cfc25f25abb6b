#include "delaunay/split_regions.hpp"

#include <algorithm>
#include <numeric>

namespace delmesh {
namespace {

class Regions {
public:
    Regions(const SplitModel& model, std::span<const PlacedPoint> ours, std::span<const PlacedPoint> theirs)
        : layout_(model.layout()),
          parent_(layout_.facet_count()),
          touched_(layout_.facet_count(), false) {
        std::iota(parent_.begin(), parent_.end(), 0u);
        for (std::uint32_t e = 0; e < model.edge_count(); ++e)
            if (model.point_count(e) > 0) touch(e);
        for (const PlacedPoint& point : ours) touch(point.edge);
        for (const PlacedPoint& point : theirs) touch(point.edge);
        for (std::uint32_t e = 0; e < layout_.edge_count(); ++e) join_sides(e);
    }

    /// The region of an edge with points. One of an open edge without points may be a facet of its own.
    [[nodiscard]] std::uint32_t of(std::uint32_t e) {
        const auto& sides = layout_.edge(e).side;
        const std::uint32_t s = sides[0] != SplitModel::none ? sides[0] : sides[1];
        return root(layout_.facet_at(s));
    }

private:
    void touch(std::uint32_t e) {
        for (const std::uint32_t s : layout_.edge(e).side)
            if (s != SplitModel::none) touched_[layout_.facet_at(s)] = true;
    }

    /// Facets that share an edge depend on each other through it, whether it is split or not.
    void join_sides(std::uint32_t e) {
        const auto& sides = layout_.edge(e).side;
        if (sides[0] == SplitModel::none || sides[1] == SplitModel::none) return;
        const std::uint32_t a = layout_.facet_at(sides[0]);
        const std::uint32_t b = layout_.facet_at(sides[1]);
        if (touched_[a] && touched_[b]) parent_[root(a)] = root(b);
    }

    [[nodiscard]] std::uint32_t root(std::uint32_t f) {
        while (parent_[f] != f) f = parent_[f] = parent_[parent_[f]];
        return f;
    }

    const FacetLayout& layout_;
    std::vector<std::uint32_t> parent_;
    std::vector<bool> touched_;
};

struct Balance {
    static constexpr std::uint32_t open = ~std::uint32_t{0};
    std::uint32_t ours = 0;  ///< or `open`
    std::uint32_t theirs = 0;

    [[nodiscard]] bool is_worse() const { return ours > theirs; }
};

/// Those of edges that are wanted, which is asked by number.
template <class IsWanted>
void add_wanted(SplitModel& model, std::span<const PlacedPoint> points, IsWanted&& is_wanted) {
    std::vector<double> places;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_wanted(i)) continue;
        places.push_back(points[i].at);
        if (i + 1 < points.size() && points[i + 1].edge == points[i].edge) continue;
        model.prepare(points[i].edge);
        model.cut(points[i].edge, 0, 0, places);
        places.clear();
    }
}

}  // namespace

void add_points(SplitModel& model, std::span<const PlacedPoint> points) {
    add_wanted(model, points, [](std::size_t) { return true; });
}

std::vector<PlacedPoint> placed_points(const SplitModel& model) {
    std::vector<PlacedPoint> points;
    points.reserve(model.point_count());
    for (std::uint32_t e = 0; e < model.edge_count(); ++e)
        for (std::uint32_t i = 0; i < model.point_count(e); ++i) points.push_back({e, model.parts(e)[i].end});
    return points;
}

std::size_t take_better_regions(SplitModel& model, std::span<const std::uint32_t> open,
                                std::span<const PlacedPoint> ours, std::span<const PlacedPoint> theirs) {
    Regions regions(model, ours, theirs);
    std::vector<Balance> balance(model.layout().facet_count());
    for (const PlacedPoint& point : ours) ++balance[regions.of(point.edge)].ours;
    for (const PlacedPoint& point : theirs) ++balance[regions.of(point.edge)].theirs;
    for (const std::uint32_t e : open) balance[regions.of(e)].ours = Balance::open;
    const auto worse = [&](std::uint32_t e) { return balance[regions.of(e)].is_worse(); };

    std::vector<std::uint32_t> to_clear;
    for (std::uint32_t e = 0; e < model.edge_count(); ++e)
        if (model.point_count(e) > 0 && worse(e)) to_clear.push_back(e);
    std::vector<bool> take(theirs.size());
    for (std::size_t i = 0; i < theirs.size(); ++i) take[i] = worse(theirs[i].edge);
    for (const std::uint32_t e : to_clear) {
        model.prepare(e);
        model.cut(e, 0, model.point_count(e), {});
    }
    add_wanted(model, theirs, [&](std::size_t i) { return take[i]; });
    return static_cast<std::size_t>(
        std::count_if(balance.begin(), balance.end(), [](const Balance& b) { return b.is_worse(); }));
}

}  // namespace delmesh
