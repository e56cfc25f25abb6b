// delmesh lod extract FILE OUT: any level of a progressive mesh.

#include "commands.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/io/lod_file.hpp"
#include "delmesh/io/write.hpp"
#include "exit_code.hpp"
#include "mesh_json.hpp"
#include "output_options.hpp"
#include "places.hpp"

#include <fmt/format.h>

#include <memory>

namespace delmesh::app {
namespace {

struct ExtractArguments {
    std::string input;
    OutputOptions output;
    std::size_t vertices = 0;
};

int run_extract(const ExtractArguments& arguments, Console& console) {
    const WriteOptions options = arguments.output.write_options();
    const ProgressiveMesh progressive = read_lod(arguments.input);
    if (arguments.vertices < progressive.least_vertices() || arguments.vertices > progressive.most_vertices())
        throw Error(ErrorCode::bad_argument,
                    fmt::format("{} holds meshes of {} to {} vertices, not of {}", arguments.input,
                                progressive.least_vertices(), progressive.most_vertices(), arguments.vertices));
    const Mesh mesh = progressive.at(arguments.vertices);
    const Measured measured = measure(mesh, console.context());
    if (*options.format == Format::stl) check_places(arguments.output.path, mesh);
    write_mesh(arguments.output.path, mesh, options);
    Json json{{"input", arguments.input},
              {"path", arguments.output.path},
              {"least_vertices", progressive.least_vertices()},
              {"most_vertices", progressive.most_vertices()}};
    json.update(to_json(measured));
    if (console.wants_json()) console.print(json);
    console.say(fmt::format("wrote {}: {}", arguments.output.path, verdict(measured)));
    return measured.certificate.certified ? exit_done : exit_does_not_hold;
}

}  // namespace

void add_lod_command(CLI::App& app, Action& action) {
    CLI::App* lod =
        app.add_subcommand("lod", "Work with progressive meshes (.dlod), made by `delmesh simplify --lod FILE`");
    lod->require_subcommand(1);
    lod->footer("Example:\n  delmesh lod extract bunny.dlod --vertices 1234 bunny-1234.ply");
    CLI::App* command = add_command(*lod, action, "extract", "Write the mesh with a given number of vertices",
                                    "delmesh lod extract bunny.dlod --vertices 1234 bunny-1234.ply");
    const auto arguments = std::make_shared<ExtractArguments>();
    command->add_option("FILE", arguments->input, "Progressive mesh")->required();
    command->add_option("OUT", arguments->output.path, "File to write")->required();
    command->add_option("--vertices", arguments->vertices, "How many")->required()->type_name("K");
    arguments->output.bind(*command);
    command->callback([&action, arguments] {
        action.run = [arguments](Console& console) { return run_extract(*arguments, console); };
    });
}

}  // namespace delmesh::app
