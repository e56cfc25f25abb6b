#pragma once
// Where to split which edges so that few points are needed: the search of docs/fewest.md.

#include "delaunay/marked_mesh.hpp"
#include "delaunay/split_bound.hpp"
#include "delaunay/split_model.hpp"
#include "delaunay/split_regions.hpp"
#include "delaunay/split_search.hpp"
#include "delmesh/base/context.hpp"
#include "delmesh/delaunay/provenance.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace delmesh {

class GapCloser;

struct SplitSearchOptions {
    int effort = 0;  ///< 0: construction only; each step more doubles the work
    std::uint64_t seed = 1;
    bool quick = false;      ///< where there is a baseline, the construction takes about as long as that
    bool is_greedy = false;  ///< for `construct_quickly` and nothing else
    SplitBoundOptions bound = {};
};

/// What a chooser knows, in words of the mesh.
struct SplitPlan {
    std::vector<SplitPoint> splits;  ///< ordered by edge and parameter
    std::vector<EdgeId> open;        ///< edges that are not Delaunay with them
    std::vector<EdgeId> distrusted;  ///< see SplitModel
    bool is_compared = false;        ///< with the baseline, region by region
    bool leaves_open = false;        ///< what is open, although there is a baseline
};

/// The point at t of the edge of h, from its smaller vertex.
[[nodiscard]] SplitPoint split_at(const Mesh& mesh, HalfedgeId h, double t);

/// Chooses points on physical edges after which, in exact arithmetic, all edges would be Delaunay. Deterministic.
/// Memory: linear in the faces around the points. The mesh must not change meanwhile.
class SplitChooser {
public:
    /// `marked`: planar edges are Delaunay; `bad`: the physical edges that are not, in order.
    SplitChooser(const MarkedMesh& marked, std::span<const EdgeId> bad, const SplitSearchOptions& options);

    /// Another solution, to borrow from where the search finds none, and to compare with.
    void set_baseline(std::span<const SplitPoint> splits);
    /// Takes the baseline away, in the words of the mesh but for what lies within facets. For large ones: there is no
    /// room for a second copy as long as the model is there, so `edge` is the half-edge that names it.
    [[nodiscard]] std::vector<PlacedPoint> take_baseline();
    /// Some edges may stay as they are, not Delaunay: `leaves_open` where there is a baseline.
    void search(const Context* context);
    /// What `search` has proved: no method needs fewer points. 0: nothing.
    [[nodiscard]] std::size_t proved_bound() const { return proved_bound_; }
    [[nodiscard]] bool leaves_open() const { return leaves_open_; }
    /// Takes the baseline in all regions where edges are open, or where it has fewer points.
    void close_by_baseline();
    /// Instead of `search`: threads in parallel planes. These input edges, by their ends, are distrusted. False if
    /// edges stay open.
    bool lay_slices(const SliceOptions& options, std::span<const std::array<VertexId, 2>> distrusted,
                    const Context* context);
    /// Instead of `search`: in about the time of the shells, and less well. Edges may stay as they are.
    void construct_quickly();
    /// The points, ordered by edge and parameter.
    [[nodiscard]] std::vector<SplitPoint> splits() const;
    /// All of what has been found, for another chooser of the same mesh to go on from. `splits` are those of
    /// `splits()`.
    [[nodiscard]] SplitPlan plan() const;
    void resume(const SplitPlan& plan);
    /// These input edges, by their ends, have turned out not to be Delaunay: from now on they keep a distance from
    /// ties. False if that changes nothing.
    bool mend(std::span<const std::array<VertexId, 2>> edges);
    /// Takes the baseline in all regions where it has fewer points than what the points have come to in truth. False
    /// if there is none.
    bool take_better_regions(std::span<const SplitPoint> truth);

private:
    [[nodiscard]] double default_work() const;
    [[nodiscard]] double full_work() const;
    [[nodiscard]] bool is_hopeless() const;
    void find_places(double full, const Context* context);
    [[nodiscard]] bool is_wild() const;
    void find_best_places(double full, const Context* context);
    void keep_better(const std::vector<PlacedPoint>& other, const std::vector<std::uint32_t>& open);
    void go_on(double work, const Context* context);
    bool close_gaps(GapCloser& gaps, double work, const Context* context);
    [[nodiscard]] std::vector<EdgeId> bad_edges() const;
    void close(double full);
    void put(std::span<const PlacedPoint> points, const std::vector<std::uint32_t>& open);
    void spread(double work, bool in_blocks, const Context* context);
    void improve(double full, double work, const Context* context);
    void improve_blocks_once(bool polish, const Context* context);
    void improve_blocks(const Context* context);
    void wait_for_open_edges(double work, const Context* context);
    [[nodiscard]] std::uint32_t edge_between(VertexId a, VertexId b);
    [[nodiscard]] std::vector<PlacedPoint> place(std::span<const SplitPoint> splits);

    SplitModel model_;
    SplitSearch search_;
    SplitSearchOptions options_;
    std::vector<std::uint32_t> bad_;
    std::vector<PlacedPoint> baseline_;
    bool is_compared_ = false;  ///< with the baseline, region by region, as the points are now
    bool leaves_open_ = false;
    std::size_t proved_bound_ = 0;
    int round_ = 0;           ///< of the search in blocks
    double shares_done_ = 0;  ///< of the full work, in these rounds
};

}  // namespace delmesh
