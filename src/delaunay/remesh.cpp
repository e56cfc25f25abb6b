#include "delmesh/delaunay/remesh.hpp"

#include "delaunay/classify.hpp"
#include "delaunay/marked_mesh.hpp"
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
    static constexpr std::string_view names[] = {"preserve"};
    return names;
}

RemeshReport make_delaunay(Mesh& mesh, const RemeshOptions& options, const Context* context) {
    check_options(mesh, options);
    report_progress(context, "classify", 0);
    RemeshReport report;
    report.flips = remove_caps(mesh, context);
    std::vector<Mark> marks = mark_edges(mesh, context);
    std::vector<FaceId> facets = find_facets(mesh, marks);
    std::vector<FaceId> input_facets = facets;

    report_progress(context, "remesh", 0);
    MarkedMesh marked(mesh, std::move(marks), std::move(facets));
    refine(marked, options, context, report);
    report.provenance = marked.take_provenance();
    report.provenance.facet_of_input_face = std::move(input_facets);
    report_progress(context, "remesh", 1);
    return report;
}

}  // namespace delmesh
