// Soup -> repair -> build -> remesh, in every mode -> certificate.

#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/measure/certificate.hpp"
#include "manifold.hpp"

#include <string>

namespace delmesh::fuzz {

namespace {

void remesh(Mesh mesh, const RemeshOptions& options) {
    const std::size_t before = mesh.vertex_count();
    const std::vector<Vec3> points(mesh.points().begin(), mesh.points().end());
    const RemeshReport report = make_delaunay(mesh, options);
    const std::string what = "mode " + std::to_string(static_cast<int>(options.mode)) + ": " +
                             std::string(name(report.stop)) + " after " + std::to_string(report.flips) + " flips, " +
                             std::to_string(report.splits) + " splits";
    require(validate(mesh).empty(), "a remeshed mesh is valid", what + ": " + validate(mesh));
    const Certificate certificate = certify(mesh);
    require(certificate.certified == (report.stop == StopReason::done), "done means certified, and only done does",
            what);
    require(mesh.vertex_count() == before + report.splits, "a split adds a vertex", what);
    require(mesh.vertex_count() <= options.max_vertices, "max_vertices is kept", what);
    for (std::size_t i = 0; i < before; ++i) require(mesh.points()[i] == points[i], "input vertices stay", what);
}

void run(std::uint8_t choice, const Mesh& mesh) {
    for (const RemeshMode mode : {RemeshMode::preserve, RemeshMode::flip, RemeshMode::feature}) {
        RemeshOptions options;
        options.mode = mode;
        options.feature_angle_deg = choice % 8 * 20.0;
        options.no_foldover = (choice & 8) != 0;
        options.finish = (choice & 16) != 0 ? FlipFinish::literal : FlipFinish::keep_flipping;
        options.order = static_cast<FlipOrder>((choice >> 5) % 3);
        options.max_vertices = mesh.vertex_count() + 300;
        options.placement = (choice & 4) != 0 ? SplitPlacement::shells : SplitPlacement::fewest;
        options.effort = choice >> 6 == 3 ? 1 : 0;
        remesh(mesh, options);
    }
}

}  // namespace

std::vector<std::string> seeds() {
    std::vector<std::string> result;
    for (const char choice : {'\0', '\xc0'})
        for (const std::string& seed : soup_seeds()) result.push_back(choice + seed);
    return result;
}

}  // namespace delmesh::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return delmesh::fuzz::run_on_mesh(data, size, delmesh::fuzz::run);
}
