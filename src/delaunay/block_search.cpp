#include "delaunay/block_search.hpp"

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "delaunay/facet_blocks.hpp"
#include "delaunay/split_regions.hpp"
#include "delaunay/split_search.hpp"

#include <algorithm>
#include <vector>

namespace delmesh {
namespace {

/// The points that a block may move, before and after.
struct BlockResult {
    std::vector<std::uint32_t> edges;  ///< of the whole model, that had points
    std::vector<PlacedPoint> points;
    std::uint64_t work = 0;
};

class BlockTask {
public:
    BlockTask(const SplitModel& whole, const FacetBlocks& blocks, std::uint32_t block)
        : whole_(whole),
          blocks_(blocks),
          block_(block),
          model_(whole.layout().marked(), whole.layout()) {}

    BlockResult run(const BlockSearchOptions& options, std::uint64_t seed, const Context* context) {
        copy_edges();
        BlockResult result;
        if (free_points_ == 0) return result;
        SplitSearch search(model_, seed);
        search.set_open(find_open());
        search.be_quiet();
        search.be_patient(options.patience);
        const auto work = static_cast<std::uint64_t>(options.work * static_cast<double>(free_points_));
        if (options.polishes) {
            search.spread(work);
            search.polish(work, context);
            search.spread(work);
        } else {
            search.improve(work, context);
        }
        result.work = model_.work();
        for (const Edge& edge : edges_) {
            if (!edge.is_free) continue;
            if (whole_.point_count(edge.whole) > 0) result.edges.push_back(edge.whole);
            for (std::uint32_t i = 0; i < model_.point_count(edge.own); ++i)
                result.points.push_back({edge.whole, model_.parts(edge.own)[i].end});
        }
        return result;
    }

private:
    struct Edge {
        std::uint32_t whole = 0;
        std::uint32_t own = 0;
        bool is_free = false;  ///< both of its facets are inner ones
    };

    /// What is judged in this block and what may move: edges of which all that sees them is known here.
    void copy_edges() {
        const FacetLayout& layout = whole_.layout();
        for (const std::uint32_t f : blocks_.facets[block_]) {
            const Facet& facet = layout.facet(f);
            for (std::uint32_t s = facet.first_side; s < facet.first_side + facet.side_count; ++s) {
                const std::uint32_t e = layout.edge_at(s);
                const auto& sides = layout.edge(e).side;
                // Edges within the block turn up twice.
                if (sides[1] == s && sides[0] != SplitModel::none && block_at(sides[0]) == block_) continue;
                edges_.push_back({e, model_.edge_of(layout.edge(e).halfedge), is_inner(sides)});
            }
        }
        std::vector<double> points;
        for (const Edge& edge : edges_) {
            model_.prepare(edge.own);
            points.clear();
            for (std::uint32_t i = 0; i < whole_.point_count(edge.whole); ++i)
                points.push_back(whole_.parts(edge.whole)[i].end);
            if (!points.empty()) model_.cut(edge.own, 0, 0, points);
            if (edge.is_free) free_points_ += points.size();
        }
        std::vector<bool> is_free(model_.edge_count(), false);
        for (const Edge& edge : edges_) is_free[edge.own] = edge.is_free;
        for (std::uint32_t e = 0; e < model_.edge_count(); ++e)
            if (!is_free[e]) model_.set_movable(e, false);
        // What lies outside lacks points here.
        while (model_.suspect_count() > 0) model_.drop_suspect(0);
    }

    /// Those that may move. Others must not be suspected either.
    [[nodiscard]] std::vector<std::uint32_t> find_open() {
        std::vector<std::uint32_t> open;
        for (const Edge& edge : edges_) {
            if (!whole_.is_given_up(edge.whole)) continue;
            model_.give_up(edge.own, true);
            if (edge.is_free) open.push_back(edge.own);
        }
        return open;
    }

    [[nodiscard]] std::uint32_t block_at(std::uint32_t side) const {
        return blocks_.block_of[whole_.layout().facet_at(side)];
    }
    [[nodiscard]] bool is_inner(const std::array<std::uint32_t, 2>& sides) const {
        return std::all_of(sides.begin(), sides.end(), [&](std::uint32_t s) {
            return s == SplitModel::none || blocks_.is_inner[whole_.layout().facet_at(s)];
        });
    }

    const SplitModel& whole_;
    const FacetBlocks& blocks_;
    std::uint32_t block_;
    SplitModel model_;
    std::vector<Edge> edges_;
    std::size_t free_points_ = 0;
};

void put_back(SplitModel& model, const BlockResult& result) {
    for (const std::uint32_t e : result.edges) {
        model.prepare(e);
        model.cut(e, 0, model.point_count(e), {});
    }
    add_points(model, result.points);
}

/// Lays out the facets around those with points, so that the search may go there.
void widen(SplitModel& model) {
    const FacetLayout& layout = model.layout();
    const auto visit_around = [&](std::uint32_t e, auto&& visit) {
        const std::array<std::uint32_t, 2> sides = layout.edge(e).side;  // copies, as the layout grows
        for (const std::uint32_t side : sides) {
            if (side == SplitModel::none) continue;
            const Facet facet = layout.facet(layout.facet_at(side));
            for (std::uint32_t i = 0; i < facet.side_count; ++i) visit(layout.edge_at(facet.first_side + i));
        }
    };
    const auto known = static_cast<std::uint32_t>(model.edge_count());
    std::size_t unknown = 0;
    for (std::uint32_t e = 0; e < known; ++e)
        if (model.point_count(e) > 0)
            visit_around(e, [&](std::uint32_t near) { unknown += model.is_prepared(near) ? 0 : 1; });
    if (unknown > known / 8) model.expect(unknown);  // it moves all to another place
    for (std::uint32_t e = 0; e < known; ++e)
        if (model.point_count(e) > 0) visit_around(e, [&](std::uint32_t near) { model.prepare(near); });
}

/// True if they do: no two blocks change what the same edge sees.
bool fits(SplitModel& model) {
    while (model.suspect_count() > 0) {
        if (model.first_bad(model.suspect(0)) >= 0) return false;
        model.drop_suspect(0);
    }
    return true;
}

}  // namespace

std::uint64_t improve_in_blocks(SplitModel& model, int round, const BlockSearchOptions& options,
                                const Context* context) {
    widen(model);
    const FacetBlocks blocks = cut_into_blocks(model, options.block_points, round);
    std::vector<BlockResult> results(blocks.facets.size());
    const auto search = [&](std::size_t i, std::size_t) {
        const std::uint64_t seed = Random(options.seed + 1000003 * i + static_cast<std::uint64_t>(round)).next();
        results[i] = BlockTask(model, blocks, static_cast<std::uint32_t>(i)).run(options, seed, context);
    };
    parallel_blocks(results.size(), context, search, 1);
    std::uint64_t work = 0;
    for (const BlockResult& result : results) work += result.work;
    if (is_cancelled(context)) return work;
    for (const BlockResult& result : results) {
        model.begin();
        put_back(model, result);
        fits(model) ? model.commit() : model.rollback();
    }
    return work;
}

}  // namespace delmesh
