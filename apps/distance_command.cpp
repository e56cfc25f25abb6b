// delmesh distance A B: how far two surfaces are apart.

#include "commands.hpp"
#include "delmesh/io/read.hpp"
#include "delmesh/measure/distance.hpp"
#include "exit_code.hpp"
#include "option_binding.hpp"

#include <fmt/format.h>

#include <memory>

namespace delmesh::app {
namespace {

struct DistanceArguments {
    std::string a;
    std::string b;
    DistanceOptions options;
};

Json to_json(const DistanceFigure& figure) {
    return {{"value", figure.value},
            {"percent", figure.percent},
            {"forward", figure.forward},
            {"backward", figure.backward}};
}

Json to_json(const Vec3& p) {
    return Json::array({p.x, p.y, p.z});
}

Json to_json(const DistanceArguments& arguments, const DistanceReport& report) {
    Json json{{"a", arguments.a}, {"b", arguments.b}};
    json["hausdorff"] = to_json(report.hausdorff);
    json["hausdorff"]["at"] = {{"on_a", to_json(report.at.on_a)}, {"on_b", to_json(report.at.on_b)}};
    json["mean"] = to_json(report.mean);
    json["rms"] = to_json(report.rms);
    json["samples"] = report.samples;
    json["diagonal"] = report.diagonal;
    if (report.enclosure) {
        const DistanceEnclosure& enclosure = *report.enclosure;
        json["bound"] = {{"lower", enclosure.lower},
                         {"upper", enclosure.upper},
                         {"lower_percent", enclosure.lower_percent},
                         {"upper_percent", enclosure.upper_percent},
                         {"reached", enclosure.reached},
                         {"pieces", enclosure.pieces}};
    }
    json["options"] = options_to_json(arguments.options);
    return json;
}

void tell(const DistanceReport& report, Console& console) {
    std::vector<std::vector<std::string>> rows{{"", "distance", "% of diagonal", "A to B", "B to A"}};
    const auto row = [&rows](const char* title, const DistanceFigure& figure) {
        rows.push_back({title, fmt::format("{:.6g}", figure.value), fmt::format("{:.4f}", figure.percent),
                        fmt::format("{:.6g}", figure.forward), fmt::format("{:.6g}", figure.backward)});
    };
    row("Hausdorff", report.hausdorff);
    row("mean", report.mean);
    row("RMS", report.rms);
    console.tell(format_table(rows));
    console.say(fmt::format("\n{} samples; the largest distance is at ({:.6g}, {:.6g}, {:.6g}) of A",
                            with_commas(report.samples), report.at.on_a.x, report.at.on_a.y, report.at.on_a.z));
    if (!report.enclosure) return;
    const DistanceEnclosure& enclosure = *report.enclosure;
    console.tell(fmt::format("proved: {:.6g} <= Hausdorff <= {:.6g} ({:.4f} to {:.4f} %){}", enclosure.lower,
                             enclosure.upper, enclosure.lower_percent, enclosure.upper_percent,
                             enclosure.reached ? "" : "; wider than asked, raise --max-pieces"));
}

int run_distance(const DistanceArguments& arguments, Console& console) {
    const PolygonSoup a = read_soup(input_path(arguments.a));
    const PolygonSoup b = read_soup(input_path(arguments.b));
    const DistanceReport report = measure_distance(a, b, arguments.options, console.context());
    if (!report.complete) return console.interrupted();
    if (console.wants_json()) console.print(to_json(arguments, report));
    tell(report, console);
    return report.enclosure && !report.enclosure->reached ? exit_stopped : exit_done;
}

}  // namespace

void add_distance_command(CLI::App& app, Action& action) {
    CLI::App* command = add_command(app, action, "distance", "Measure how far two surfaces are apart, both ways",
                                    "delmesh distance original.ply simplified.ply");
    const auto arguments = std::make_shared<DistanceArguments>();
    command->add_option("A", arguments->a, "Mesh file; percentages are of its bounding-box diagonal")->required();
    command->add_option("B", arguments->b, "Mesh file; -: standard input")->required();
    bind_options(*command, arguments->options);
    command->callback([&action, arguments] {
        action.run = [arguments](Console& console) { return run_distance(*arguments, console); };
    });
}

}  // namespace delmesh::app
