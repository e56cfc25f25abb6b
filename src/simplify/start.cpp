#include "simplify/start.hpp"

#include "delaunay/vertex_limit.hpp"
#include "delmesh/measure/certificate.hpp"
#include "delmesh/mesh/edits.hpp"
#include "simplify/decimator.hpp"
#include "simplify/numbering.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace delmesh {
namespace {

/// Where remeshing needs too many vertices, a mesh is thinned out to so many times the vertices asked for first.
constexpr std::size_t thin_from = 2;
/// Tried where the angle asked for needs too many vertices; after that all edges may flip.
constexpr double wider_angle_deg = 45;

bool is_over(const RemeshReport& report) {
    return report.stop == StopReason::done || report.stop == StopReason::cancelled;
}

/// The mesh stays as it is where that stops short.
RemeshReport try_remesh(Mesh& mesh, const RemeshOptions& options, const Context* context) {
    Mesh attempt = mesh;
    RemeshReport report = make_delaunay(attempt, options, context);
    if (is_over(report)) mesh = std::move(attempt);
    return report;
}

/// Points by shells are as good as any where they are few, since most go again; where they are many they stand in each
/// other's way, and a search for fewer pays (unless there are so many that it would take longer than all the rest).
RemeshReport remesh(Mesh& mesh, const RemeshOptions& options, const Context* context) {
    if (options.placement == SplitPlacement::shells) return try_remesh(mesh, options, context);
    constexpr std::size_t searched_for = 20'000;
    const std::size_t vertices = mesh.vertex_count();
    RemeshOptions shells = with_at_most(options, vertices + std::max(searched_for, vertices));
    shells.placement = SplitPlacement::shells;
    {
        Mesh by_shells = mesh;
        RemeshReport report = make_delaunay(by_shells, shells, context);
        const bool is_enough = report.splits <= vertices / 10 || report.splits > searched_for;
        if (report.stop == StopReason::cancelled || (report.stop == StopReason::done && is_enough)) {
            mesh = std::move(by_shells);
            return report;
        }
    }
    return try_remesh(mesh, options, context);
}

/// Whether more than a quarter of the edges are sharper than 15 degrees, where there are so many that this must be
/// noise.
bool is_large_and_noisy(const Mesh& mesh) {
    constexpr std::size_t large = 100'000;
    constexpr std::size_t looked_at = 100'000;
    constexpr double cosine = 0.9659258262890683;
    if (mesh.vertex_count() < large) return false;
    const double scale = local_scale(mesh);
    const auto normal_of = [&](HalfedgeId h) {
        const Frame frame{scale, 1 / scale, mesh.point(mesh.origin(h))};
        return cross(frame.to_local(mesh.point(mesh.target(h))), frame.to_local(mesh.point(mesh.apex(h))));
    };
    std::size_t edges = 0;
    std::size_t sharp = 0;
    for (std::size_t i = 0; i < mesh.halfedge_count(); i += 1 + mesh.halfedge_count() / looked_at) {
        const HalfedgeId h(i);
        if (mesh.is_boundary(h)) continue;
        const Vec3 n = normal_of(h);
        const Vec3 m = normal_of(mesh.twin(h));
        ++edges;
        if (dot(n, m) < cosine * std::sqrt(squared_norm(n) * squared_norm(m))) ++sharp;
    }
    return sharp > edges / 4;
}

/// Sharper edges than asked for are flipped where keeping them needs too many vertices.
RemeshReport remesh_with_wider_angles(Mesh& mesh, RemeshOptions options, double& angle_deg, const Context* context) {
    for (;;) {
        angle_deg = options.feature_angle_deg;
        RemeshReport report = remesh(mesh, options, context);
        if (is_over(report) || options.mode != RemeshMode::feature || angle_deg >= 180) return report;
        options.feature_angle_deg = angle_deg < wider_angle_deg ? wider_angle_deg : 180;
    }
}

/// Collapses edges without a look at the Delaunay conditions: needles that are going to vanish anyhow need no points.
void thin_out(Mesh& mesh, Tuning tuning, Precision precision, std::size_t vertices, const Context* context) {
    tuning.constrained = false;
    Decimator(mesh, tuning, {0, precision}).run(vertices, context);
    drop_isolated(mesh);
    const Numbering numbering(mesh);
    renumber(mesh, numbering.in_order_of_names(mesh));
}

}  // namespace

void drop_isolated(Mesh& mesh) {
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.is_live(VertexId(v)) && !mesh.halfedge(VertexId(v)).valid()) remove_isolated(mesh, VertexId(v));
}

bool make_start_delaunay(Mesh& mesh, const SimplifyOptions& options, const Tuning& tuning, const StartLimits& limits,
                         SimplifyReport& report, const Context* context) {
    if (certify(mesh, context).certified) return true;
    RemeshOptions how = options.remesh;
    if (options.wider_angle_on_noise && how.mode == RemeshMode::feature && is_large_and_noisy(mesh))
        how.feature_angle_deg = std::min(180.0, 2 * how.feature_angle_deg);
    report.remesh_angle_deg = how.feature_angle_deg;
    report.remesh = remesh(mesh, how, context);
    if (is_over(*report.remesh)) return report.remesh->stop == StopReason::done;

    const std::size_t thin_until = thin_from * limits.vertices;
    if (limits.may_thin && thin_until < mesh.vertex_count()) {
        thin_out(mesh, tuning, how.precision, thin_until, context);
        report.thinned_to = mesh.vertex_count();
    }
    report.remesh = remesh_with_wider_angles(mesh, how, report.remesh_angle_deg, context);
    return report.remesh->stop == StopReason::done;
}

}  // namespace delmesh
