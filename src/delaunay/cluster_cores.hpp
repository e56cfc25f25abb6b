#pragma once
// Cores of several edges, and cores that need several points more than their edges alone: by refuting all ways to place
// fewer.

#include "delaunay/core_packing.hpp"
#include "delaunay/edge_need.hpp"
#include "delaunay/edge_scene.hpp"
#include "delmesh/base/context.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace delmesh {

class ClusterCores {
public:
    /// `packing`: has been run; `is_open`: by edge id, the edges that must be split.
    ClusterCores(BoundView& view, const CorePacking& packing, const std::vector<bool>& is_open);

    /// So many points more than the edges and the cores of the packing need. Greedy: clusters of two, three, ... edges
    /// first; then cores are shown to need more, alone or together with another edge.
    [[nodiscard]] std::size_t run(const Context* context);

private:
    static constexpr std::uint32_t none = IdMap::none;

    struct Core {
        std::vector<std::uint32_t> split;  ///< must be split, one point each
        std::size_t gain = 1;
    };
    using Box = std::vector<VaguePoint>;

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
    [[nodiscard]] Box all_places() const;
    void gather_watchers();
    [[nodiscard]] bool is_in_proof(std::uint32_t edge) const;

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
    std::uint32_t core_ = none;            ///< the one that a proof is for, if it is there already
    std::vector<std::uint32_t> points_;    ///< the edges with points, once for each
    std::vector<std::uint32_t> in_proof_;  ///< all edges that the proof is about
    std::vector<std::uint32_t> watchers_;
    std::vector<bool> is_used_;  ///< by watcher: this refutation needs it
};

}  // namespace delmesh
