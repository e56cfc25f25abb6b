#include "delaunay/preserve.hpp"

#include "delaunay/classify.hpp"
#include "delaunay/features.hpp"
#include "delaunay/fewest.hpp"
#include "delaunay/flat_caps.hpp"
#include "delaunay/flat_facets.hpp"
#include "delaunay/flat_rule.hpp"
#include "delaunay/marked_mesh.hpp"
#include "delaunay/refine.hpp"
#include "delaunay/split_bound.hpp"
#include "delaunay/unit_frame.hpp"
#include "delmesh/exact/predicates.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace delmesh {
namespace {

/// The mesh ready for Algorithm 1: edges that are planar within a tolerance are marked so.
struct Classified {
    MarkedMesh marked;
    std::vector<FaceId> input_facets;
    FlatCaps caps;
};

Classified classify(Mesh& mesh, const UnitFrame& frame, double tolerance, const Context* context) {
    // One half for caps, one for facets.
    const FlatCaps caps = flip_flat_caps(mesh, frame, tolerance / 2, context);
    std::vector<Mark> marks = mark_edges(mesh, context);
    std::vector<FaceId> facets = find_facets(mesh, marks);
    FlatFacets flat = join_flat_facets(mesh, frame, tolerance / 2, marks, facets, context);
    std::vector<FaceId> input_facets = facets;
    MarkedMesh marked(mesh, std::move(marks), std::move(facets));
    marked.set_flat_facets(std::move(flat));
    return {std::move(marked), std::move(input_facets), caps};
}

/// What the placements add for each edge that must be split, on scans; docs/remesh.md has numbers.
double splits_per_edge(SplitPlacement placement) {
    return placement == SplitPlacement::shells ? 5 : 1.5;
}

GrowthEstimate estimate_growth(const Mesh& mesh, std::span<const EdgeId> bad, const RemeshOptions& options) {
    const double cosine = cosine_of_degrees(options.feature_angle_deg);
    const auto is_sharp = [&](EdgeId e) {
        const HalfedgeId h = Mesh::halfedge(e);
        const HalfedgeId t = mesh.twin(h);
        return !t.valid() ||
               dihedral_sign(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.apex(h)),
                             mesh.point(mesh.apex(t)), cosine) == Sign::negative;
    };
    GrowthEstimate growth;
    growth.vertices = mesh.vertex_count();
    growth.lower_bound = bad.size();
    growth.sharp_edges = static_cast<std::size_t>(std::count_if(bad.begin(), bad.end(), is_sharp));
    growth.likely_splits =
        static_cast<std::size_t>(splits_per_edge(options.placement) * static_cast<double>(bad.size()));
    return growth;
}

/// Algorithm 1 on a mesh without zero-area faces, with a flat tolerance that is given.
void preserve_surface(Mesh& mesh, const RemeshOptions& options, const Context* context, RemeshReport& report,
                      bool has_other_way = false) {
    const UnitFrame frame = unit_frame(mesh);
    const double tolerance = options.flat_tolerance_rel.number * frame.diagonal;
    Classified classified = classify(mesh, frame, tolerance, context);
    MarkedMesh& marked = classified.marked;
    report.flips += classified.caps.flips;
    RefineStart start = flip_planar_edges(marked, options, context, report);
    if (options.on_growth) options.on_growth(estimate_growth(mesh, start.bad, options));
    if (options.bound) {
        report.lower_bound_strong = strong_lower_bound(marked, start.bad, bound_options(options), context);
    }
    if (options.placement == SplitPlacement::fewest && !start.bad.empty()) {
        preserve_with_fewest(marked, options, context, report, start, has_other_way);
    } else {
        marked.reserve_splits(6 * start.bad.size());
        refine_and_clean(marked, options, context, report, std::move(start.queue));
    }
    report.flat_tolerance = frame.length(tolerance);
    report.max_deviation = frame.length(classified.caps.moved + marked.flattened());
    report.provenance = marked.take_provenance();
    report.provenance.facet_of_input_face = std::move(classified.input_facets);
}

RemeshOptions within(const RemeshOptions& options, double tolerance_rel) {
    RemeshOptions result = options;
    result.flat_tolerance_rel = {FlatRule::given, tolerance_rel};
    return result;
}

/// The edges that must be split where edges within the tolerance count as planar.
std::size_t bound_within(Mesh mesh, const UnitFrame& frame, double tolerance, const Context* context) {
    Classified classified = classify(mesh, frame, tolerance, context);
    RemeshReport report;
    return flip_planar_edges(classified.marked, {}, context, report).bad.size();
}

/// With so many edges to be split, what explodes and has had a third of what it may take is not followed to its end.
constexpr std::size_t many_edges = 10'000;
constexpr std::size_t thirds = 3;

/// FlatRule::automatic: the surface is kept exactly, unless that fails where rounding is what stands in the way.
void preserve_automatically(Mesh& mesh, const RemeshOptions& options, const Context* context, RemeshReport& report) {
    RemeshOptions exact = within(options, 0);
    const UnitFrame frame = unit_frame(mesh);
    const double stored = stored_tolerance(mesh, frame);
    if (!is_mostly_rounding(mesh, frame, stored, context)) return preserve_surface(mesh, exact, context, report);
    if (options.on_growth) {
        const std::size_t bound_if_flat = bound_within(mesh, frame, stored, context);
        exact.on_growth = [&options, bound_if_flat](GrowthEstimate growth) {
            growth.lower_bound_if_flat = bound_if_flat;
            options.on_growth(growth);
        };
    }
    // Explosions take time and memory: they are followed to their end only if the other way fails as well.
    const Mesh original = mesh;
    const RemeshReport before = report;
    const auto is_over = [&] { return report.stop == StopReason::done || report.stop == StopReason::cancelled; };
    const auto start_again = [&] {
        // Moved, which gives back the room that the explosion took.
        mesh = Mesh(original);
        report = RemeshReport(before);
    };
    preserve_surface(mesh, exact, context, report, true);
    if (is_over()) return;
    const std::size_t bad = report.lower_bound;
    const std::size_t enough = original.vertex_count() + thirds * few_splits(bad, true);
    start_again();
    preserve_surface(mesh, within(options, stored / frame.diagonal), context, report);
    if (is_over()) return;
    if (bad >= many_edges && options.max_vertices != 0 && options.max_vertices < enough) return;
    start_again();
    preserve_surface(mesh, exact, context, report);
}

}  // namespace

void preserve(Mesh& mesh, const RemeshOptions& options, const Context* context, RemeshReport& report) {
    switch (options.flat_tolerance_rel.rule) {
        case FlatRule::automatic:
            return preserve_automatically(mesh, options, context, report);
        case FlatRule::stored: {
            const UnitFrame frame = unit_frame(mesh);
            const double stored = frame.diagonal > 0 ? stored_tolerance(mesh, frame) / frame.diagonal : 0;
            return preserve_surface(mesh, within(options, stored), context, report);
        }
        case FlatRule::given:
            return preserve_surface(mesh, options, context, report);
    }
}

}  // namespace delmesh
