#pragma once
// Turns a mesh into a Delaunay mesh.

#include "delmesh/base/context.hpp"
#include "delmesh/base/option.hpp"
#include "delmesh/delaunay/provenance.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace delmesh {

enum class RemeshMode {
    preserve,  ///< the surface stays as it is: planar edges flip, all others are split (Algorithm 1 of the paper)
    flip,      ///< any edge may flip; only what can not be flipped and the boundary are split (Algorithm 2)
    feature,   ///< sharp edges are split, all others flip (section 6)
};

/// In which order edges are flipped in the modes flip and feature; docs/decisions/0005 has measurements.
enum class FlipOrder {
    worst,  ///< largest sum of opposite angles first, ties by index (the paper's)
    fifo,
    lifo,
};

/// What happens in mode flip when no edge can be flipped any more but some are not Delaunay yet.
enum class FlipFinish {
    keep_flipping,  ///< split these, then flip again, for at most 100 rounds; then as `literal`. Needs fewest splits
    literal,        ///< Algorithm 2 as published: the surface is kept from here on, by Algorithm 1
};

/// Where edges are split.
enum class SplitPlacement {
    fewest,  ///< where a search finds that few points are enough; never more than `shells`. See docs/fewest.md
    shells,  ///< at concentric shells: Algorithm 1 as published
};

/// Mode preserve: when do edges count as planar that are not so exactly? docs/flat.md.
enum class FlatRule {
    automatic,  ///< never, unless the run would stop short and mostly because of such edges: then as `stored`
    stored,     ///< where the rounding of the coordinates to the precision they were stored with can explain it
    given,      ///< within the number that is given
};
using FlatTolerance = NumberByRule<FlatRule>;

/// What is known early in mode preserve, once planar edges have been flipped.
struct GrowthEstimate {
    std::size_t vertices = 0;  ///< of the input
    /// Edges that must be split: no method that keeps the surface adds fewer vertices.
    std::size_t lower_bound = 0;
    /// Those of them that are sharper than RemeshOptions::feature_angle_deg, or at the boundary: only these would mode
    /// feature have to split.
    std::size_t sharp_edges = 0;
    /// What the placement is likely to add; CAD needles can need ten times more.
    std::size_t likely_splits = 0;
    /// The lower bound with FlatRule::stored, where rounding was found to matter.
    std::optional<std::size_t> lower_bound_if_flat;
};

/// Why a run ended. Whatever the reason, the mesh is valid and every vertex and face of it is accounted for.
enum class StopReason {
    done,          ///< every edge is Delaunay
    max_vertices,  ///< the next split would exceed RemeshOptions::max_vertices
    unresolved,    ///< doubles (or floats, see RemeshOptions::precision) can not resolve a split of `witness`
    cancelled,     ///< the context was cancelled
};

[[nodiscard]] std::string_view name(StopReason reason);
[[nodiscard]] std::span<const std::string_view> choices(RemeshMode);
[[nodiscard]] std::span<const std::string_view> choices(FlipOrder);
[[nodiscard]] std::span<const std::string_view> choices(FlipFinish);
[[nodiscard]] std::span<const std::string_view> choices(SplitPlacement);
[[nodiscard]] std::span<const std::string_view> choices(FlatRule);

struct RemeshOptions {
    RemeshMode mode = RemeshMode::preserve;
    /// Mode feature: edges whose faces deviate from flat by more than this are not flipped. 0 gives `preserve`, 180
    /// `flip`.
    double feature_angle_deg = 10;
    /// Mode feature: edges of the input that are not flipped either, by their ends. Pairs that are no edges are
    /// refused.
    std::vector<std::array<VertexId, 2>> feature_edges;
    /// Modes flip and feature: treat an edge as unflippable if a face would turn by more than 90 degrees.
    bool no_foldover = false;
    FlipOrder order = FlipOrder::worst;
    FlipFinish finish = FlipFinish::keep_flipping;
    SplitPlacement placement = SplitPlacement::fewest;
    /// Placement fewest: how long to search. 0: hardly at all; each step more doubles the work.
    std::size_t effort = 3;
    /// Placement fewest: other seeds find other, about equally good places.
    std::size_t seed = 1;
    /// Mode preserve: also prove a lower bound that is better than the number of edges that must be split.
    bool bound = false;
    /// The unit of the concentric shells: split vertices lie at the distance 2^k * shell_unit_abs from an end of
    /// their edge. In units of the coordinates, above 0. The paper's delta.
    double shell_unit_abs = 1;
    /// Mode preserve: edges flatter than this count as planar and may flip; the surface then moves by no more than
    /// this, a fraction of the bounding-box diagonal. {FlatRule::given, 0}: only edges that are planar exactly.
    /// docs/flat.md.
    FlatTolerance flat_tolerance_rel;
    /// The largest number of vertices that the output may have; 0: no limit.
    std::size_t max_vertices = 0;
    /// What new vertices are rounded to when they are made. With float32 the input must consist of floats.
    Precision precision = Precision::float64;
    /// Mode preserve: called when the growth can be estimated, on the calling thread; once for each attempt.
    std::function<void(const GrowthEstimate&)> on_growth;

