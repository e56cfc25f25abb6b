#include "delaunay/split_regions.hpp"

#include <numeric>

namespace delmesh {
namespace {

class Regions {
public:
    Regions(const SplitModel& model, std::span<const PlacedPoint> other)
        : layout_(model.layout()),
          parent_(layout_.facet_count()),
          touched_(layout_.facet_count(), false) {
        std::iota(parent_.begin(), parent_.end(), 0u);
        for (std::uint32_t e = 0; e < model.edge_count(); ++e)
            if (model.point_count(e) > 0) touch(e);
        for (const PlacedPoint& point : other) touch(point.edge);
        for (std::uint32_t e = 0; e < layout_.edge_count(); ++e) join_sides(e);
    }

    /// The region of an edge with points. One of an open edge without points may be a facet of its own.
    [[nodiscard]] std::uint32_t of(std::uint32_t e) {
        const auto& sides = layout_.edge(e).side;
        const std::uint32_t s = sides[0] != SplitModel::none ? sides[0] : sides[1];
        return root(layout_.side(s).facet);
    }

private:
    void touch(std::uint32_t e) {
        for (const std::uint32_t s : layout_.edge(e).side)
            if (s != SplitModel::none) touched_[layout_.side(s).facet] = true;
    }

    /// Facets that share an edge depend on each other through it, whether it is split or not.
    void join_sides(std::uint32_t e) {
        const auto& sides = layout_.edge(e).side;
        if (sides[0] == SplitModel::none || sides[1] == SplitModel::none) return;
        const std::uint32_t a = layout_.side(sides[0]).facet;
        const std::uint32_t b = layout_.side(sides[1]).facet;
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
    std::size_t ours = 0;
    std::size_t theirs = 0;
    bool is_open = false;

    [[nodiscard]] bool is_worse() const { return is_open || ours > theirs; }
};

}  // namespace

std::size_t take_better_regions(SplitModel& model, std::span<const std::uint32_t> open,
                                std::span<const PlacedPoint> other) {
    Regions regions(model, other);
    std::vector<Balance> balance(model.layout().facet_count());
    for (std::uint32_t e = 0; e < model.edge_count(); ++e)
        if (model.point_count(e) > 0) balance[regions.of(e)].ours += model.point_count(e);
    for (const PlacedPoint& point : other) ++balance[regions.of(point.edge)].theirs;
    for (const std::uint32_t e : open) balance[regions.of(e)].is_open = true;

    std::vector<std::uint32_t> to_clear;
    for (std::uint32_t e = 0; e < model.edge_count(); ++e)
        if (model.point_count(e) > 0 && balance[regions.of(e)].is_worse()) to_clear.push_back(e);
    std::vector<bool> take(other.size());
    for (std::size_t i = 0; i < other.size(); ++i) take[i] = balance[regions.of(other[i].edge)].is_worse();
    for (const std::uint32_t e : to_clear) {
        model.prepare(e);
        model.cut(e, 0, model.point_count(e), {});
    }
    std::vector<double> points;
    for (std::size_t i = 0; i < other.size(); ++i) {
        if (!take[i]) continue;
        points.push_back(other[i].at);
        if (i + 1 < other.size() && other[i + 1].edge == other[i].edge) continue;
        model.prepare(other[i].edge);
        model.cut(other[i].edge, 0, 0, points);
        points.clear();
    }
    std::size_t changed = 0;
    for (const Balance& b : balance)
        if (b.is_worse()) ++changed;
    return changed;
}

}  // namespace delmesh
