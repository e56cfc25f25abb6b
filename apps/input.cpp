#include "input.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/mesh/rounding.hpp"
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

namespace {

/// A cloud of points, or faces none of which is left, would make a Delaunay mesh of nothing.
void require_faces(const std::string& path, const PolygonSoup& soup, const RepairReport* report = nullptr) {
    if (soup.face_count() > 0) return;
    std::string why;
    for (const Finding& finding : report != nullptr ? report->findings : std::vector<Finding>())
        why += "; " + sentence(finding);
    throw Error(ErrorCode::no_surface, why.empty()
                                           ? fmt::format("{}: expected faces, found {} vertices and no face", path,
                                                         with_commas(soup.points.size()))
                                           : fmt::format("{}: expected faces, found none to keep{}", path, why));
}

}  // namespace

PolygonSoup load_and_mend(const std::string& path, const RepairOptions& options, std::optional<Precision> rounding,
                          const Console& console, Mended& mended) {
    PolygonSoup soup = read_soup(input_path(path), {{}, &mended.damage});
    if (rounding == Precision::float32) round_to_float(soup);
    mended.report = repair(soup, options, console.context());
    if (!mended.report.cancelled) require_faces(path, soup, &mended.report);
    // Nothing asks for these, and they are as large as the mesh.
    std::vector<VertexId>().swap(mended.report.vertex_origin);
    std::vector<FaceId>().swap(mended.report.face_origin);
    return soup;
}

namespace {

/// True if --repair would find faces to go on with.
bool can_be_read_in_part(const std::string& path) {
    if (path == "-") return false;
    FileDamage damage;
    try {
        (void)read_soup(path, {{}, &damage});
    } catch (const Error&) {
        return false;  // the first error is the one to tell
    }
    return true;
}

PolygonSoup read_whole(const std::string& path) {
    try {
        return read_soup(input_path(path));
    } catch (const Error& error) {
        const bool is_damage = error.code() == ErrorCode::file_format || error.code() == ErrorCode::index_out_of_range;
        if (!is_damage || !can_be_read_in_part(path)) throw;
        throw Error(error.code(), std::string(error.what()) + "; with --repair what can be read is used");
    }
}

}  // namespace

PolygonSoup load_soup(const std::string& path, const InputOptions& options, const Console& console,
                      std::optional<Mended>* mended) {
    if (!options.repair) {
        PolygonSoup soup = read_whole(path);
        require_faces(path, soup);
        return soup;
    }
    Mended found;
    PolygonSoup soup = load_and_mend(path, options.repair_options, {}, console, found);
    if (found.changed() && !console.is_quiet())
        fmt::print(stderr, "{}: repaired\n{}\n", path, findings_text(path, found));
    if (mended != nullptr) *mended = std::move(found);
    return soup;
}

Mesh build_mesh(const std::string& path, PolygonSoup soup) {
    return naming(path, [&] { return Mesh(std::move(soup)); });
}

Json to_json(const Mended& mended) {
    Json json{{"changed", mended.changed()}, {"findings", Json::array()}};
    if (mended.damage.count > 0) {
        json["damaged"] = {{"count", mended.damage.count}, {"sentences", mended.damage.sentences}};
    }
    mended.report.visit([&json](std::string_view name, std::size_t count, const std::vector<std::size_t>& places,
                                std::string_view places_are, const std::string& sentence) {
        json["findings"].push_back(
            {{"kind", name}, {"count", count}, {"places", places}, {"places_are", places_are}, {"sentence", sentence}});
    });
    return json;
}

std::string findings_text(const std::string& path, const Mended& mended) {
    const FileDamage& damage = mended.damage;
    std::string text;
    const auto add = [&text](const std::string& line) { text += (text.empty() ? "  " : "\n  ") + line; };
    for (const std::string& sentence : damage.sentences)
        add("left out: " + sentence.substr(sentence.starts_with(path + ": ") ? path.size() + 2 : 0));
    if (damage.count > damage.sentences.size())
        add(fmt::format("left out: {} more places", with_commas(damage.count - damage.sentences.size())));
    for (const Finding& finding : mended.report.findings) add(sentence(finding));
    return text;
}

}  // namespace delmesh::app
