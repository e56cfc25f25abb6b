// delmesh sample [NAME OUT]: the meshes that the code can make.

#include "commands.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/io/write.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "exit_code.hpp"
#include "mesh_json.hpp"
#include "output_options.hpp"

#include <fmt/format.h>

#include <memory>

namespace delmesh::app {
namespace {

struct SampleArguments {
    std::string name;
    OutputOptions output;
    std::size_t faces = 0;
    unsigned seed = 1;
};

int list_samples(Console& console) {
    Json list = Json::array();
    std::vector<std::vector<std::string>> rows;
    for (const SampleInfo& info : samples()) {
        list.push_back({{"name", info.name}, {"description", info.description}, {"default_faces", info.default_faces}});
        rows.push_back({fmt::format("{:<18} {}", info.name, info.description)});
    }
    if (console.wants_json()) console.print({{"samples", list}});
    console.tell(format_table(rows));
    return exit_done;
}

int make(const SampleArguments& arguments, Console& console) {
    if (arguments.output.path.empty())
        throw Error(ErrorCode::bad_argument, fmt::format("where to? `delmesh sample {} OUT`", arguments.name));
    const WriteOptions options = arguments.output.write_options();
    PolygonSoup soup = make_sample(arguments.name, arguments.faces, arguments.seed);
    if (arguments.output.precision() == Precision::float32) round_to_float(soup);
    write_soup(output_path(arguments.output.path), soup, options);
    const Json json{{"name", arguments.name},
                    {"path", arguments.output.path},
                    {"vertices", soup.points.size()},
                    {"faces", soup.face_count()}};
    if (console.wants_json()) console.print(json);
    console.say(fmt::format("{}: {} vertices, {} faces", arguments.output.path, with_commas(soup.points.size()),
                            with_commas(soup.face_count())));
    return exit_done;
}

}  // namespace

void add_sample_command(CLI::App& app, Action& action) {
    CLI::App* command = add_command(app, action, "sample", "Write a built-in mesh to a file (no NAME: list them)",
                                    "delmesh sample torus torus.ply --faces 100000");
    const auto arguments = std::make_shared<SampleArguments>();
    command->add_option("NAME", arguments->name, "Which one");
    command->add_option("OUT", arguments->output.path, "File to write; -: standard output");
    command->add_option("--faces", arguments->faces, "About how many faces; 0: the sample's default")->type_name("N");
    command->add_option("--seed", arguments->seed, "Of the noise, where there is some")
        ->capture_default_str()
        ->type_name("N");
    arguments->output.bind(*command);
    command->callback([&action, arguments] {
        action.common.mesh_on_stdout = arguments->output.is_stdout();
        action.run = [arguments](Console& console) {
            return arguments->name.empty() ? list_samples(console) : make(*arguments, console);
        };
    });
}

}  // namespace delmesh::app
