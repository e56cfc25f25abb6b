#include "delmesh/simplify/simplify.hpp"

#include "delaunay/flip_surface.hpp"
#include "delaunay/vertex_limit.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/exact/predicates.hpp"
#include "delmesh/measure/certificate.hpp"
#include "delmesh/measure/statistics.hpp"
#include "delmesh/mesh/edits.hpp"
#include "delmesh/simplify/progressive_mesh.hpp"
#include "simplify/decimator.hpp"
#include "simplify/least_vertices.hpp"
#include "simplify/mend.hpp"
#include "simplify/start.hpp"
#include "simplify/sweeper.hpp"
#include "simplify/thinner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

namespace delmesh {
namespace {

/// Meshes so small are not worth sweeping.
constexpr double least_far = 256;

/// From so many vertices on at the finest level, time counts for more, and chance for less.
constexpr std::size_t many = 20'000;

/// From so many vertices on what is kept beside a mesh is as little as can be.
constexpr std::size_t large = 200'000;
/// It is thinned to so many times the vertices asked for, and gets no more points than these or a quarter then.
constexpr std::size_t thin_from = 3;
constexpr std::size_t few_points = 20'000;

/// Around a vertex with more faces than these, each collapse would look at the samples of all of them.
constexpr std::uint32_t hub = 1000;

/// What is given to the user is worth more than what is passed on the way.
RefitTuning tuning_at_level(std::size_t vertices) {
    return {.rounds = vertices < many ? 6 : 4, .regular = 1e-6, .least_gain = 0.002};
}
constexpr RefitTuning before_polish{.rounds = 2, .least_gain = 0.002};

void check_options(const SimplifyOptions& options) {
    const auto refuse = [](const std::string& why) { throw Error(ErrorCode::bad_argument, why); };
    if (!(options.ratio >= 0 && options.ratio <= 1))
        refuse(fmt::format("the ratio must lie between 0 and 1, not be {}", options.ratio));
    if (!(options.max_quadric_error_rel >= 0))
        refuse(fmt::format("the largest quadric error must not be {}", options.max_quadric_error_rel));
    if (!(options.feature_angle_deg >= 0 && options.feature_angle_deg <= 180))
        refuse(
            fmt::format("the crease angle must lie between 0 and 180 degrees, not be {}", options.feature_angle_deg));
    const int ways = (options.vertices > 0) + (options.ratio > 0) + !options.levels.empty();
    if (ways > 1) refuse("give one of a number of vertices, a ratio or a list of levels, not several");
    if (ways == 0 && options.max_quadric_error_rel == 0)
        refuse("say how far to simplify: a number of vertices, a ratio, levels or a largest quadric error");
    if (std::find(options.levels.begin(), options.levels.end(), std::size_t{0}) != options.levels.end())
        refuse("a level needs at least one vertex");
}

/// Fine to coarse, each once. A number that was given is taken by its word; a part of a small mesh may be less than can
/// be had.
std::vector<std::size_t> find_targets(const SimplifyOptions& options, const Mesh& mesh) {
    if (options.vertices > 0) return {options.vertices};
    if (options.ratio > 0) {
        const double wanted = std::round(options.ratio * static_cast<double>(mesh.vertex_count()));
        return {std::max({std::size_t{1}, least_vertices(mesh), static_cast<std::size_t>(wanted)})};
    }
    if (options.levels.empty()) return {1};
    std::vector<std::size_t> targets = options.levels;
    std::sort(targets.begin(), targets.end(), std::greater<>());
    targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
    return targets;
}

/// How many samples of the original are followed on the way to so many vertices.
std::size_t samples_for(std::size_t vertices, double density = Tuning().density) {
    return static_cast<std::size_t>(std::min(1e9, Tuning().samples + density * static_cast<double>(vertices)));
}

Tuning tuning_for(const SimplifyOptions& options) {
    constexpr double radians = 3.14159265358979323846 / 180;
    Tuning tuning;
    // To float and back: the last bits of cos differ between systems.
    tuning.crease_cosine = options.feature_angle_deg >= 180
                               ? -1
                               : static_cast<double>(static_cast<float>(std::cos(options.feature_angle_deg * radians)));
    if (options.placement == Placement::paper) tuning = Tuning::of_the_paper(tuning.crease_cosine);
    return tuning;
}

Obstacle obstacle(Blocker blocker) {
    switch (blocker) {
        case Blocker::fold:
            return Obstacle::fold_over;
        case Blocker::subtending:
            return Obstacle::subtending;
        case Blocker::incident:
        case Blocker::region:
        case Blocker::rounding:
            return Obstacle::incident;
        case Blocker::error:
            return Obstacle::error;
        default:
            return Obstacle::topology;
    }
}

LevelReport describe_level(const Decimator& decimator, std::size_t target, const Context* context) {
    LevelReport level{.target = target, .vertices = decimator.vertices(), .blocked = {}};
    level.quadric_error = decimator.worst_error();
    const auto blocked = decimator.count_blocked();
    for (std::size_t i = 1; i < blocked.size(); ++i)
        if (static_cast<Blocker>(i) != Blocker::distance)  // those would have their turn
            level.blocked[static_cast<std::size_t>(obstacle(static_cast<Blocker>(i)))] += blocked[i];
    if (level.vertices <= target) return level;
    level.stop = is_cancelled(context)                                          ? SimplifyStop::cancelled
                 : level.blocked[static_cast<std::size_t>(Obstacle::error)] > 0 ? SimplifyStop::error_limit
                                                                                : SimplifyStop::blocked;
    return level;
}

Mesh without_dead(const Mesh& mesh, const Numbering& numbering) {
    Mesh copy = mesh;
    drop_isolated(copy);
    renumber(copy, numbering.in_order_of_names(copy));
    return copy;
}

/// Quadrics of the current faces drift away from the original: every time the vertices have become half as many, they
/// are moved back. With `records`, not where nothing has been collapsed: that level has been handed out.
std::size_t refit_on_the_way(Decimator& decimator, std::size_t input_vertices, std::size_t target, bool records,
                             const Context* context) {
    std::size_t moves = 0;
    for (std::size_t stop = input_vertices / 4; stop > target + target / 2 && !is_cancelled(context); stop /= 2) {
        const std::size_t before = decimator.vertices();
        if (stop >= before) continue;
        decimator.run(stop, context);
        if (records && decimator.vertices() == before) break;
        moves += decimator.refit({.rounds = 1}, context);
    }
    return moves;
}

/// Where the care for single vertices begins.
std::size_t reduce_from(std::size_t target, const Tuning& tuning) {
    const auto more = static_cast<std::size_t>((tuning.reduce_from - 1) * static_cast<double>(target));
    return target + std::min(more, tuning.reduce_most);
}

/// Where nothing else helps: shakes the mesh until edges come free, more and more strongly; now and then a refit takes
/// back what that has spoiled. Ends after `most` places tried, vertices, edges and samples looked at.
void shake_free(Decimator& decimator, std::size_t target, std::size_t most, const Context* context) {
    const std::size_t patience = 200'000 + 20 * decimator.vertices();  // places tried, vertices looked at
    constexpr double gentle = 4;
    constexpr double strong = 1e4;
    std::size_t work = 0;
    std::size_t last_gain = 0;
    const std::size_t begun = decimator.work_beside_places();
    double freedom = gentle;
    for (std::uint64_t seed = 1; decimator.vertices() > target && !is_cancelled(context); ++seed) {
        const std::size_t before = decimator.vertices();
        const std::size_t tried = decimator.placer().evaluations();
        decimator.loosen(seed, freedom);
        decimator.run(target, context);
        work += decimator.placer().evaluations() - tried + 4 * before;
        if (decimator.vertices() < before) last_gain = work;
        if (before - decimator.vertices() > before / 64) {
            freedom = gentle;
        } else if ((freedom *= 1.5) > strong) {
            freedom = gentle;
            if (decimator.has_samples()) (void)decimator.refit({.rounds = 1}, context);
        }
        const std::size_t beside = decimator.work_beside_places() - begun;
        if (work > last_gain + patience || work + beside > most) break;
    }
}

/// Where all edges are blocked, moving the vertices frees some.
std::size_t run_on(Decimator& decimator, std::size_t target, bool refit, const Context* context) {
    std::size_t moves = 0;
    for (;;) {
        const std::size_t before = decimator.vertices();
        decimator.run(target, context);
        const bool further = decimator.vertices() > target && decimator.vertices() < before;
        if (!refit || !further || is_cancelled(context)) break;
        moves += decimator.refit({.rounds = 1}, context);
    }
    return moves;
}

}  // namespace

std::span<const std::string_view> choices(Placement) {
    static constexpr std::string_view names[] = {"best", "paper"};
    return names;
}

std::string_view name(SimplifyStop stop) {
    static constexpr std::string_view names[] = {"done", "blocked", "error_limit", "not_delaunay", "cancelled"};
    return names[static_cast<std::size_t>(stop)];
}

std::string_view name(Obstacle obstacle) {
    static constexpr std::string_view names[] = {"topology", "fold_over", "subtending", "incident", "error"};
    return names[static_cast<std::size_t>(obstacle)];
}

namespace {

bool has_hub(const Mesh& mesh) {
    std::vector<std::uint32_t> faces(mesh.vertex_count());
    for (const VertexId v : mesh.corners())
        if (v.valid() && ++faces[v.index()] > hub) return true;
    return false;
}

/// How far the sweeps go.
std::size_t sweep_until(std::size_t target, const Tuning& tuning) {
    const double until = target < many ? tuning.sweep_until : tuning.sweep_many;
    return static_cast<std::size_t>(std::max(least_far, until * static_cast<double>(target)));
}

/// While there is a long way to go: in sweeps.
std::unique_ptr<Sweeper> sweep_first(Mesh& mesh, const Tuning& tuning, const SimplifyOptions& options,
                                     std::size_t target, Numbering& numbering, const Context* context) {
    drop_isolated(mesh);
    Tuning quick = tuning;
    quick.ends = target < many;
    auto sweeper = std::make_unique<Sweeper>(mesh, quick, options.remesh.precision, numbering);
    sweeper->run(sweep_until(target, tuning), context);
    return sweeper;
}

/// Where to, and what may be done on the way. Steps that are recorded know no flips, so neither the first nor the last
/// then.
struct Way {
    std::vector<std::size_t> targets;
    Tuning tuning;
    DecimatorLimits limits;
    bool records = false, shakes = false, refits = false, polishes = false;
};

/// Down to so many vertices, if it can be, and makes the best of them.
void reach(Decimator& decimator, std::size_t target, const Way& way, Numbering& numbering, SimplifyReport& report,
           const Context* context) {
    const Tuning& tuning = way.tuning;
    const bool polish = way.polishes && target <= tuning.polish_below;
    const std::size_t before = decimator.vertices();
    decimator.guard_for(target);
    if (way.refits) report.moves += refit_on_the_way(decimator, report.input_vertices, target, way.records, context);
    if (polish) {
        report.moves += run_on(decimator, reduce_from(target, tuning), way.refits, context);
        decimator.reduce(target, context);
    }
    report.moves += run_on(decimator, target, way.refits, context);
    if (way.shakes && decimator.vertices() > std::max(target, report.least_vertices)) {
        decimator.close_gaps(numbering);
        // Nobody waits long for what can not be reached, or hardly.
        const std::size_t most = target < report.least_vertices    ? 1'000'000
                                 : target == report.least_vertices ? 4'000'000
                                                                   : 24'000'000;
        shake_free(decimator, std::max(target, report.least_vertices), most, context);
    }
    report.levels.push_back(describe_level(decimator, target, context));
    if (!way.refits || decimator.counts().collapses == 0 || (way.records && decimator.vertices() == before)) return;
    if (polish) {
        report.moves += decimator.refit(before_polish, context);
        decimator.close_gaps(numbering);
        report.moves += decimator.polish(context);
        report.levels.back().quadric_error = decimator.worst_error();
    }
    report.moves += decimator.refit(tuning_at_level(target), context);
}

/// What a large mesh was before it was thinned.
struct Before {
    SampleSource samples;
    std::vector<VertexId> merged_into;
};

/// Where so much is to go that the care of the sweeps would be lost on it, and would take more room than the mesh.
bool may_thin(const Mesh& mesh, const Way& way) {
    const std::size_t vertices = mesh.vertex_count();
    return way.polishes && vertices >= large && thin_from * way.targets.front() <= vertices - vertices / 4;
}

/// Thins the mesh; what is not Delaunay then was not before.
Before thin(Mesh& mesh, const Way& way, Precision precision, bool is_delaunay, SimplifyReport& report,
            const Context* context) {
    const std::size_t target = way.targets.front();
    Tuning tuning = way.tuning;
    tuning.constrained = is_delaunay;
    tuning.mending = is_delaunay ? Mending::off : Mending::no_more;
    const std::size_t samples = samples_for(target, target < many ? tuning.density : tuning.density_of_large);
    drop_isolated(mesh);
    Before before{SampleSource(mesh, mesh.vertex_count(), local_scale(mesh), samples), {}};
    Thinner thinner(mesh, tuning, precision);
    thinner.run(thin_from * target, context);
    before.merged_into = thinner.merged_into();
    report.collapses += thinner.collapses();
    return before;
}

/// Whether most faces lie in a plane with their neighbours, as on parts that were constructed. Flips cost nothing
/// there, and collapses that do not keep such faces Delaunay would leave needles that are tilted.
bool is_mostly_plane(const Mesh& mesh) {
    constexpr std::size_t looked_at = 20'000;
    std::size_t plane = 0;
    std::size_t edges = 0;
    for (std::size_t i = 0; i < mesh.halfedge_count(); i += 1 + mesh.halfedge_count() / looked_at) {
        const HalfedgeId h(i);
        const HalfedgeId t = mesh.twin(h);
        if (!t.valid()) continue;
        ++edges;
        if (is_planar_edge(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.apex(h)),
                           mesh.point(mesh.apex(t))))
            ++plane;
    }
    return plane > edges / 2;
}

/// Makes the mesh Delaunay. A large one is thinned, mostly before that: most points would be for vertices that vanish
/// anyhow.
bool start(Mesh& mesh, const Way& way, const SimplifyOptions& options, std::optional<Before>& before,
           SimplifyReport& report, const Context* context) {
    RemeshOptions remesh = start_options(mesh, options);
    const bool is_delaunay = may_thin(mesh, way) && certify(mesh, context).certified;
    if (may_thin(mesh, way) && remesh.feature_edges.empty() && (is_delaunay || !is_mostly_plane(mesh))) {
        if (!is_delaunay && remesh.mode != RemeshMode::preserve) flip_alone(mesh, remesh, context);
        before = thin(mesh, way, remesh.precision, is_delaunay, report, context);
        remesh = with_at_most(remesh, mesh.vertex_count() + std::max(few_points, mesh.vertex_count() / 4));
    }
    const StartLimits limits{.vertices = way.targets.front(), .may_thin = way.shakes};
    if (!make_start_delaunay(mesh, remesh, way.tuning, limits, report, context)) return false;
    if (report.thinned_to > 0) before.reset();  // the vertices are not what they were
    if (!before && may_thin(mesh, way)) before = thin(mesh, way, remesh.precision, true, report, context);
    return true;
}

/// A decimator for a mesh that is Delaunay, which has gone the first part of the way.
void begin(Decimator& decimator, std::optional<SurfaceSamples> samples, std::unique_ptr<Sweeper> sweeper,
           std::vector<VertexId> merged_before, SimplifyReport& report, const Context* context) {
    if (samples) decimator.follow_samples(std::move(*samples));
    if (!sweeper) return;
    report.collapses += sweeper->collapses();
    decimator.continue_from(std::move(sweeper), std::move(merged_before));
    report.moves = decimator.refit({.rounds = 1}, context);
}

/// From level to level. Nothing of what that takes is left at the end.
void go_down(Mesh& mesh, std::optional<Before> before, const Way& way, const SimplifyOptions& options,
             Recorder* recorder, Numbering& numbering, SimplifyReport& report, const Context* context) {
    const std::size_t target = way.targets.front();
    // All steps of a progressive mesh are levels, so they are made with all care.
    const bool sweeps = way.polishes && (before || mesh.vertex_count() > sweep_until(target, way.tuning));
    std::optional<SurfaceSamples> samples;
    if (before && sweeps) {
        samples.emplace(std::move(before->samples));
    } else if (way.refits) {
        const std::size_t count = std::min(report.input_vertices, mesh.vertex_count());
        const std::size_t most = samples_for(target);
        samples = sweeps ? SurfaceSamples(SampleSource(mesh, count, local_scale(mesh), most))
                         : SurfaceSamples(mesh, count, local_scale(mesh), most);
    }
    std::unique_ptr<Sweeper> sweeper;
    if (sweeps) sweeper = sweep_first(mesh, way.tuning, options, target, numbering, context);
    Decimator decimator(mesh, way.tuning, way.limits, recorder);
    begin(decimator, std::move(samples), std::move(sweeper),
          before ? std::move(before->merged_into) : std::vector<VertexId>(), report, context);
    for (const std::size_t level : way.targets) {
        reach(decimator, level, way, numbering, report, context);
        report.stop = report.levels.back().stop;
        const bool last = level == way.targets.back() || report.stop == SimplifyStop::cancelled;
        if (last) break;
        if (options.on_level) options.on_level(without_dead(mesh, numbering), report.levels.back());
    }
    report.collapses += decimator.counts().collapses;
}

SimplifyReport run(Mesh& mesh, const SimplifyOptions& options, ProgressiveMesh* record, const Context* context) {
    check_options(options);
    Recorder recorder;
    SimplifyReport report;
    report.input_vertices = mesh.vertex_count();
    const double diagonal = bounding_diagonal(mesh);
    const bool shakes = options.max_quadric_error_rel == 0 && options.placement == Placement::best;
    const std::vector<std::size_t> targets = find_targets(options, mesh);
    const Tuning tuning = tuning_for(options);
    Way way{.targets = targets,
            .tuning = tuning,
            .limits = {options.max_quadric_error_rel * diagonal, options.remesh.precision},
            .records = record != nullptr,
            .shakes = shakes && record == nullptr};
    const auto look_for_hubs = [&] {
        way.refits = options.refit && shakes && !has_hub(mesh);
        way.polishes = way.refits && record == nullptr;
    };
    look_for_hubs();
    std::optional<Before> before;
    if (!start(mesh, way, options, before, report, context)) {
        report.stop = is_cancelled(context) ? SimplifyStop::cancelled : SimplifyStop::not_delaunay;
        if (record != nullptr) *record = {mesh, {}};
        return report;
    }
    look_for_hubs();
    report.least_vertices = least_vertices(mesh);
    Numbering numbering(mesh);
    go_down(mesh, std::move(before), way, options, record != nullptr ? &recorder : nullptr, numbering, report, context);
    drop_isolated(mesh);
    CompactMap map = numbering.in_order_of_names(mesh);
    numbering.renumber(mesh, map);
    if (record != nullptr) *record = {mesh, recorder.steps(std::move(map.vertex), mesh.vertex_count())};
    if (options.on_level) options.on_level(mesh, report.levels.back());
    report_progress(context, "simplify", 1);
    return report;
}

/// Above so many vertices the copy that mending needs is not kept.
constexpr std::size_t most_mended = 100'000;

bool may_mend(const Mesh& mesh, const SimplifyOptions& options) {
    return options.placement == Placement::best && options.max_quadric_error_rel == 0 && options.levels.size() < 2 &&
           mesh.vertex_count() <= most_mended;
}

/// Where needles stand in each other's way, so that the usual way did not come to its only level. True if it is reached
/// now.
bool reach_by_mending(Mesh& mesh, const SimplifyOptions& options, SimplifyReport& report, const Context* context) {
    SimplifyOptions rest = options;
    rest.vertices = find_targets(options, mesh).front();
    rest.ratio = 0;
    rest.levels.clear();
    const std::size_t wanted = std::max(rest.vertices, least_vertices(mesh));
    if (!report.levels.empty() && report.levels.back().vertices <= wanted) return false;
    // Edges without length have no angles that could be wrong.
    if (!mend(mesh, tuning_for(options), options.remesh, wanted, context) || !certify(mesh, context).certified)
        return false;
    const std::size_t mended_to = mesh.vertex_count();
    SimplifyReport mended = run(mesh, rest, nullptr, context);
    if (mended.levels.empty() || mended.remesh || mended.levels.back().vertices > wanted) return false;
    mended.input_vertices = report.input_vertices;
    mended.remesh.emplace();
    mended.thinned_to = mended_to;
    report = std::move(mended);
    return true;
}

}  // namespace

SimplifyReport simplify(Mesh& mesh, const SimplifyOptions& options, const Context* context) {
    if (!may_mend(mesh, options)) return run(mesh, options, nullptr, context);
    SimplifyOptions silent = options;
    silent.on_level = nullptr;
    Mesh original = mesh;
    SimplifyReport report = run(mesh, silent, nullptr, context);
    const bool misses = report.stop == SimplifyStop::blocked || report.stop == SimplifyStop::not_delaunay;
    if (misses && report.remesh && reach_by_mending(original, silent, report, context)) mesh = std::move(original);
    if (options.on_level && !report.levels.empty()) options.on_level(mesh, report.levels.back());
    return report;
}

SimplifyReport simplify(Mesh& mesh, const SimplifyOptions& options, ProgressiveMesh& record, const Context* context) {
    return run(mesh, options, &record, context);
}

}  // namespace delmesh
