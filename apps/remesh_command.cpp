// delmesh remesh IN OUT: the main job.

#include "commands.hpp"
#include "delmesh/delaunay/part_places.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/io/edge_list.hpp"
#include "delmesh/io/provenance_file.hpp"
#include "delmesh/io/write.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "exit_code.hpp"
#include "input.hpp"
#include "mesh_json.hpp"
#include "option_binding.hpp"
#include "output_options.hpp"
#include "places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace delmesh::app {
namespace {

struct RemeshArguments {
    std::string input;
    InputOptions input_options;
    OutputOptions output;
    RemeshOptions options;
    std::string feature_edges;
    bool keep_partial = false;
    std::string provenance;
};

/// Everything that is known at the end of a run.
struct Outcome {
    Measured before;
    Measured after;
    RemeshReport report;
    std::optional<GrowthEstimate> growth;
    std::optional<Mended> repair;
    double rounded_by = 0;
    PlacesReport places;
    std::vector<std::size_t> witness;
    bool written = false;
    Stopwatch watch;

    [[nodiscard]] bool complete() const { return report.stop == StopReason::done && after.certificate.certified; }
};

Json growth_to_json(const GrowthEstimate& growth) {
    return {{"lower_bound", growth.lower_bound},
            {"likely_splits", growth.likely_splits},
            {"sharp_edges", growth.sharp_edges},
            {"lower_bound_if_flat", growth.lower_bound_if_flat ? Json(*growth.lower_bound_if_flat) : Json()}};
}

Json run_to_json(const RemeshArguments& arguments, const Outcome& outcome) {
    const RemeshReport& report = outcome.report;
    Json json;
    json["input"] = {{"path", arguments.input}};
    json["input"].update(to_json(outcome.before));
    json["output"] = {{"path", arguments.output.path}, {"written", outcome.written}};
    json["output"].update(to_json(outcome.after));
    json["flips"] = report.flips;
    json["splits"] = report.splits;
    json["splits_boundary"] = report.splits_boundary;
    json["splits_feature"] = report.splits_feature;
    json["splits_unflippable"] = report.splits_unflippable;
    json["exposed"] = report.exposed;
    json["foldovers"] = report.foldovers;
    if (arguments.options.mode == RemeshMode::preserve) json["lower_bound"] = report.lower_bound;
    if (report.lower_bound_strong) json["lower_bound_strong"] = *report.lower_bound_strong;
    if (report.splits_by_shells > 0) json["splits_by_shells"] = report.splits_by_shells;
    if (outcome.growth) json["growth"] = growth_to_json(*outcome.growth);
    json["flat_tolerance"] = report.flat_tolerance;
    json["max_deviation"] = report.max_deviation;
    json["stop"] = name(report.stop);
    json["witness"] = outcome.witness.empty() ? Json() : Json(outcome.witness);
    json["rounded_by"] = outcome.rounded_by;
    json["welded"] = outcome.places.welded;
    json["parted"] = outcome.places.parted;
    if (outcome.repair) json["repair"] = to_json(*outcome.repair);
    json["options"] = options_to_json(arguments.options);
    json["options"]["precision"] = choices(Precision{})[static_cast<std::size_t>(arguments.options.precision)];
    json["seconds"] = outcome.watch.seconds();
    json["peak_memory_bytes"] = peak_memory_bytes();
    return json;
}

std::string_view what_to_try(const RemeshOptions& options, const RemeshReport& report) {
    switch (options.mode) {
        case RemeshMode::preserve:
            return report.flat_tolerance > 0
                       ? "; --mode feature or --mode flip may do with fewer vertices"
                       : "; --flat-tolerance 1e-5, --mode feature or --mode flip may do with fewer vertices";
        case RemeshMode::feature:
            return "; a larger --feature-angle or --mode flip may do with fewer vertices";
        case RemeshMode::flip:
            break;
    }
    return "";
}

std::string why_it_stopped(const RemeshArguments& arguments, const Outcome& outcome) {
    const std::string at = outcome.witness.empty() ? std::string()
                                                   : fmt::format(" at the edge between vertices {} and {}",
                                                                 outcome.witness[0], outcome.witness[1]);
    const std::string_view precision = choices(Precision{})[static_cast<std::size_t>(arguments.options.precision)];
    const std::string_view try_doubles =
        arguments.options.precision == Precision::float32 ? "; try a format that stores doubles" : "";
    switch (outcome.report.stop) {
        case StopReason::max_vertices:
            return fmt::format("stopped at {} vertices (--max-vertices){}; {} edges are not Delaunay yet{}",
                               with_commas(outcome.after.size.vertices), at,
                               with_commas(outcome.after.certificate.non_delaunay_edges +
                                           outcome.after.certificate.obtuse_boundary_edges),
                               what_to_try(arguments.options, outcome.report));
        case StopReason::unresolved:
            if (outcome.report.endless)
                return fmt::format("stopped{}: rounding to {} precision brings it back whenever it is split{}{}", at,
                                   precision, try_doubles, what_to_try(arguments.options, outcome.report));
            return fmt::format("stopped{}: {} precision can not hold a point between its ends that is needed{}{}", at,
                               precision, try_doubles, what_to_try(arguments.options, outcome.report));
        case StopReason::cancelled:
            return "interrupted";
        case StopReason::done:
            break;
    }
    return "the result is " + verdict(outcome.after);
}

std::string summary(const RemeshReport& report, double seconds, bool preserve) {
    std::string text = fmt::format("{} flips, {} splits", with_commas(report.flips), with_commas(report.splits));
    if (preserve)
        text += fmt::format(" (no method that keeps the surface adds fewer than {})",
                            with_commas(report.lower_bound_strong.value_or(report.lower_bound)));
    if (report.foldovers > 0)
        text += fmt::format(", {} faces turned by more than 90 degrees", with_commas(report.foldovers));
    return text + fmt::format(" in {:.3g} s", seconds);
}

bool is_mostly_rounding(const GrowthEstimate& growth) {
    return growth.lower_bound_if_flat && *growth.lower_bound_if_flat < growth.lower_bound / 2;
}

std::string describe(const GrowthEstimate& growth) {
    std::string text =
        fmt::format("{} edges must be split, which is likely to add {} vertices or more to {}",
                    with_commas(growth.lower_bound), with_commas(growth.likely_splits), with_commas(growth.vertices));
    if (is_mostly_rounding(growth)) {
        text += fmt::format("; --flat-tolerance stored: {} edges (the others are flat but for rounding)",
                            with_commas(*growth.lower_bound_if_flat));
    }
    if (growth.sharp_edges < growth.lower_bound / 2)
        text += fmt::format("; --mode feature: {} edges", with_commas(growth.sharp_edges));
    return text + "; --max-vertices N sets a bound";
}

/// Tells early that the mesh is about to grow a lot, or needlessly.
std::function<void(const GrowthEstimate&)> growth_teller(Outcome& outcome, Console& console) {
    return [&outcome, &console](const GrowthEstimate& growth) {
        // Other attempts to keep the surface repeat it.
        if (outcome.growth) return;
        outcome.growth = growth;
        const bool much = growth.likely_splits > growth.vertices || growth.likely_splits > 1'000'000;
        if (much || is_mostly_rounding(growth)) console.note(describe(growth));
    };
}

void tell_people(const RemeshArguments& arguments, const Outcome& outcome, Console& console) {
    const bool preserve = arguments.options.mode == RemeshMode::preserve;
    console.say(comparison_table({"before", "after"}, {outcome.before, outcome.after}));
    console.say("\n" + summary(outcome.report, outcome.watch.seconds()["total"].get<double>(), preserve));
    if (outcome.growth && is_mostly_rounding(*outcome.growth) && outcome.report.flat_tolerance == 0)
        console.say(
            fmt::format("all but {} of the {} edges that had to be split are flat but for rounding: "
                        "--flat-tolerance stored lets them flip",
                        with_commas(*outcome.growth->lower_bound_if_flat), with_commas(outcome.growth->lower_bound)));
    if (outcome.report.max_deviation > 0)
        console.say(fmt::format("{} (tolerance {:.3g}): {} moved by no more than {:.3g}",
                                preserve ? "flat edges flipped" : "needles flat but for rounding flipped first",
                                outcome.report.flat_tolerance, preserve ? "the surface" : "features",
                                outcome.report.max_deviation));
    if (outcome.rounded_by > 0)
        console.say(
            fmt::format("input rounded to floats first: no vertex moved further than {:.3g}", outcome.rounded_by));
    if (outcome.places.welded > 0)
        console.say(fmt::format("{} vertices joined with others at their place, as STL does", outcome.places.welded));
    if (outcome.places.parted > 0)
        console.say(fmt::format("{} vertices moved by the last bits, as STL would join them with others at their place",
                                outcome.places.parted));
    if (outcome.written) console.say(fmt::format("wrote {}", arguments.output.path));
}

/// Growth is finite but can be absurd: a sphere stretched by a million wants billions of vertices. What a search can
/// not do with a million more is of no use.
std::size_t sensible_limit(std::size_t vertices, SplitPlacement placement) {
    const std::size_t least_more = placement == SplitPlacement::shells ? 2'000'000 : 1'000'000;
    return std::max(5 * vertices, vertices + least_more);
}

void complete_options(RemeshArguments& arguments, const PolygonSoup& soup) {
    RemeshOptions& options = arguments.options;
    options.precision = arguments.output.precision();
    if (options.max_vertices == 0) options.max_vertices = sensible_limit(soup.points.size(), options.placement);
    if (options.mode != RemeshMode::feature) return;
    const auto add = [&options](const std::array<std::uint32_t, 2>& edge) {
        options.feature_edges.push_back({VertexId(edge[0]), VertexId(edge[1])});
    };
    for (const auto& line : soup.lines) add(line);
    if (arguments.feature_edges.empty()) return;
    for (const auto& edge : read_edge_list(arguments.feature_edges)) add(edge);
}

Mesh load(RemeshArguments& arguments, const WriteOptions& write_options, Console& console, Outcome& outcome) {
    PolygonSoup soup = load_soup(arguments.input, arguments.input_options, console, &outcome.repair);
    if (arguments.output.precision() == Precision::float32) outcome.rounded_by = round_to_float(soup);
    if (*write_options.format == Format::stl) {
        triangulate(soup);
        outcome.places = tell_places_apart(soup);
    }
    complete_options(arguments, soup);
    outcome.watch.lap("read");
    Mesh mesh = build_mesh(arguments.input, std::move(soup));
    outcome.watch.lap("build");
    return mesh;
}

void write_results(const RemeshArguments& arguments, const WriteOptions& options, const Mesh& mesh, Outcome& outcome) {
    if (!outcome.complete() && !arguments.keep_partial) return;
    if (*options.format == Format::stl) check_places(arguments.output.path, mesh);
    write_mesh(output_path(arguments.output.path), mesh, options);
    if (!arguments.provenance.empty()) write_provenance(arguments.provenance, outcome.report.provenance);
    outcome.written = true;
}

/// For STL, vertices at one place are told apart. True if that is possible, and all edges are Delaunay.
bool remesh(const RemeshArguments& arguments, bool is_stl, Mesh& mesh, Console& console, RemeshReport& report,
            std::size_t& parted) {
    report = naming(arguments.input, [&] { return make_delaunay(mesh, arguments.options, console.context()); });
    if (report.stop != StopReason::done || !is_stl) return report.stop == StopReason::done;
    const Parting parting = part_places(mesh);
    parted += parting.moved;
    return parting.left.empty();
}

/// Where a surface touches itself and vertices were moved apart for STL, these bends may be what can not be made
/// Delaunay. Then the vertices are left at their places until the end. Says so in the outcome only if that helps.
void remesh_touching(const RemeshArguments& arguments, Mesh touching, Mesh& mesh, Console& console, Outcome& outcome) {
    for (std::size_t v = 0; v < touching.vertex_count(); ++v) touching.set_point(VertexId(v), outcome.places.before[v]);
    RemeshReport report;
    std::size_t parted = 0;
    try {
        if (!remesh(arguments, true, touching, console, report, parted)) {
            if (report.stop == StopReason::cancelled) outcome.report.stop = StopReason::cancelled;
            return;
        }
    } catch (const Error& error) {
        if (!is_about_mesh(error.code())) throw;
        return;  // an edge without length, say
    }
    mesh = std::move(touching);
    outcome.report = std::move(report);
    outcome.places.parted = parted;
}

void remesh(RemeshArguments& arguments, bool is_stl, Mesh& mesh, Console& console, Outcome& outcome) {
    arguments.options.on_growth = growth_teller(outcome, console);
    const bool is_touching = !outcome.places.before.empty();
    Mesh touching = is_touching ? mesh : Mesh();
    const bool ended = remesh(arguments, is_stl, mesh, console, outcome.report, outcome.places.parted);
    if (!ended && is_touching && outcome.report.stop != StopReason::cancelled)
        remesh_touching(arguments, std::move(touching), mesh, console, outcome);
    if (outcome.report.witness) {
        const HalfedgeId h = Mesh::halfedge(*outcome.report.witness);
        outcome.witness = {mesh.origin(h).index(), mesh.target(h).index()};
    }
}

int run_remesh(RemeshArguments& arguments, Console& console) {
    const WriteOptions write_options = arguments.output.write_options();
    Outcome outcome;
    Mesh mesh = load(arguments, write_options, console, outcome);
    outcome.before = measure(mesh, console.context());
    outcome.watch.lap("measure");
    if (arguments.keep_partial) console.finish_early();
    remesh(arguments, *write_options.format == Format::stl, mesh, console, outcome);
    outcome.watch.lap("remesh");
    if (outcome.report.stop == StopReason::cancelled && !arguments.keep_partial) return console.interrupted();
    // What there is so far is measured whole, too.
    outcome.after = measure(mesh, console.interrupted() != 0 ? nullptr : console.context());
    outcome.watch.lap("certify");
    write_results(arguments, write_options, mesh, outcome);
    outcome.watch.lap("write");

    if (console.wants_json()) console.print(run_to_json(arguments, outcome));
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
    command
        ->add_option("IN", arguments->input,
                     "Mesh file: PLY, OBJ, OFF, STL, glTF or 3MF, also packed as .gz or .zst; -: standard input")
        ->required();
    command->add_option("OUT", arguments->output.path, "File to write; its ending tells the format; -: standard output")
        ->required();
    arguments->input_options.bind(*command);
    bind_options(*command, arguments->options);
    command
        ->add_option("--feature-edges", arguments->feature_edges,
                     "Mode feature: a text file of edges to keep, two vertex numbers (from 0) a line")
        ->type_name("FILE");
    arguments->output.bind(*command);
    command->add_flag("--keep-partial", arguments->keep_partial, "Write the mesh even if the run stopped short");
    command->add_option("--provenance", arguments->provenance, "Write where vertices and faces come from, as JSON")
        ->type_name("FILE");
    command->callback([&action, arguments] {
        action.common.mesh_on_stdout = arguments->output.is_stdout();
        action.run = [arguments](Console& console) { return run_remesh(*arguments, console); };
    });
}

}  // namespace delmesh::app
