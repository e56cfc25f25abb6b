#pragma once
// Cores of several edges, and cores that need several points more than their edges alone: by refuting all ways to place
// fewer.

#include "delaunay/core_packing.hpp"
#include "delaunay/edge_need.hpp"
#include "delaunay/edge_scene.hpp"
#include "delmesh/base/context.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace delmesh {

/// A solution that may have points too many.
struct GapTask {
    std::vector<std::uint32_t> count;  ///< of its points, by edge id
    /// Tries to put these points in place of all those of the edges; true if fewer do then, and `count` tells how many.
    /// Else `broken` tells which edges they make bad.
    std::function<bool(std::span<const std::uint32_t> edges, std::span<const VaguePoint> places)> replace;
    std::vector<std::uint32_t> broken;
    std::size_t work = 0;  ///< in all, in corners and lines that are looked at
};

class ClusterCores {
public:
    /// `packing`: has been run; `is_open`: by edge id, the edges that must be split.
    ClusterCores(BoundView& view, const CorePacking& packing, const std::vector<bool>& is_open);

    /// So many points more than the edges and the cores of the packing need. Greedy: clusters of two, three, ... edges
    /// first; then cores are shown to need more, alone or together with another edge.
    [[nodiscard]] std::size_t run(const Context* context);

    /// Once that has been run: where a solution has more points than are known to be needed, takes up to five cores
    /// and edges together, and more care. Either they are shown to need more, or places for fewer points turn up.
    /// Returns by how much more the bound is then.
    std::size_t close_gaps(GapTask& task, const Context* context);
    /// So much work that has done.
    [[nodiscard]] std::size_t gap_work() const { return gap_work_; }

private:
    static constexpr std::uint32_t none = IdMap::none;

    struct Core {
        std::vector<std::uint32_t> split;  ///< must be split
        std::size_t gain = 1;              ///< so many points more than each of these needs alone
        std::vector<std::uint32_t> edges;  ///< all of it
        std::uint32_t into = none;         ///< the larger core that it is a part of by now
    };
    /// Cores, and edges that must be split and belong to none.
    struct Union {
        std::vector<std::uint32_t> cores;
        std::vector<std::uint32_t> edges;

        [[nodiscard]] std::size_t size() const { return cores.size() + edges.size(); }
        void add(const Union& other);
    };
    enum class Outcome { nothing, more_needed, fewer_found };
    using Box = std::vector<VaguePoint>;

    void join(std::uint32_t edge, std::uint32_t core);
    [[nodiscard]] std::uint32_t owner(std::uint32_t edge) const;
    [[nodiscard]] const EdgeScene& scene(std::uint32_t edge);
    void start_trying();
    [[nodiscard]] bool is_candidate(std::uint32_t edge) const;
    [[nodiscard]] bool has_several_points(const Core& core) const;
    [[nodiscard]] std::vector<std::uint32_t> candidates_around(std::uint32_t core);
    template <class May>
    [[nodiscard]] std::size_t improve(const Context* context, May&& may, bool (ClusterCores::*step)(std::uint32_t));
    [[nodiscard]] bool raise(std::uint32_t core);
    [[nodiscard]] bool join_edge(std::uint32_t core);
    [[nodiscard]] bool grow_cluster(std::size_t size);
    [[nodiscard]] bool prove(const std::vector<std::uint32_t>& split, std::uint32_t core, std::size_t more);
    [[nodiscard]] bool refute_all(std::size_t more);
    [[nodiscard]] bool refute();
    [[nodiscard]] bool is_refuted(const Box& box);
    [[nodiscard]] bool halve(Box& box);
    [[nodiscard]] Box all_places() const;
    void gather_watchers();
    [[nodiscard]] bool is_in_proof(std::uint32_t edge) const;

    // core_unions.cpp
    [[nodiscard]] std::size_t need(std::uint32_t edge) const { return needs_[need_of_.find(edge)].points; }
    [[nodiscard]] std::vector<Union> find_gaps();
    [[nodiscard]] std::vector<std::uint32_t> edges_of(const Union& cores) const;
    [[nodiscard]] std::vector<Union> find_around(const Union& cores, const std::vector<std::uint32_t>& edges);
    [[nodiscard]] Outcome try_unions(const Union& from, std::size_t size);
    [[nodiscard]] Outcome try_union(const Union& cores);
    void merge(const Union& cores, const std::vector<std::uint32_t>& split, std::size_t gain);
    void try_places(const Box& box);
    [[nodiscard]] Box climb(const Box& box);
    [[nodiscard]] double margin(const Box& box);

    BoundView& view_;
    const std::vector<EdgeNeed>& needs_;
    const std::vector<bool>& is_open_;
    IdMap need_of_;
    IdMap scene_of_;
    std::vector<std::unique_ptr<EdgeScene>> scenes_;
    std::vector<Core> cores_;
    IdMap core_of_;  ///< by edge
    std::vector<std::uint32_t> cluster_;

    std::size_t work_ = 0;
    std::vector<std::uint32_t> own_;       ///< the cores that a proof is for, as far as they are there already
    std::vector<std::uint32_t> points_;    ///< the edges with points, once for each
    std::vector<std::uint32_t> in_proof_;  ///< all edges that the proof is about
    std::vector<std::uint32_t> watchers_;
    std::vector<bool> is_used_;  ///< by watcher: this refutation needs it

    GapTask* gap_ = nullptr;  ///< while gaps are closed
    bool is_fewer_ = false;   ///< places for fewer points have been found
    std::size_t gap_work_ = 0;
    std::vector<std::uint32_t> broken_;  ///< by the places that have been tried
    /// By all edges of a union: what may be added to it.
    std::map<std::vector<std::uint32_t>, std::vector<Union>> tried_;
};

}  // namespace delmesh
