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

/// Where remeshing stops short or more than doubles the vertices, the mesh is thinned out to so many times those asked
/// for first.
constexpr std::size_t thin_from = 2;
/// More points than that, or than there are vertices, and a search pays.
constexpr std::size_t many_points = 20'000;
/// Tried where the angle asked for needs too many vertices; after that all edges may flip.
constexpr double wider_angle_deg = 45;

struct Remeshed {
    Mesh mesh;
    RemeshReport report;

    [[nodiscard]] bool done() const { return report.stop == StopReason::done; }
    [[nodiscard]] bool cancelled() const { return report.stop == StopReason::cancelled; }
};

Remeshed remeshed(const Mesh& mesh, const RemeshOptions& options, const Context* context) {
    Remeshed result{mesh, {}};
    result.report = make_delaunay(result.mesh, options, context);
    return result;
}

/// With no more points than can be of use where there is another way: they would only take their memory.
RemeshOptions with_few_more(const RemeshOptions& options, std::size_t vertices) {
    return with_at_most(options, vertices + std::max(many_points, vertices));
}

/// Points by shells are as good as any where they are few, since most go again; where they are many they stand in each
/// other's way, and a search for fewer pays (unless there are so many that it would take longer than all the rest).
Remeshed with_few_points(const Mesh& mesh, const RemeshOptions& options, const Context* context) {
    if (options.placement == SplitPlacement::shells) return remeshed(mesh, options, context);
    const std::size_t vertices = mesh.vertex_count();
    RemeshOptions shells = with_few_more(options, vertices);
    shells.placement = SplitPlacement::shells;
    {
        Remeshed by_shells = remeshed(mesh, shells, context);
        const std::size_t splits = by_shells.report.splits;
        const bool is_enough = splits <= vertices / 10 || splits > many_points;
        if (by_shells.cancelled() || (by_shells.done() && is_enough)) return by_shells;
    }
    return remeshed(mesh, options, context);
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

double wider(double angle_deg) {
    return angle_deg < wider_angle_deg ? wider_angle_deg : 180;
}

/// Sharper edges than asked for are flipped where keeping them needs too many vertices.
Remeshed with_wider_angles(const Mesh& mesh, RemeshOptions options, double& angle_deg, const Context* context) {
    for (;;) {
        angle_deg = options.feature_angle_deg;
        Remeshed result = with_few_points(mesh, options, context);
        if (result.done() || result.cancelled() || options.mode != RemeshMode::feature || angle_deg >= 180)
            return result;
        options.feature_angle_deg = wider(angle_deg);
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

RemeshOptions start_options(const Mesh& mesh, const SimplifyOptions& options) {
    RemeshOptions how = options.remesh;
    if (options.wider_angle_on_noise && how.mode == RemeshMode::feature && is_large_and_noisy(mesh))
        how.feature_angle_deg = std::min(180.0, 2 * how.feature_angle_deg);
    return how;
}

bool make_start_delaunay(Mesh& mesh, RemeshOptions how, const Tuning& tuning, const StartLimits& limits,
                         SimplifyReport& report, const Context* context) {
    if (certify(mesh, context).certified) return true;
    const auto take = [&](Remeshed&& result, double angle_deg, std::size_t thinned_to) {
        mesh = std::move(result.mesh);
        report.remesh = std::move(result.report);
        report.remesh_angle_deg = angle_deg;
        report.thinned_to = thinned_to;
        if (report.remesh->stop != StopReason::done) return false;
        report.remesh->provenance = {};  // of vertices that are going to vanish
        return true;
    };
    const std::size_t vertices = mesh.vertex_count();
    const bool may_thin = limits.may_thin && thin_from * limits.vertices < vertices;
    const RemeshOptions few = may_thin ? with_few_more(how, vertices) : how;
    Remeshed first = with_few_points(mesh, few, context);
    if (first.cancelled() || (first.done() && (first.report.splits <= vertices || !may_thin)))
        return take(std::move(first), how.feature_angle_deg, 0);
    if (!may_thin) {  // the same angle would fail again
        if (how.mode != RemeshMode::feature || how.feature_angle_deg >= 180)
            return take(std::move(first), how.feature_angle_deg, 0);
        how.feature_angle_deg = wider(how.feature_angle_deg);
    }
    if (!first.done()) first.mesh = {};
    const bool is_cut_short = !first.done() && few.max_vertices != how.max_vertices;
    const Mesh original = is_cut_short ? mesh : Mesh();

    if (may_thin) thin_out(mesh, tuning, how.precision, thin_from * limits.vertices, context);
    const std::size_t thinned_to = may_thin ? mesh.vertex_count() : 0;
    double angle_deg = 0;
    Remeshed second = with_wider_angles(mesh, how, angle_deg, context);
    const bool is_worse = !second.done() || second.mesh.vertex_count() > few.max_vertices;
    if (is_cut_short && is_worse && !second.cancelled()) first = with_few_points(original, how, context);
    if (first.done() && !(second.done() && second.mesh.vertex_count() < first.mesh.vertex_count()))
        return take(std::move(first), how.feature_angle_deg, 0);
    return take(std::move(second), angle_deg, thinned_to);
}

}  // namespace delmesh
