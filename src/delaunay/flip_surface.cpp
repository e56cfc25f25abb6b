#include "delaunay/flip_surface.hpp"

#include "delaunay/classify.hpp"
#include "delaunay/clean.hpp"
#include "delaunay/features.hpp"
#include "delaunay/fewest.hpp"
#include "delaunay/flat_caps.hpp"
#include "delaunay/flat_rule.hpp"
#include "delaunay/flip.hpp"
#include "delaunay/marked_mesh.hpp"
#include "delaunay/non_delaunay.hpp"
#include "delaunay/refine.hpp"
#include "delaunay/unit_frame.hpp"
#include "delaunay/vertex_limit.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace delmesh {
namespace {

/// Rounds of removing what rounding has flattened and flipping again.
constexpr int most_cleanings = 50;
/// Rounds of flipping caps that other flips have left.
constexpr int most_cap_rounds = 3;

std::vector<Mark> marks_for(const Mesh& mesh, const RemeshOptions& options, const Context* context) {
    if (options.mode == RemeshMode::flip) return mark_features(mesh, 180, {}, context);
    return mark_features(mesh, options.feature_angle_deg, options.feature_edges, context);
}

/// Flips, and where asked for splits, until nothing more can be done that way. Returns what is left by rounding.
Cleaning flip_and_clean(MarkedMesh& marked, bool split_features, const RemeshOptions& options, const Context* context,
                        RemeshReport& report) {
    flip_edges(marked, split_features, options, context, report);
    Cleaning cleaning;
    for (int round = 0; round < most_cleanings && report.stop == StopReason::done; ++round) {
        cleaning = clean_up(marked, context);
        if (cleaning.changes == 0) break;
        flip_edges(marked, split_features, options, context, report);
    }
    return cleaning;
}

/// Flips of other edges leave new caps, and rounding leaves some of these so flat that creases there have no room to be
/// split. `allowed`: in each round, in the frame.
void flip_caps_again(MarkedMesh& marked, double allowed, const RemeshOptions& options, const Context* context,
                     RemeshReport& report, Cleaning& cleaning) {
    const UnitFrame frame = unit_frame(marked.mesh());
    for (int round = 0; round < most_cap_rounds && report.stop == StopReason::done; ++round) {
        const FlatCaps caps = flip_flat_caps(marked, frame, allowed, context);
        if (caps.flips == 0) return;
        report.flips += caps.flips;
        report.flat_tolerance += frame.length(allowed);
        report.max_deviation += frame.length(caps.moved);
        cleaning = flip_and_clean(marked, false, options, context, report);
    }
}

/// Edges by their ends, smaller vertex first, sorted.
using Ends = std::vector<std::array<VertexId, 2>>;

Ends ends_of_features(const MarkedMesh& marked) {
    const Mesh& mesh = marked.mesh();
    Ends ends;
    for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        const HalfedgeId t = mesh.twin(h);
        if (marked.is_planar(h) || !t.valid() || t < h) continue;
        ends.push_back({std::min(mesh.origin(h), mesh.target(h)), std::max(mesh.origin(h), mesh.target(h))});
    }
    std::sort(ends.begin(), ends.end());
    return ends;
}

/// Marks for Algorithm 1 after the flips: features that lie in a plane are still not flipped.
std::vector<Mark> marks_for_splitting(const MarkedMesh& flipped, const Context* context) {
    std::vector<Mark> marks = mark_edges(flipped.mesh(), context);
    for (std::size_t i = 0; i < marks.size(); ++i)
        if (!flipped.is_planar(HalfedgeId(i))) marks[i] = Mark::physical;
    return marks;
}

/// Adds what Algorithm 1 did after the flips.
void add(RemeshReport& report, const RemeshReport& rest, const std::vector<SplitPoint>& splits, const Ends& features) {
    const auto of_features =
        static_cast<std::size_t>(std::count_if(splits.begin(), splits.end(), [&](const SplitPoint& s) {
            return std::binary_search(features.begin(), features.end(), std::array{s.a, s.b});
        }));
    report.stop = rest.stop;
    report.witness = rest.witness;
    report.endless = rest.endless;
    report.flips += rest.flips;
    report.splits += rest.splits;
    report.splits_boundary += rest.splits_boundary;
    report.splits_feature += of_features;
    report.splits_unflippable += rest.splits - rest.splits_boundary - of_features;
    report.provenance.splits.insert(report.provenance.splits.end(), splits.begin(), splits.end());
}

