// delmesh stats IN...: the columns of the paper's Table 1.

#include "commands.hpp"
#include "exit_code.hpp"
#include "input.hpp"
#include "mesh_json.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace delmesh::app {
namespace {

std::string table(const std::vector<std::string>& paths, const std::vector<Measured>& meshes) {
    std::vector<std::vector<std::string>> rows{{"mesh", "#V", "#E", "#F", "boundary", "non-Delaunay", "min angle",
                                                "max angle", "% small", "% large", "Delaunay"}};
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const Measured& m = meshes[i];
        rows.push_back({std::filesystem::path(paths[i]).filename().string(), with_commas(m.size.vertices),
                        with_commas(m.size.edges), with_commas(m.size.faces), with_commas(m.size.boundary_edges),
                        with_commas(m.certificate.non_delaunay_edges + m.certificate.obtuse_boundary_edges),
                        fmt::format("{:.4g}", m.angles.min_angle_deg), fmt::format("{:.4g}", m.angles.max_angle_deg),
                        fmt::format("{:.2f}", m.angles.small_angles_percent),
                        fmt::format("{:.2f}", m.angles.large_angles_percent), m.certificate.certified ? "yes" : "no"});
    }
    return format_table(rows);
}

int run_stats(const std::vector<std::string>& paths, const InputOptions& input, Console& console) {
    std::vector<Measured> meshes;
    Json list = Json::array();
    for (const std::string& path : paths) {
        const Mesh mesh = build_mesh(path, load_soup(path, input, console));
        meshes.push_back(measure(mesh, console.context()));
        list.push_back({{"path", path}});
        list.back().update(to_json(meshes.back()));
    }
    Json json;
    if (list.size() == 1) json = list[0];
    json["meshes"] = std::move(list);
    if (console.wants_json()) console.print(json);
    console.tell(table(paths, meshes));
    return exit_done;
}

}  // namespace

void add_stats_command(CLI::App& app, Action& action) {
    CLI::App* command =
        add_command(app, action, "stats", "Print size, angle statistics and Delaunay state, a row for each mesh",
                    "delmesh stats before.ply after.ply");
    const auto paths = std::make_shared<std::vector<std::string>>();
    const auto input = std::make_shared<InputOptions>();
    command->add_option("IN", *paths, "Mesh files; -: standard input")->required();
    input->bind(*command);
    command->callback([&action, paths, input] {
        action.run = [paths, input](Console& console) { return run_stats(*paths, *input, console); };
    });
}

}  // namespace delmesh::app
