#include "delmesh/delaunay/remesh.hpp"

#include "delaunay/classify.hpp"
#include "delaunay/clean.hpp"
#include "delaunay/features.hpp"
#include "delaunay/flip.hpp"
#include "delaunay/marked_mesh.hpp"
#include "delaunay/non_delaunay.hpp"
#include "delaunay/preserve.hpp"
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
    const FlatTolerance& flat = options.flat_tolerance_rel;
    if (flat.rule == FlatRule::given && !(flat.number >= 0 && flat.number <= 0.01))
        throw Error(
            ErrorCode::bad_argument,
            fmt::format("the flat tolerance must lie between 0 and 0.01 of the diagonal, not at {}", flat.number));
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

std::span<const std::string_view> choices(FlatRule) {
    static constexpr std::string_view names[] = {"auto", "stored", "given"};
    return names;
}

namespace {

/// Rounds of removing what rounding has flattened and flipping again.
constexpr int most_cleanings = 50;

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
    RefineStart start = flip_planar_edges(refining, options, context, rest);
    refining.reserve_splits(6 * start.bad.size());
    refine_and_clean(refining, options, context, rest, std::move(start.queue));
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
    if (effective.mode == RemeshMode::preserve) {
        preserve(mesh, effective, context, report);
    } else {
        flip_surface(mesh, effective, context, report);
    }
    report_progress(context, "remesh", 1);
    return report;
}

}  // namespace delmesh