enum class Way {
    published,  ///< features are split as they come up, at shells
    patient,    ///< flips alone first, so that no feature is split that a flip beside it would save; then a search
};

/// Flips; then Algorithm 1 for what is left, with all vertices of that moment as input. `spare`: see
/// `preserve_with_fewest`. `caps`: that patient flips may take away, no higher than this in the frame.
void flip_surface(Mesh& mesh, Way way, const RemeshOptions& options, const Context* context, RemeshReport& report,
                  Mesh* spare = nullptr, double caps = 0) {
    const bool patient = way == Way::patient;
    RemeshOptions flips = options;
    if (patient) flips.finish = FlipFinish::literal;
    MarkedMesh flipping(mesh, marks_for(mesh, options, context), {});
    const bool split_features = options.mode == RemeshMode::feature && !patient;
    Cleaning cleaning = flip_and_clean(flipping, split_features, flips, context, report);
    if (patient && caps > 0) flip_caps_again(flipping, caps, flips, context, report, cleaning);
    report.splits = flipping.split_count();
    if (report.stop == StopReason::done &&
        (cleaning.changes > 0 || cleaning.left || !find_non_delaunay(mesh, context).empty())) {
        std::vector<Mark> marks = marks_for_splitting(flipping, context);
        const Ends features = ends_of_features(flipping);
        report.provenance = flipping.take_provenance();
        std::vector<FaceId> facets = find_facets(mesh, marks);
        MarkedMesh splitting(mesh, std::move(marks), std::move(facets));
        RemeshReport rest;
        RefineStart start = flip_planar_edges(splitting, options, context, rest);
        if (patient && !start.bad.empty()) {
            preserve_with_fewest(splitting, options, context, rest, start, false, spare);
        } else {
            splitting.reserve_splits(6 * start.bad.size());
            refine_and_clean(splitting, options, context, rest, std::move(start.queue));
        }
        add(report, rest, splitting.take_provenance().splits, features);
    } else {
        report.provenance = flipping.take_provenance();
    }
}

struct Attempt {
    Mesh mesh;
    RemeshReport report;
    bool wants_more_splits = false;

    [[nodiscard]] bool done() const { return report.stop == StopReason::done; }
    [[nodiscard]] bool cancelled() const { return report.stop == StopReason::cancelled; }
};

/// `most_splits` over and above the limit in the options.
Attempt attempt(Mesh mesh, Way way, std::size_t most_splits, const RemeshOptions& options, const Context* context,
                const RemeshReport& so_far, double caps) {
    const RemeshOptions bounded = with_at_most(options, mesh.vertex_count() + most_splits);
    Attempt result{std::move(mesh), so_far};
    flip_surface(result.mesh, way, bounded, context, result.report, nullptr, caps);
    return result;
}

/// The better of the two ways, the patient one if neither ends: what has exploded is not kept meanwhile. The mesh stays
/// as it is only if neither ends, and only if it is `needed`.
Attempt better_way(Mesh& mesh, bool needed, std::size_t most_splits, const RemeshOptions& options,
                   const Context* context, const RemeshReport& so_far, double caps = 0) {
    Attempt published = attempt(mesh, Way::published, most_splits, options, context, so_far, caps);
    if (published.cancelled() || (published.done() && published.report.splits == 0)) return published;
    if (!published.done()) {
        const StopReason stop = published.report.stop;
        published = {};
        Attempt patient =
            attempt(needed ? mesh : std::move(mesh), Way::patient, most_splits, options, context, so_far, caps);
        patient.wants_more_splits = (patient.report.endless ? stop : patient.report.stop) == StopReason::max_vertices;
        return patient;
    }
    // One of the two is the result, so the input is needed no more, and a copy would be one mesh too many.
    RemeshReport patient = so_far;
    const RemeshOptions fewer = with_at_most(options, mesh.vertex_count() + published.report.splits - 1);
    flip_surface(mesh, Way::patient, fewer, context, patient, &published.mesh, caps);
    if (patient.stop == StopReason::done || patient.stop == StopReason::cancelled) {
        published.mesh = std::move(mesh);
        published.report = std::move(patient);
    }
    return published;
}

