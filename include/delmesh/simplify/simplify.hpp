#pragma once
// Fewer vertices, still Delaunay: levels of detail by edge collapse under Delaunay constraints.

#include "delmesh/base/context.hpp"
#include "delmesh/base/option.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/mesh.hpp"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace delmesh {

/// Where the vertex that replaces an edge goes.
enum class Placement {
    best,   ///< the lowest quadric error where all edges stay Delaunay, searched in the true feasible region
    paper,  ///< the lowest quadric error in the linearised region of section 5 of the paper
};
[[nodiscard]] std::span<const std::string_view> choices(Placement);

/// Why a level ended where it did.
enum class SimplifyStop {
    done,          ///< the level has the number of vertices that was asked for (or the input had no more; or fewer were
                   ///< left by mending, see SimplifyReport::thinned_to)
    blocked,       ///< no edge can be collapsed any more; `LevelReport::blocked` says what blocks
    error_limit,   ///< every collapse that is left would exceed SimplifyOptions::max_quadric_error_rel
    not_delaunay,  ///< the input could not be made Delaunay (see SimplifyReport::remesh); nothing was simplified
    cancelled,     ///< the context was cancelled
};
[[nodiscard]] std::string_view name(SimplifyStop stop);

/// What keeps an edge from being collapsed.
enum class Obstacle {
    topology,    ///< the surface would get another topology, or a component its last face
    fold_over,   ///< a face would turn over (by more than 84 degrees)
    subtending,  ///< an edge of the ring around the merged vertex would not be Delaunay
    incident,    ///< an edge at the merged vertex would not be Delaunay
    error,       ///< the quadric error would exceed the limit
};
inline constexpr std::size_t obstacle_count = 5;
[[nodiscard]] std::string_view name(Obstacle obstacle);

struct LevelReport {
    std::size_t target = 0;    ///< vertices asked for
    std::size_t vertices = 0;  ///< vertices reached
    SimplifyStop stop = SimplifyStop::done;
    /// The largest distance so far between a merged vertex and the planes of the original faces it stands for (root of
    /// the area-weighted mean square), in units of the coordinates. Not a Hausdorff distance. Where a large mesh was
    /// thinned first, the faces are those that were left then.
    double quadric_error = 0;
    /// The edges that could not be collapsed when they were last tried, by what blocked them (index: Obstacle).
    std::array<std::size_t, obstacle_count> blocked{};
};

struct SimplifyOptions {
    Placement placement = Placement::best;
    /// The one level wanted, as a number of vertices; 0: see `ratio` and `levels`.
    std::size_t vertices = 0;
    /// The one level wanted, as a part of the input's vertices, but no fewer than its components, handles and boundary
    /// loops need; 0: see `vertices` and `levels`.
    double ratio = 0;
    /// Several levels in one pass, as numbers of vertices, each at least 1; sorted here from fine to coarse.
    std::vector<std::size_t> levels;
    /// No merged vertex gets farther than this from the planes it stands for, as a part of the bounding box's diagonal;
    /// 0: no limit. With none of `vertices`, `ratio`, `levels` given, simplifies as far as this allows.
    double max_quadric_error_rel = 0;
    /// Creases sharper than this keep their shape as the boundary does; 180: none are treated apart.
    double feature_angle_deg = 180;
    /// Follows samples of the original surface: when a level is reached, and now and then on the way, vertices are
    /// moved closer to them, and collapses that would leave one of them far off wait until the others are done; at
    /// the end of a level that is not too large, they say which vertices are worth more elsewhere. Only with placement
    /// `best` and without `max_quadric_error_rel`.
    bool refit = true;
    /// How an input that is not Delaunay yet is made so. `remesh.precision` is also what new vertices are rounded to.
    RemeshOptions remesh = default_remesh();
    /// On large inputs full of noise, edges sharper than `remesh.feature_angle_deg` are everywhere, and to split them
    /// would only make the way longer: twice the angle is used there. See `SimplifyReport::remesh_angle_deg`.
    bool wider_angle_on_noise = true;
    /// Called when a level is reached, fine to coarse, with a compact mesh that is valid during the call.
    std::function<void(const Mesh&, const LevelReport&)> on_level;

