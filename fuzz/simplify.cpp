// Soup -> repair -> build -> simplify -> certificate.

#include "delmesh/simplify/simplify.hpp"

#include "delaunay/flip_surface.hpp"
#include "delmesh/measure/certificate.hpp"
#include "manifold.hpp"
#include "simplify/numbering.hpp"
#include "simplify/thinner.hpp"

#include <algorithm>

namespace delmesh::fuzz {
namespace {

/// What only large meshes go through.
void thin(std::size_t vertices, const RemeshOptions& remesh, Mesh mesh) {
    const bool is_delaunay = certify(mesh).certified;
    if (!is_delaunay) (void)flip_alone(mesh, remesh, nullptr);
    drop_isolated(mesh);
    Tuning tuning;
    tuning.constrained = is_delaunay;
    tuning.mending = is_delaunay ? Mending::off : Mending::no_more;
    Thinner thinner(mesh, tuning, Precision::float64);
    thinner.run(vertices, nullptr);
    require(validate(mesh).empty(), "a thinned mesh is valid", validate(mesh));
    require(!is_delaunay || certify(mesh).certified, "a thinned Delaunay mesh is Delaunay");
    const std::vector<VertexId> now = thinner.merged_into();
    const auto kept = static_cast<std::size_t>(std::count_if(
        now.begin(), now.end(), [&mesh](VertexId v) { return v.valid() && v.index() < mesh.vertex_count(); }));
    require(kept >= mesh.vertex_count(), "each vertex has come from somewhere");
}

void run(std::uint8_t choice, Mesh& mesh) {
    SimplifyOptions options;
    options.vertices = 1 + choice % 16;
    options.refit = (choice & 16) != 0;
    options.placement = (choice & 32) != 0 ? Placement::paper : Placement::best;
    options.feature_angle_deg = (choice & 64) != 0 ? 30 : 180;
    if (choice & 128) options.remesh.mode = RemeshMode::preserve;
    options.remesh.effort = 0;
    options.remesh.max_vertices = mesh.vertex_count() + 200;
    thin(options.vertices, options.remesh, mesh);
    const SimplifyReport report = simplify(mesh, options);
    require(validate(mesh).empty(), "a simplified mesh is valid", validate(mesh));
    if (report.stop != SimplifyStop::not_delaunay)
        require(certify(mesh).certified, "a simplified mesh is Delaunay", std::string(name(report.stop)));
    if (report.stop == SimplifyStop::done)
        require(mesh.vertex_count() <= options.vertices, "done means that the target is reached");
}

}  // namespace

std::vector<std::string> seeds() {
    std::vector<std::string> result;
    for (const std::string& seed : soup_seeds()) {
        for (const char target : {'\4', '\x0c', '\x83'}) result.push_back(target + seed);
    }
    return result;
}

}  // namespace delmesh::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return delmesh::fuzz::run_on_mesh(data, size, delmesh::fuzz::run);
}
