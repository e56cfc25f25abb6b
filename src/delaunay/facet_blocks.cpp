#include "delaunay/facet_blocks.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace delmesh {
namespace {

/// Where to cut, as a part of the points: no two rounds share many borders.
constexpr std::array<double, 3> cuts{0.5, 0.39, 0.61};
/// And the axis whose extent counts double.
constexpr double preference = 2;

struct Item {
    std::uint32_t facet = 0;
    std::uint32_t points = 0;
    VertexId at;
};

class Cutter {
public:
    Cutter(const SplitModel& model, std::size_t most_points, int round)
        : layout_(model.layout()),
          most_points_(most_points),
          round_(round) {
        const Mesh& mesh = layout_.marked().mesh();
        items_.reserve(layout_.facet_count());
        for (std::uint32_t f = 0; f < layout_.facet_count(); ++f) {
            const Facet& facet = layout_.facet(f);
            Item item;
            item.facet = f;
            for (std::uint32_t s = facet.first_side; s < facet.first_side + facet.side_count; ++s)
                item.points += model.point_count(layout_.edge_at(s));
            if (facet.side_count > 0) item.at = mesh.origin(layout_.edge(layout_.edge_at(facet.first_side)).halfedge);
            items_.push_back(item);
        }
        result_.block_of.assign(items_.size(), FacetBlocks::none);
    }

    FacetBlocks run() {
        cut(items_, 0);
        for (auto& facets : result_.facets) std::sort(facets.begin(), facets.end());
        find_inner();
        return std::move(result_);
    }

private:
    /// Each point is counted by both facets at its edge.
    static std::size_t weight(std::span<const Item> items) {
        std::size_t sum = 0;
        for (const Item& item : items) sum += item.points;
        return sum / 2;
    }

    [[nodiscard]] double coordinate(const Item& item, int axis) const {
        return item.at.valid() ? layout_.marked().mesh().point(item.at)[axis] : 0;
    }

    int longest_axis(std::span<const Item> items, int depth) const {
        int longest = 0;
        double extent = -1;
        for (int axis = 0; axis < 3; ++axis) {
            const auto [low, high] = std::minmax_element(
                items.begin(), items.end(),
                [this, axis](const Item& a, const Item& b) { return coordinate(a, axis) < coordinate(b, axis); });
            const double size = (0.5 * coordinate(*high, axis) - 0.5 * coordinate(*low, axis)) *
                                (axis == (depth + round_) % 3 && round_ > 0 ? preference : 1);
            if (size <= extent) continue;
            extent = size;
            longest = axis;
        }
        return longest;
    }

    void cut(std::span<Item> items, int depth) {
        const std::size_t all = weight(items);
        if (all <= most_points_ || items.size() < 2) {
            const auto block = static_cast<std::uint32_t>(result_.facets.size());
            result_.facets.emplace_back();
            for (const Item& item : items) {
                result_.facets.back().push_back(item.facet);
                result_.block_of[item.facet] = block;
            }
            return;
        }
        const int axis = longest_axis(items, depth);
        std::sort(items.begin(), items.end(), [this, axis](const Item& a, const Item& b) {
            const double at_a = coordinate(a, axis);
            const double at_b = coordinate(b, axis);
            return at_a != at_b ? at_a < at_b : a.facet < b.facet;
        });
        const double share = cuts[static_cast<std::size_t>(round_) % cuts.size()];
        std::size_t below = 0;
        std::size_t points = 0;
        while (below + 1 < items.size() && static_cast<double>(points) < share * 2 * static_cast<double>(all))
            points += items[below++].points;
        cut(items.first(below), depth + 1);
        cut(items.subspan(below), depth + 1);
    }

    void find_inner() {
        result_.is_inner.assign(items_.size(), true);
        for (std::uint32_t f = 0; f < layout_.facet_count(); ++f) {
            const Facet& facet = layout_.facet(f);
            for (std::uint32_t s = facet.first_side; s < facet.first_side + facet.side_count; ++s) {
                const FacetLayout::Edge& edge = layout_.edge(layout_.edge_at(s));
                const std::uint32_t other = edge.side[edge.side[0] == s ? 1 : 0];
                const bool open = layout_.marked().mesh().is_boundary(edge.halfedge);
                if (open ||
                    (other != FacetBlocks::none && result_.block_of[layout_.facet_at(other)] == result_.block_of[f]))
                    continue;
                result_.is_inner[f] = false;
            }
        }
    }

    const FacetLayout& layout_;
    std::size_t most_points_;
    int round_;
    std::vector<Item> items_;
    FacetBlocks result_;
};

}  // namespace

FacetBlocks cut_into_blocks(const SplitModel& model, std::size_t most_points, int round) {
    return Cutter(model, most_points, round).run();
}

}  // namespace delmesh
