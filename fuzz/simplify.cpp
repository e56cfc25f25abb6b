// Soup -> repair -> build -> simplify -> certificate.

#include "delmesh/simplify/simplify.hpp"

#include "delmesh/measure/certificate.hpp"
#include "manifold.hpp"

namespace delmesh::fuzz {

std::vector<std::string> seeds() {
    std::vector<std::string> result;
    for (const std::string& seed : soup_seeds()) {
        for (const char target : {'\4', '\x0c', '\x83'}) result.push_back(target + seed);
    }
    return result;
}

}  // namespace delmesh::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace delmesh;
    fuzz::Bytes bytes(data, size);
    const std::uint8_t choice = bytes.byte();
    std::optional<Mesh> mesh = fuzz::repaired_mesh(bytes);
    if (!mesh) return 0;
    SimplifyOptions options;
    options.vertices = 1 + choice % 16;
    options.refit = (choice & 16) != 0;
    options.placement = (choice & 32) != 0 ? Placement::paper : Placement::best;
    options.feature_angle_deg = (choice & 64) != 0 ? 30 : 180;
    if (choice & 128) options.remesh.mode = RemeshMode::preserve;
    options.remesh.effort = 0;
    options.remesh.max_vertices = mesh->vertex_count() + 200;
    const SimplifyReport report = simplify(*mesh, options);
    fuzz::require(validate(*mesh).empty(), "a simplified mesh is valid", validate(*mesh));
    if (report.stop != SimplifyStop::not_delaunay)
        fuzz::require(certify(*mesh).certified, "a simplified mesh is Delaunay", std::string(name(report.stop)));
    if (report.stop == SimplifyStop::done)
        fuzz::require(mesh->vertex_count() <= options.vertices, "done means that the target is reached");
    return 0;
}