    /// See option.hpp. `precision` is left out: it follows from the file that is written.
    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit(self.mode, OptionInfo{.name = "mode", .help = "how the surface may change"});
        visit(self.feature_angle_deg, OptionInfo{.name = "feature-angle",
                                                 .unit = "deg",
                                                 .lowest = 0,
                                                 .highest = 180,
                                                 .help = "mode feature: keep edges that deviate from flat by more"});
        visit(self.no_foldover,
              OptionInfo{.name = "no-foldover", .help = "split an edge whose flip would fold the surface"});
        visit(self.order, OptionInfo{.name = "order", .help = "in which order edges are flipped"});
        visit(self.finish,
              OptionInfo{.name = "finish", .help = "mode flip: what to do when nothing can be flipped any more"});
        visit(self.placement, OptionInfo{.name = "placement", .help = "where edges are split"});
        visit(self.effort, OptionInfo{.name = "effort",
                                      .lowest = 0,
                                      .highest = 12,
                                      .help = "placement fewest: how long to search; each step doubles the work"});
        visit(self.seed, OptionInfo{.name = "seed", .lowest = 0, .help = "placement fewest: seed of the search"});
        visit(self.bound, OptionInfo{.name = "bound", .help = "mode preserve: prove how many splits any method needs"});
        visit(self.shell_unit_abs,
              OptionInfo{.name = "shell-unit",
                         .unit = "abs",
                         .lowest = std::numeric_limits<double>::denorm_min(),
                         .help = "split vertices lie at 2^k times this from an end of their edge"});
        visit(
            self.flat_tolerance_rel,
            OptionInfo{.name = "flat-tolerance",
                       .unit = "rel",
                       .lowest = 0,
                       .highest = 0.01,
                       .help = "mode preserve: edges flatter than this count as planar; the surface stays within it"});
        visit(self.max_vertices,
              OptionInfo{
                  .name = "max-vertices",
                  .lowest = 0,
                  .help =
                      "stop before the output has more; 0: the command stops at 5 times the input, or 1 million more"});
    }
};

struct RemeshReport {
    StopReason stop = StopReason::done;
    std::size_t flips = 0;
    std::size_t splits = 0;
    /// What was split: boundary edges; edges that the mode does not allow to flip; edges that could not be flipped
    /// because the opposing edge exists (or would fold the surface, with no_foldover) and their like. They add up to
    /// `splits`.
    std::size_t splits_boundary = 0;
    std::size_t splits_feature = 0;
    std::size_t splits_unflippable = 0;
    /// Modes flip and feature: unflippable edges met when flipping first came to an end, by how many faces of the flip
    /// tetrahedron belonged to the mesh: 2, 3, 4 (section 4.3 of the paper).
    std::array<std::size_t, 3> exposed{};
    /// Faces made by flips whose normal turned by more than 90 degrees against the two faces before.
    std::size_t foldovers = 0;
    /// Mode preserve: edges that had to be split after planar flips alone: no method that keeps the surface adds fewer
    /// vertices.
    std::size_t lower_bound = 0;
    /// The same, proved to be as high as this; where RemeshOptions::bound asks for it. docs/fewest.md has the proof.
    std::optional<std::size_t> lower_bound_strong;
    /// Mode preserve, placement fewest: what placement shells would have split; 0 where that was not found out.
    std::size_t splits_by_shells = 0;
    /// Mode preserve: the flat tolerance that was used, and an upper bound of how far any point of either surface is
    /// from the other one, beyond the rounding of split points; both in units of the coordinates. Mode feature, where
    /// needles that are flat but for rounding had to go first: the same for that step; more than 0 nowhere else.
    double flat_tolerance = 0;
    double max_deviation = 0;
    /// The edge that stopped the run, where one did.
    std::optional<EdgeId> witness;
    /// The run was stopped (`unresolved`) as that edge, which lies in a plane, came back whenever it was split.
    bool endless = false;
    Provenance provenance;
};

/// Makes every interior edge's opposite angles sum to at most pi and every boundary edge's opposite angle at most pi/2,
/// exactly, on the coordinates as they are stored. Input vertices keep their ids and their bits; new ones follow. Mode
/// `preserve`: every output face lies in an input face (up to the rounding of split points, one ulp). Throws `Error`
/// (zero_length_edge, degenerate_geometry, bad_argument). Termination: section 3.2 of the paper; where the arithmetic
/// can not resolve a split, stops with `unresolved`. Cost: O(faces + flips + splits) in practice; there is no bound on
/// the number of splits in terms of the input size. Deterministic: the same bits for the same input and options,
/// whatever the number of threads.
RemeshReport make_delaunay(Mesh& mesh, const RemeshOptions& options = {}, const Context* context = nullptr);

}  // namespace delmesh
