// delmesh repair IN OUT: what was wrong, what was changed.

#include "commands.hpp"
#include "delmesh/io/write.hpp"
#include "exit_code.hpp"
#include "input.hpp"
#include "option_binding.hpp"
#include "output_options.hpp"

#include <fmt/format.h>

#include <memory>

namespace delmesh::app {
namespace {

struct RepairArguments {
    std::string input;
    OutputOptions output;
    RepairOptions options;
};

int run_repair(const RepairArguments& arguments, Console& console) {
    const WriteOptions options = arguments.output.write_options();
    Mended mended;
    const PolygonSoup soup =
        load_and_mend(arguments.input, arguments.options, arguments.output.precision(), console, mended);
    if (mended.report.cancelled) return console.interrupted();
    write_soup(output_path(arguments.output.path), soup, options);
    Json json{{"input", arguments.input},
              {"output", arguments.output.path},
              {"vertices", soup.points.size()},
              {"faces", soup.face_count()}};
    json.update(to_json(mended));
    json["options"] = options_to_json(arguments.options);
    json["peak_memory_bytes"] = peak_memory_bytes();
    if (console.wants_json()) console.print(json);
    console.tell(mended.changed()
                     ? fmt::format("{}: repaired\n{}", arguments.input, findings_text(arguments.input, mended))
                     : fmt::format("{}: nothing was wrong", arguments.input));
    console.say(fmt::format("wrote {}: {} vertices, {} faces", arguments.output.path, with_commas(soup.points.size()),
                            with_commas(soup.face_count())));
    return exit_done;
}

}  // namespace

void add_repair_command(CLI::App& app, Action& action) {
    CLI::App* command = add_command(app, action, "repair", "Make a manifold of any mesh, and tell what was wrong",
                                    "delmesh repair scan.stl clean.ply");
    const auto arguments = std::make_shared<RepairArguments>();
    command->add_option("IN", arguments->input, "Mesh file; -: standard input")->required();
    command->add_option("OUT", arguments->output.path, "File to write; -: standard output")->required();
    bind_options(*command, arguments->options);
    arguments->output.bind(*command);
    command->callback([&action, arguments] {
        action.common.mesh_on_stdout = arguments->output.is_stdout();
        action.run = [arguments](Console& console) { return run_repair(*arguments, console); };
    });
}

}  // namespace delmesh::app