    /// Mode feature, at an angle that docs/simplify.md justifies. With placement `fewest`, few points are looked for
    /// only where shells would add more than a tenth of the vertices, and not more than 20,000.
    [[nodiscard]] static RemeshOptions default_remesh() {
        RemeshOptions remesh;
        remesh.mode = RemeshMode::feature;
        remesh.feature_angle_deg = 15;
        remesh.effort = 1;
        return remesh;
    }

    /// See option.hpp. `levels`, `remesh`, `wider_angle_on_noise` and `on_level` are not among the described options.
    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit(self.placement, OptionInfo{.name = "placement", .help = "where merged vertices go"});
        visit(self.vertices, OptionInfo{.name = "vertices", .lowest = 0, .help = "number of vertices wanted"});
        visit(self.ratio, OptionInfo{.name = "ratio",
                                     .lowest = 0,
                                     .highest = 1,
                                     .help = "part of the input's vertices wanted, for example 0.1"});
        visit(self.max_quadric_error_rel,
              OptionInfo{.name = "max-quadric-error",
                         .unit = "rel",
                         .lowest = 0,
                         .help = "no vertex gets farther than this from the planes it stands for; 0: no limit"});
        visit(self.feature_angle_deg, OptionInfo{.name = "feature-angle",
                                                 .unit = "deg",
                                                 .lowest = 0,
                                                 .highest = 180,
                                                 .help = "creases sharper than this keep their shape; 180: none"});
        visit(self.refit, OptionInfo{.name = "refit", .help = "stay close to samples of the original"});
    }
};

struct SimplifyReport {
    /// Given if the input was not Delaunay and was remeshed first. Without provenance, unless that stopped short.
    std::optional<RemeshReport> remesh;
    /// Mode feature: the angle that this was done with. More than was asked for on large noisy inputs
    /// (`wider_angle_on_noise`), and where that needed more vertices than `remesh.max_vertices` or points that doubles
    /// can not hold (45, or 180: all edges may flip).
    double remesh_angle_deg = 0;
    /// Where remeshing would have stopped short or more than doubled the mesh: to so many vertices the mesh was brought
    /// before it, by collapses without the Delaunay conditions; or, with no splits and angle 0, by mending, where the
    /// level was not reached that way (docs/simplify.md): this may be fewer than asked for. 0: that was not needed.
    std::size_t thinned_to = 0;
    std::size_t input_vertices = 0;  ///< of the mesh as it came, isolated ones included: what `ratio` refers to
    /// No mesh with the same components, handles and boundary loops has fewer vertices. 0 if nothing was simplified.
    std::size_t least_vertices = 0;
    std::size_t collapses = 0;
    std::size_t moves = 0;  ///< vertices moved by refitting, or taken to another place
    std::vector<LevelReport> levels;
    SimplifyStop stop = SimplifyStop::done;  ///< of the last level
};

/// Collapses edges until the levels asked for are reached, cheap ones first. The mesh is Delaunay after every single
/// collapse, exactly, on the coordinates as they are stored; the topology never changes, components and boundary loops
/// keep existing (a closed component has at least 4 vertices, an open one 3), and no face turns over. Where a target
/// can not be reached, the report says how far it came and what blocks. Isolated vertices are dropped. Vertex and face
/// ids are those of the coarsest level: what survives keeps its order.
///
/// An input that is not Delaunay is remeshed first with `options.remesh`, and with a wider feature angle where that
/// stops short; one of 200,000 vertices or more is thinned before that, by collapses that leave no more edges that are
/// not Delaunay than there were. Ratios and targets refer to the number of vertices before all that. Not guaranteed: a
/// bound on the distance to the original, and that the surface does not intersect itself. After cancelling the mesh is
/// valid and Delaunay (once it was), somewhere between two levels.
///
/// Throws `Error` (bad_argument; for remeshing see `make_delaunay`). Cost: O(n log n) for n vertices in practice.
/// Deterministic: the same bits for the same input and options on every system.
/// Source: section 5 of Dyer, Zhang, Moeller 2007; docs/simplify.md says what differs.
SimplifyReport simplify(Mesh& mesh, const SimplifyOptions& options = {}, const Context* context = nullptr);

}  // namespace delmesh
