#pragma once
// Packs disjoint cores: an edge that must be split, and edges of which one becomes bad wherever it is split.

#include "delaunay/edge_need.hpp"
#include "delaunay/id_map.hpp"

#include <cstdint>
#include <vector>

namespace delmesh {

/// A core is an edge with a stretch for one of its points, and edges that block all of it. As no edge belongs to two
/// cores, each core needs a point more than its edge alone.
class CorePacking {
public:
    explicit CorePacking(std::vector<EdgeNeed> needs);

    /// The number of cores found. Small cores first; then edges are exchanged along short chains.
    [[nodiscard]] std::size_t run();

    [[nodiscard]] const std::vector<EdgeNeed>& needs() const { return needs_; }
    /// Calls take(edge that must be split, edges that block it) for each core.
    template <class Take>
    void for_each_core(Take&& take) const {
        std::vector<std::uint32_t> blockers;
        for (std::size_t core = 0; core < needs_.size(); ++core) {
            if (members_[core].empty()) continue;
            blockers.clear();
            for (const std::uint32_t i : members_[core]) blockers.push_back(blocking_edges_[i]);
            take(needs_[core].edge, blockers);
        }
    }

private:
    static constexpr std::uint32_t none = IdMap::none;

    struct Change {
        std::uint32_t core = 0;
        std::vector<std::uint32_t> before;
    };
    enum class Blocked { by_free, by_any };

    [[nodiscard]] bool cover(std::uint32_t core, const Stretch& stretch, Blocked blocked, std::size_t limit);
    [[nodiscard]] bool take_free(std::uint32_t core, std::size_t limit);
    [[nodiscard]] bool augment(std::uint32_t core, int depth);
    [[nodiscard]] bool take_from_others(std::uint32_t core, int depth);
    void assign(std::uint32_t core, const std::vector<std::uint32_t>& edges);
    void undo(std::size_t changes);

    std::vector<EdgeNeed> needs_;
    std::vector<std::vector<std::uint32_t>> members_;  ///< the blockers that each core uses, by their index below
    std::vector<std::uint32_t> blocking_edges_;
    std::vector<std::uint32_t> owner_;  ///< by blocking edge: the core
    std::vector<bool> locked_;          ///< by core: not to be taken from
    std::vector<Change> changes_;
    std::vector<std::uint32_t> found_;
    std::size_t work_ = 0;
};

}  // namespace delmesh
