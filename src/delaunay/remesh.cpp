#include "delmesh/delaunay/remesh.hpp"

#include "delaunay/choose_splits.hpp"
#include "delaunay/classify.hpp"
#include "delaunay/clean.hpp"
#include "delaunay/features.hpp"
#include "delaunay/flip.hpp"
#include "delaunay/marked_mesh.hpp"
#include "delaunay/non_delaunay.hpp"
#include "delaunay/refine.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/mesh/rounding.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace delmesh {
namespace {

void check_options(const Mesh& mesh, const RemeshOptions& options) {
    if (!(options.shell_unit_abs > 0) || std::isinf(options.shell_unit_abs))
        throw Error(ErrorCode::bad_argument,
                    fmt::format("the shell unit must be a positive number, not {}", options.shell_unit_abs));
    if (!(options.feature_angle_deg >= 0 && options.feature_angle_deg <= 180))
        throw Error(
            ErrorCode::bad_argument,
            fmt::format("the feature angle must lie between 0 and 180 degrees, not at {}", options.feature_angle_deg));
    for (const auto& [a, b] : options.feature_edges) {
        if (a.index() < mesh.vertex_count() && b.index() < mesh.vertex_count() && mesh.are_joined(a, b)) continue;
        throw Error(
            ErrorCode::bad_argument,
            fmt::format("the feature edge between vertices {} and {} is no edge of the mesh", a.value(), b.value()),
            {a.index(), b.index()}, 1);
    }
    if (options.precision == Precision::float64) return;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3& p = mesh.points()[v];
        if (round_to_float(p) != p)
            throw Error(ErrorCode::bad_argument,
                        fmt::format("vertex {} is not a float; round the input first to remesh in float precision", v),
                        {v}, 1);
    }
}

}  // namespace

std::string_view name(StopReason reason) {
    switch (reason) {
        case StopReason::done:
            return "done";
        case StopReason::max_vertices:
            return "max_vertices";
        case StopReason::unresolved:
            return "unresolved";
        case StopReason::cancelled:
            return "cancelled";
    }
    return "unknown";
}

std::span<const std::string_view> choices(RemeshMode) {
    static constexpr std::string_view names[] = {"preserve", "flip", "feature"};
    return names;
}

std::span<const std::string_view> choices(FlipOrder) {
    static constexpr std::string_view names[] = {"worst", "fifo", "lifo"};
    return names;
}

std::span<const std::string_view> choices(FlipFinish) {
    static constexpr std::string_view names[] = {"keep-flipping", "literal"};
    return names;
}

std::span<const std::string_view> choices(SplitPlacement) {
    static constexpr std::string_view names[] = {"fewest", "shells"};
    return names;
}

