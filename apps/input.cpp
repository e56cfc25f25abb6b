#include "input.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/io/read.hpp"
#include "option_binding.hpp"

#include <fmt/format.h>

namespace delmesh::app {

bool is_about_mesh(ErrorCode code) {
    switch (code) {
        case ErrorCode::bad_argument:
        case ErrorCode::file_not_readable:
        case ErrorCode::file_not_writable:
        case ErrorCode::file_format:
        case ErrorCode::unsupported_format:
            return false;
        default:
            return true;
    }
}

void InputOptions::bind(CLI::App& command) {
    command.add_flag("--repair", repair, "Make a manifold of the input first, see `delmesh repair`");
    bind_options(command, repair_options);
}

PolygonSoup load_soup(const std::string& path, const InputOptions& options, const Console& console,
                      std::optional<RepairReport>* report) {
    PolygonSoup soup = read_soup(input_path(path));
    if (!options.repair) return soup;
    RepairReport found = repair(soup, options.repair_options, console.context());
    if (found.changed && !console.is_quiet()) fmt::print(stderr, "{}: repaired\n{}\n", path, findings_text(found));
    if (report != nullptr) *report = std::move(found);
    return soup;
}

Mesh build_mesh(const std::string& path, PolygonSoup soup) {
    return naming(path, [&] { return Mesh(std::move(soup)); });
}

Json to_json(const RepairReport& report) {
    Json json{{"changed", report.changed}, {"findings", Json::array()}};
    report.visit([&json](std::string_view name, std::size_t count, const std::vector<std::size_t>& places,
                         std::string_view places_are, const std::string& sentence) {
        json["findings"].push_back(
            {{"kind", name}, {"count", count}, {"places", places}, {"places_are", places_are}, {"sentence", sentence}});
    });
    return json;
}

std::string findings_text(const RepairReport& report) {
    std::string text;
    for (const Finding& finding : report.findings) text += (text.empty() ? "  " : "\n  ") + sentence(finding);
    return text;
}

}  // namespace delmesh::app
