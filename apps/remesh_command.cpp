// delmesh remesh IN OUT: the main job.

#include "commands.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/io/provenance_file.hpp"
#include "delmesh/io/read.hpp"
#include "delmesh/io/write.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "exit_code.hpp"
#include "mesh_json.hpp"
#include "option_binding.hpp"
#include "output_options.hpp"

#include <fmt/format.h>

#include <memory>

namespace delmesh::app {
namespace {

struct RemeshArguments {
    std::string input;
    OutputOptions output;
    RemeshOptions options;
    bool keep_partial = false;
    std::string provenance;
};

/// Everything that is known at the end of a run.
struct Outcome {
    Measured before;
    Measured after;
    RemeshReport report;
    double rounded_by = 0;
    std::vector<std::size_t> witness;
    bool written = false;
    Stopwatch watch;

    [[nodiscard]] bool complete() const { return report.stop == StopReason::done && after.certificate.certified; }
};

Json to_json(const RemeshArguments& arguments, const Outcome& outcome) {
    Json json;
    json["input"] = {{"path", arguments.input}};
    json["input"].update(to_json(outcome.before));
    json["output"] = {{"path", arguments.output.path}, {"written", outcome.written}};
    json["output"].update(to_json(outcome.after));
    json["flips"] = outcome.report.flips;
    json["splits"] = outcome.report.splits;
    json["lower_bound"] = outcome.report.lower_bound;
    json["stop"] = name(outcome.report.stop);
    json["witness"] = outcome.witness.empty() ? Json() : Json(outcome.witness);
    json["rounded_by"] = outcome.rounded_by;
    json["options"] = options_to_json(arguments.options);
    json["options"]["precision"] = choices(Precision{})[static_cast<std::size_t>(arguments.options.precision)];
    json["seconds"] = outcome.watch.seconds();
    json["peak_memory_bytes"] = peak_memory_bytes();
    return json;
}

std::string why_it_stopped(const RemeshArguments& arguments, const Outcome& outcome) {
    const std::string at = outcome.witness.empty() ? std::string()
                                                   : fmt::format(" at the edge between vertices {} and {}",
                                                                 outcome.witness[0], outcome.witness[1]);
    switch (outcome.report.stop) {
        case StopReason::max_vertices:
            return fmt::format("stopped at {} vertices (--max-vertices){}; {} edges are not Delaunay yet",
                               with_commas(outcome.after.size.vertices), at,
                               with_commas(outcome.after.certificate.non_delaunay_edges +
                                           outcome.after.certificate.obtuse_boundary_edges));
        case StopReason::unresolved:
            return fmt::format(
                "stopped{}: {} precision can not hold a point between its ends that is needed{}", at,
                choices(Precision{})[static_cast<std::size_t>(arguments.options.precision)],
                arguments.options.precision == Precision::float32 ? "; try a format that stores doubles" : "");
        case StopReason::cancelled:
            return "interrupted";
        case StopReason::done:
            break;
    }
    return "the result is " + verdict(outcome.after);
}

void tell_people(const RemeshArguments& arguments, const Outcome& outcome, Console& console) {
    console.say(comparison_table({"before", "after"}, {outcome.before, outcome.after}));
    console.say(fmt::format("\n{} flips, {} splits (no method adds fewer than {}) in {:.3g} s",
                            with_commas(outcome.report.flips), with_commas(outcome.report.splits),
                            with_commas(outcome.report.lower_bound), outcome.watch.seconds()["total"].get<double>()));
    if (outcome.rounded_by > 0)
        console.say(
            fmt::format("input rounded to floats first: no vertex moved further than {:.3g}", outcome.rounded_by));
    if (outcome.written) console.say(fmt::format("wrote {}", arguments.output.path));
}

void write_results(const RemeshArguments& arguments, const WriteOptions& options, const Mesh& mesh, Outcome& outcome) {
    if (!outcome.complete() && !arguments.keep_partial) return;
    write_mesh(arguments.output.path, mesh, options);
    if (!arguments.provenance.empty()) write_provenance(arguments.provenance, outcome.report.provenance);
    outcome.written = true;
}

int run_remesh(RemeshArguments& arguments, Console& console) {
    const WriteOptions write_options = arguments.output.write_options();
    arguments.options.precision = arguments.output.precision();
    Outcome outcome;
    PolygonSoup soup = read_soup(arguments.input);
    if (arguments.options.precision == Precision::float32) outcome.rounded_by = round_to_float(soup);
    outcome.watch.lap("read");
    Mesh mesh(std::move(soup));
    outcome.watch.lap("build");
    outcome.before = measure(mesh, console.context());
    outcome.watch.lap("measure");
    outcome.report = make_delaunay(mesh, arguments.options, console.context());
    if (outcome.report.witness) {
        const HalfedgeId h = Mesh::halfedge(*outcome.report.witness);
        outcome.witness = {mesh.origin(h).index(), mesh.target(h).index()};
    }
    outcome.watch.lap("remesh");
    if (outcome.report.stop == StopReason::cancelled && !arguments.keep_partial) return console.interrupted();
    outcome.after = measure(mesh, console.context());
    outcome.watch.lap("certify");
    write_results(arguments, write_options, mesh, outcome);
    outcome.watch.lap("write");

    if (console.wants_json()) console.print(to_json(arguments, outcome));
    tell_people(arguments, outcome, console);
    if (outcome.complete()) return exit_done;
    fmt::print(stderr, "delmesh: {}: {}{}\n", arguments.input, why_it_stopped(arguments, outcome),
               outcome.written ? "" : "; nothing was written (--keep-partial writes what there is)");
    return exit_stopped;
}

}  // namespace

void add_remesh_command(CLI::App& app, Action& action) {
    CLI::App* command = add_command(app, action, "remesh", "Turn a mesh into a Delaunay mesh and certify it",
                                    "delmesh remesh bunny.obj bunny-delaunay.ply");
    const auto arguments = std::make_shared<RemeshArguments>();
    command->add_option("IN", arguments->input, "Mesh file: PLY, OBJ, OFF or STL")->required();
    command->add_option("OUT", arguments->output.path, "File to write; its ending tells the format")->required();
    bind_options(*command, arguments->options);
    arguments->output.bind(*command);
    command->add_flag("--keep-partial", arguments->keep_partial, "Write the mesh even if the run stopped short");
    command->add_option("--provenance", arguments->provenance, "Write where vertices and faces come from, as JSON")
        ->type_name("FILE");
    command->callback([&action, arguments] {
        action.run = [arguments](Console& console) { return run_remesh(*arguments, console); };
    });
}

}  // namespace delmesh::app
