#include "delmesh/delaunay/remesh.hpp"

#include "delaunay/classify.hpp"
#include "delaunay/flip_surface.hpp"
#include "delaunay/preserve.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/mesh/rounding.hpp"

#include <fmt/format.h>

#include <cmath>

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