namespace {

/// Rounds of removing what rounding has flattened and refining again.
constexpr int most_cleanings = 50;

/// Algorithm 1; where rounding has made edges without length or faces without area, these are taken away.
void refine_and_clean(MarkedMesh& marked, const RemeshOptions& options, const Context* context, RemeshReport& report,
                      const SplitPlanner& planner = {}) {
    refine(marked, options, context, report, planner);
    const std::size_t lower_bound = report.lower_bound;
    for (int round = 0; report.stop == StopReason::done; ++round) {
        const Cleaning cleaning = clean_up(marked, context);
        if (cleaning.changes == 0 && !cleaning.left) break;
        if (cleaning.changes == 0 || round == most_cleanings) {
            report.stop = StopReason::unresolved;
            report.witness = cleaning.left;
            break;
        }
        refine(marked, options, context, report);
    }
    report.lower_bound = lower_bound;
    report.splits = marked.split_count();
}

/// Algorithm 1 on a mesh without zero-area faces.
void preserve_surface(Mesh& mesh, const RemeshOptions& options, const Context* context, RemeshReport& report,
                      const SplitPlanner& planner = {}) {
    std::vector<Mark> marks = mark_edges(mesh, context);
    std::vector<FaceId> facets = find_facets(mesh, marks);
    std::vector<FaceId> input_facets = facets;
    MarkedMesh marked(mesh, std::move(marks), std::move(facets));
    refine_and_clean(marked, options, context, report, planner);
    report.provenance = marked.take_provenance();
    report.provenance.facet_of_input_face = std::move(input_facets);
}

/// Searches for better places than the shells, which are kept where the search is not better.
void preserve_with_fewest(Mesh& mesh, const RemeshOptions& options, const Context* context, RemeshReport& report) {
    Mesh by_shells = mesh;
    RemeshReport shells = report;
    preserve_surface(by_shells, options, context, shells);
    const bool usable = shells.stop == StopReason::done;
    const std::size_t splits_by_shells = usable ? shells.splits : 0;
    if (shells.stop == StopReason::cancelled || (usable && shells.splits == shells.lower_bound)) {
        mesh = std::move(by_shells);
        report = std::move(shells);
        return;
    }
    const SplitPlanner planner = [&](const MarkedMesh& marked, std::span<const EdgeId> bad) {
        std::vector<SplitPoint> baseline;
        if (usable) baseline = shells.provenance.splits;
        return choose_splits(marked, bad, baseline, {static_cast<int>(options.effort), options.seed}, context);
    };
    preserve_surface(mesh, options, context, report, planner);
    if (usable && report.stop != StopReason::cancelled &&
        (report.stop != StopReason::done || report.splits >= shells.splits)) {
        mesh = std::move(by_shells);
        report = std::move(shells);
    }
    report.splits_by_shells = splits_by_shells;
}

/// Algorithm 2 and section 6: flips, then Algorithm 1 for what is left, with all vertices of that moment as input.
void flip_surface(Mesh& mesh, const RemeshOptions& options, const Context* context, RemeshReport& report) {
    const bool features = options.mode == RemeshMode::feature;
    MarkedMesh flipping(
        mesh,
        mark_features(mesh, features ? options.feature_angle_deg : 180,
                      features ? options.feature_edges : std::vector<std::array<VertexId, 2>>{}, context),
        {});
    flip_edges(flipping, features, options, context, report);
    Cleaning cleaning;
    for (int round = 0; round < most_cleanings && report.stop == StopReason::done; ++round) {
        cleaning = clean_up(flipping, context);
        if (cleaning.changes == 0) break;
        flip_edges(flipping, features, options, context, report);
    }
    report.splits = flipping.split_count();
    report.provenance = flipping.take_provenance();
    if (report.stop != StopReason::done) return;
    if (cleaning.changes == 0 && !cleaning.left && find_non_delaunay(mesh, context).empty()) return;

    RemeshReport rest;
    MarkedMesh refining(mesh, mark_edges(mesh, context), {});
    refine_and_clean(refining, options, context, rest);
    report.stop = rest.stop;
    report.witness = rest.witness;
    report.flips += rest.flips;
    report.splits += rest.splits;
    report.splits_boundary += rest.splits_boundary;
    report.splits_unflippable += rest.splits_feature + rest.splits_unflippable;
    const std::vector<SplitPoint> more = refining.take_provenance().splits;
    report.provenance.splits.insert(report.provenance.splits.end(), more.begin(), more.end());
}

/// The mode that an angle of 0 or 180 degrees comes down to.
RemeshMode effective_mode(const RemeshOptions& options) {
    if (options.mode != RemeshMode::feature) return options.mode;
    if (options.feature_angle_deg == 0) return RemeshMode::preserve;
    return options.feature_angle_deg == 180 && options.feature_edges.empty() ? RemeshMode::flip : RemeshMode::feature;
}

}  // namespace

RemeshReport make_delaunay(Mesh& mesh, const RemeshOptions& options, const Context* context) {
    check_options(mesh, options);
    RemeshOptions effective = options;
    effective.mode = effective_mode(options);
    report_progress(context, "classify", 0);
    RemeshReport report;
    report.flips = remove_caps(mesh, context);
    if (effective.mode == RemeshMode::preserve && effective.placement == SplitPlacement::fewest) {
        preserve_with_fewest(mesh, effective, context, report);
    } else if (effective.mode == RemeshMode::preserve) {
        preserve_surface(mesh, effective, context, report);
    } else {
        flip_surface(mesh, effective, context, report);
    }
    report_progress(context, "remesh", 1);
    return report;
}

}  // namespace delmesh
