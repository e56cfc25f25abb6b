// delmesh simplify IN OUT: levels of detail that are Delaunay meshes.

#include "commands.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/io/lod_file.hpp"
#include "delmesh/io/write.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "delmesh/simplify/progressive_mesh.hpp"
#include "delmesh/simplify/simplify.hpp"
#include "exit_code.hpp"
#include "input.hpp"
#include "mesh_json.hpp"
#include "option_binding.hpp"
#include "output_options.hpp"
#include "places.hpp"

#include <fmt/format.h>

#include <memory>

namespace delmesh::app {
namespace {

struct SimplifyArguments {
    std::string input;
    InputOptions input_options;
    OutputOptions output;
    SimplifyOptions options;
    std::string mode = "feature";
    bool keep_partial = false;
    std::string lod;
};

/// What is known of a level once it is reached.
struct Level {
    LevelReport report;
    Measured measured;
    std::string path;
    bool written = false;
};

struct Outcome {
    Measured before;
    std::optional<Mended> repair;
    double rounded_by = 0;
    std::vector<Level> levels;
    SimplifyReport report;
    Stopwatch watch;
};

/// OUT with the level's number in the place of {}.
std::string path_of(const std::string& pattern, std::size_t number) {
    const std::size_t at = pattern.find("{}");
    if (at == std::string::npos) return pattern;
    return pattern.substr(0, at) + std::to_string(number) + pattern.substr(at + 2);
}

bool is_wanted_end(const SimplifyArguments& arguments, const LevelReport& level) {
    const SimplifyOptions& options = arguments.options;
    const bool only_error = options.vertices == 0 && options.ratio == 0 && options.levels.empty();
    return level.stop == SimplifyStop::done || (only_error && level.stop == SimplifyStop::error_limit);
}

std::string obstacles(const LevelReport& level) {
    std::string text;
    for (std::size_t i = 0; i < obstacle_count; ++i)
        if (level.blocked[i] > 0)
            text += fmt::format("{}{} by {}", text.empty() ? "" : ", ", with_commas(level.blocked[i]),
                                name(static_cast<Obstacle>(i)));
    return text.empty() ? "" : "; edges blocked: " + text;
}

std::string topological_limit(const LevelReport& level, const SimplifyReport& report) {
    if (level.target >= report.least_vertices) return "";
    return fmt::format("; its components, handles and boundary loops need {} at least",
                       with_commas(report.least_vertices));
}

Json level_to_json(const Level& level) {
    Json json{{"target", level.report.target},
              {"path", level.path},
              {"written", level.written},
              {"stop", name(level.report.stop)},
              {"quadric_error", level.report.quadric_error}};
    for (std::size_t i = 0; i < obstacle_count; ++i)
        json["blocked"][std::string(name(static_cast<Obstacle>(i)))] = level.report.blocked[i];
    json.update(to_json(level.measured));
    return json;
}

Json run_to_json(const SimplifyArguments& arguments, const Outcome& outcome) {
    Json json;
    json["input"] = {{"path", arguments.input}};
    json["input"].update(to_json(outcome.before));
    json["levels"] = Json::array();
    for (const Level& level : outcome.levels) json["levels"].push_back(level_to_json(level));
    if (!outcome.levels.empty()) json["output"] = json["levels"].back();
    json["stop"] = name(outcome.report.stop);
    json["least_vertices"] = outcome.report.least_vertices;
    json["collapses"] = outcome.report.collapses;
    json["moves"] = outcome.report.moves;
    json["remeshed"] = outcome.report.remesh.has_value();
    if (outcome.report.remesh) {
        json["flips"] = outcome.report.remesh->flips;
        json["splits"] = outcome.report.remesh->splits;
        json["thinned_to"] = outcome.report.thinned_to;
        json["remesh_angle_deg"] = outcome.report.remesh_angle_deg;
    }
    json["rounded_by"] = outcome.rounded_by;
    if (outcome.repair) json["repair"] = to_json(*outcome.repair);
    json["options"] = options_to_json(arguments.options);
    json["options"]["levels"] = arguments.options.levels;
    json["options"]["mode"] = arguments.mode;
    json["options"]["remesh_angle_deg"] = arguments.options.remesh.feature_angle_deg;
    json["seconds"] = outcome.watch.seconds();
    json["peak_memory_bytes"] = peak_memory_bytes();
    return json;
}

/// See `SimplifyReport::thinned_to`.
bool is_mended(const SimplifyReport& report) {
    return report.thinned_to > 0 && report.remesh && report.remesh->splits == 0 && report.remesh_angle_deg == 0;
}

void tell_people(const Outcome& outcome, double remesh_angle_deg, Console& console) {
    std::vector<std::string> titles{"input"};
    std::vector<Measured> columns{outcome.before};
    for (const Level& level : outcome.levels) {
        titles.push_back(with_commas(level.report.vertices));
        columns.push_back(level.measured);
    }
    console.say(comparison_table(titles, columns));
    if (is_mended(outcome.report))
        console.say(fmt::format("\nneedles stood in each other's way: the input was mended first, down to {} vertices",
                                with_commas(outcome.report.thinned_to)));
    else if (outcome.report.remesh)
        console.say(fmt::format("\nthe input was not Delaunay and was remeshed first: {} flips, {} splits",
                                with_commas(outcome.report.remesh->flips), with_commas(outcome.report.remesh->splits)));
    if (outcome.report.thinned_to > 0 && !is_mended(outcome.report))
        console.say(
            fmt::format("before that, needles were thinned out, to {} vertices: as it came, the input needed too many",
                        with_commas(outcome.report.thinned_to)));
    if (outcome.report.remesh && outcome.report.remesh_angle_deg > remesh_angle_deg)
        console.say(
            fmt::format("edges that deviate from flat by up to {} degrees were flipped, as {} needs too many vertices",
                        outcome.report.remesh_angle_deg, remesh_angle_deg));
    for (const Level& level : outcome.levels)
        if (level.written) console.say(fmt::format("wrote {}", level.path));
}

void check_arguments(const SimplifyArguments& arguments) {
    const SimplifyOptions& options = arguments.options;
    const int targets =
        (options.vertices != 0 ? 1 : 0) + (options.ratio != 0 ? 1 : 0) + (options.levels.empty() ? 0 : 1);
    if (targets == 0 && options.max_quadric_error_rel == 0)
        throw Error(ErrorCode::bad_argument,
                    "how far? give --vertices N, --ratio R, --levels N1,N2,... or --max-quadric-error E");
    if (targets > 1) throw Error(ErrorCode::bad_argument, "give only one of --vertices, --ratio and --levels");
    if (options.levels.size() > 1 && arguments.output.path.find("{}") == std::string::npos)
        throw Error(ErrorCode::bad_argument,
                    fmt::format("{}: several levels need a name with {{}} in it, for the number of vertices",
                                arguments.output.path));
}

/// Remeshing that multiplies the vertices undoes what the user came for, and takes long.
std::size_t sensible_limit(std::size_t vertices) {
    return std::max(5 * vertices, vertices + 500'000);
}

std::string why_nothing_was_done(const SimplifyReport& report) {
    if (report.remesh && report.remesh->stop == StopReason::unresolved)
        return "not Delaunay, and double precision can not hold the points that it needs; `delmesh repair --weld 1e-6` "
               "may join what lies too close";
    if (!report.remesh || report.remesh->stop != StopReason::max_vertices) return std::string(name(report.stop));
    return fmt::format("not Delaunay, and still not with {} vertices added; --mode flip may do with fewer",
                       with_commas(report.remesh->splits));
}

int run_simplify(SimplifyArguments& arguments, Console& console) {
    check_arguments(arguments);
    const WriteOptions write_options = arguments.output.write_options();
    Outcome outcome;
    PolygonSoup soup = load_soup(arguments.input, arguments.input_options, console, &outcome.repair);
    if (arguments.output.precision() == Precision::float32) outcome.rounded_by = round_to_float(soup);
    outcome.watch.lap("read");
    Mesh mesh = build_mesh(arguments.input, std::move(soup));
    outcome.watch.lap("build");
    outcome.before = measure(mesh, console.context());
    outcome.watch.lap("measure");

    const auto names = choices(RemeshMode{});
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == arguments.mode) arguments.options.remesh.mode = static_cast<RemeshMode>(i);
    arguments.options.remesh.precision = arguments.output.precision();
    arguments.options.remesh.max_vertices = sensible_limit(mesh.vertex_count());
    arguments.options.on_level = [&](const Mesh& at, const LevelReport& report) {
        Level level{report, measure(at, console.context()), path_of(arguments.output.path, report.target), false};
        if (level.measured.certificate.certified && (is_wanted_end(arguments, report) || arguments.keep_partial)) {
            if (*write_options.format == Format::stl) check_places(level.path, at);
            write_mesh(output_path(level.path), at, write_options);
            level.written = true;
        }
        outcome.levels.push_back(std::move(level));
    };
    ProgressiveMesh record;
    outcome.report = naming(arguments.input, [&] {
        return arguments.lod.empty() ? simplify(mesh, arguments.options, console.context())
                                     : simplify(mesh, arguments.options, record, console.context());
    });
    outcome.watch.lap("simplify");
    if (outcome.report.stop == SimplifyStop::cancelled) return console.interrupted();
    if (!arguments.lod.empty()) write_lod(arguments.lod, record);
    if (console.wants_json()) console.print(run_to_json(arguments, outcome));
    tell_people(outcome, arguments.options.remesh.feature_angle_deg, console);

    for (const Level& level : outcome.levels) {
        if (level.written && is_wanted_end(arguments, level.report)) continue;
        fmt::print(stderr, "delmesh: {}: stopped at {} vertices instead of {} ({}){}{}{}\n", arguments.input,
                   with_commas(level.report.vertices), with_commas(level.report.target), name(level.report.stop),
                   topological_limit(level.report, outcome.report), obstacles(level.report),
                   level.written ? "" : "; nothing was written for it (--keep-partial writes what there is)");
        return exit_stopped;
    }
    if (outcome.levels.empty()) {
        fmt::print(stderr, "delmesh: {}: {}; nothing was simplified\n", arguments.input,
                   why_nothing_was_done(outcome.report));
        return exit_stopped;
    }
    return exit_done;
}

}  // namespace

void add_simplify_command(CLI::App& app, Action& action) {
    CLI::App* command = add_command(app, action, "simplify", "Make a mesh coarser; every level is a Delaunay mesh",
                                    "delmesh simplify bunny.ply bunny-{}.ply --levels 10000,1000,100");
    const auto arguments = std::make_shared<SimplifyArguments>();
    command->add_option("IN", arguments->input, "Mesh file; -: standard input")->required();
    command
        ->add_option("OUT", arguments->output.path,
                     "File to write; -: standard output; {} stands for the level's number")
        ->required();
    command->add_option("--levels", arguments->options.levels, "Several levels, as numbers of vertices")
        ->type_name("N1,N2,...")
        ->delimiter(',')
        ->check(CLI::PositiveNumber);
    arguments->input_options.bind(*command);
    bind_options(*command, arguments->options);
    command->add_option("--mode", arguments->mode, "How an input that is not Delaunay is made so first")
        ->capture_default_str()
        ->check(CLI::IsMember({"preserve", "flip", "feature"}));
    command
        ->add_option_function<double>(
            "--remesh-angle",
            [arguments](double angle) {
                arguments->options.remesh.feature_angle_deg = angle;
                arguments->options.wider_angle_on_noise = false;
            },
            "Mode feature: edges that deviate from flat by more are not flipped, unless that needs too many vertices; "
            "default 15, large noisy inputs 30")
        ->type_name("DEG")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 180.0));
    arguments->output.bind(*command);
    command->add_option("--lod", arguments->lod, "Write all levels as one progressive mesh, see `delmesh lod`")
        ->type_name("FILE");
    command->add_flag("--keep-partial", arguments->keep_partial, "Write levels that stopped short, too");
    command->callback([&action, arguments] {
        action.common.mesh_on_stdout = arguments->output.is_stdout();
        action.run = [arguments](Console& console) { return run_simplify(*arguments, console); };
    });
}

}  // namespace delmesh::app