/// How high a face may be, in the frame, to lose its long side whatever lies there; 0 where none may.
double cap_tolerance(const Mesh& mesh, const UnitFrame& frame, const RemeshOptions& options, const Context* context) {
    const bool may_flatten = options.mode == RemeshMode::feature && options.feature_edges.empty() &&
                             options.flat_tolerance_rel.rule == FlatRule::automatic;
    const double tolerance = may_flatten ? stored_tolerance(mesh, frame) : 0;
    return tolerance > 0 && is_mostly_rounding(mesh, frame, tolerance, context) ? tolerance : 0;
}

/// Where most of what fails is needles that rounding has made, they lose their long sides first, features or not. Not
/// done elsewhere.
Attempt without_flat_caps(const Mesh& mesh, std::size_t most_splits, const RemeshOptions& options,
                          const Context* context, const RemeshReport& so_far) {
    const UnitFrame frame = unit_frame(mesh);
    const double tolerance = cap_tolerance(mesh, frame, options, context);
    Attempt result{{}, so_far};
    result.report.stop = StopReason::unresolved;
    if (!(tolerance > 0)) return result;
    Mesh flattened = mesh;
    const FlatCaps caps = flip_flat_caps(flattened, frame, tolerance, context);
    if (caps.flips == 0) return result;
    result = better_way(flattened, false, most_splits, options, context, so_far, tolerance);
    result.report.flips += caps.flips;
    result.report.flat_tolerance += frame.length(tolerance);
    result.report.max_deviation += frame.length(caps.moved);
    return result;
}

/// Needles that rounding has made are to cost no thousands of splits where hardly any are needed without them.
constexpr std::size_t most_beside(std::size_t splits_without_caps) {
    return 1000 + 2 * splits_without_caps;
}

/// Edges in a plane fail by the thousand, and cost nothing.
std::size_t count_bent_non_delaunay(const Mesh& mesh, const Context* context) {
    const std::vector<HalfedgeId> found = find_non_delaunay(mesh, context);
    return static_cast<std::size_t>(std::count_if(found.begin(), found.end(), [&mesh](HalfedgeId h) {
        const HalfedgeId t = mesh.twin(h);
        return !t.valid() || !exact::is_planar_edge_inline(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)),
                                                           mesh.point(mesh.apex(h)), mesh.point(mesh.apex(t)));
    }));
}

/// Needles make any way explode, but seldom all: millions of splits are only tried if nothing else is left.
Attempt best_way(Mesh& mesh, const RemeshOptions& options, const Context* context, const RemeshReport& so_far) {
    const std::size_t few = 100'000 + 10 * std::min(mesh.vertex_count(), count_bent_non_delaunay(mesh, context));
    Attempt flattened = without_flat_caps(mesh, few, options, context, so_far);
    if (flattened.cancelled()) return flattened;
    const std::size_t most = flattened.done() ? most_beside(flattened.report.splits) : few;
    Attempt best = better_way(mesh, true, most, options, context, so_far);
    if (best.done() || best.cancelled()) return best;
    if (flattened.done()) return flattened;
    const bool limited = options.max_vertices != 0 && options.max_vertices <= mesh.vertex_count() + few;
    if (!best.wants_more_splits || limited) return best;
    best = {};
    return better_way(mesh, false, std::numeric_limits<std::uint32_t>::max(), options, context, so_far);
}

}  // namespace

std::size_t flip_alone(Mesh& mesh, const RemeshOptions& options, const Context* context) {
    RemeshOptions flips = options;
    flips.finish = FlipFinish::literal;
    RemeshReport report;
    report.flips = remove_caps(mesh, context);
    const UnitFrame frame = unit_frame(mesh);
    const double tolerance = cap_tolerance(mesh, frame, options, context);
    if (tolerance > 0) report.flips += flip_flat_caps(mesh, frame, tolerance, context).flips;
    MarkedMesh flipping(mesh, marks_for(mesh, options, context), {});
    flip_edges(flipping, false, flips, context, report);
    return report.flips;
}

void flip_surface(Mesh& mesh, const RemeshOptions& options, const Context* context, RemeshReport& report) {
    if (options.placement == SplitPlacement::shells)
        return flip_surface(mesh, Way::published, options, context, report);
    Attempt best = best_way(mesh, options, context, report);
    mesh = std::move(best.mesh);
    report = std::move(best.report);
}

}  // namespace delmesh
