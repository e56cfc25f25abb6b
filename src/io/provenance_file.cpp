#include "delmesh/io/provenance_file.hpp"

#include "io/output_file.hpp"

#include <fmt/format.h>

#include <iterator>

namespace delmesh {
namespace {

/// Longest text of one item: two ids, a double and punctuation.
constexpr std::size_t item_room = 64;

template <class Items, class Format>
void write_list(io::OutputFile& file, std::string_view name, const Items& items, Format&& format) {
    file.text(fmt::format("\"{}\": [", name));
    bool first = true;
    for (const auto& item : items) {
        char* at = file.room(item_room);
        if (!first) *at++ = ',';
        first = false;
        file.advance(format(at, item));
    }
    file.text("]");
}

}  // namespace

void write_provenance(const std::filesystem::path& path, const Provenance& provenance) {
    io::OutputFile file(path);
    const auto face = [](char* at, FaceId f) { return fmt::format_to(at, "{}", f.value()); };
    file.text(fmt::format("{{\"input_vertices\": {},\n", provenance.input_vertices));
    write_list(file, "splits", provenance.splits, [](char* at, const SplitPoint& split) {
        return fmt::format_to(at, "[{},{},{}]", split.a.value(), split.b.value(), split.t);
    });
    file.text(",\n");
    write_list(file, "facet_of_face", provenance.facet_of_face, face);
    file.text(",\n");
    write_list(file, "facet_of_input_face", provenance.facet_of_input_face, face);
    file.text("}\n");
    file.commit();
}

}  // namespace delmesh
