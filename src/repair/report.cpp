#include "delmesh/repair/repair.hpp"

#include <fmt/format.h>

#include <array>

namespace delmesh {
namespace {

struct Words {
    std::string_view name;
    std::string_view places;
    std::string_view one;   ///< what follows "1 "
    std::string_view many;  ///< what follows "2 "
    std::string_view done;
};

constexpr std::array<Words, defect_kinds> words{{
    {"index_out_of_range", "faces", "face names a vertex that does not exist", "faces name vertices that do not exist",
     "dropped"},
    {"not_finite", "vertices", "vertex is not finite", "vertices are not finite", "dropped"},
    {"face_not_finite", "faces", "face uses a vertex that is not finite", "faces use vertices that are not finite",
     "dropped"},
    {"repeated_vertex", "faces", "face repeats a vertex", "faces repeat a vertex",
     "dropped, or cut down where three vertices remain"},
    {"duplicate_vertex", "vertices", "vertex is at the place of another one",
     "vertices are at the place of another one", "joined"},
    {"near_vertex", "vertices", "vertex is within the tolerance of another one",
     "vertices are within the tolerance of another one", "moved there"},
    {"zero_length_edge", "faces", "face has two corners at one place", "faces have two corners at one place",
     "dropped"},
    {"zero_area", "faces", "face has no area", "faces have no area",
     "flipped away with a neighbour, or dropped at a boundary"},
    {"zero_area_dropped", "faces", "face has no area, nor have its neighbours",
     "faces have no area, nor have their neighbours", "dropped"},
    {"duplicate_face", "faces", "face is at the place of another one", "faces are at the place of another one",
     "dropped"},
    {"non_manifold_edge", "vertex pairs", "edge has more than two faces", "edges have more than two faces",
     "joined in pairs"},
    {"inconsistent_face", "faces", "face does not face the way its component does",
     "faces do not face the way their component does", "turned round"},
    {"non_orientable", "faces", "component can not be oriented", "components can not be oriented", "cut open"},
    {"cut_edge", "vertex pairs", "edge was cut to make the surface orientable",
     "edges were cut to make the surface orientable", "now boundary"},
    {"inside_out", "faces", "closed component faces inwards", "closed components face inwards", "turned round"},
    {"non_manifold_vertex", "vertices", "vertex holds more than one fan of faces",
     "vertices hold more than one fan of faces", "copied for each fan"},
    {"isolated_vertex", "vertices", "vertex has no face", "vertices have no face", "dropped"},
    {"stray_line", "lines", "line repeats another one or has lost an end", "lines repeat others or have lost an end",
     "dropped"},
}};

const Words& words_for(Defect kind) {
    return words[static_cast<std::size_t>(kind)];
}

std::string list_places(const Finding& finding) {
    const bool pairs = places_are(finding.kind) == "vertex pairs";
    const std::size_t step = pairs ? 2 : 1;
    std::string text;
    for (std::size_t i = 0; i + step <= finding.places.size(); i += step) {
        if (i > 0) text += ", ";
        text += pairs ? fmt::format("{}-{}", finding.places[i], finding.places[i + 1])
                      : fmt::format("{}", finding.places[i]);
    }
    if (finding.places.size() / step < finding.count) text += ", ...";
    return text;
}

}  // namespace

std::string_view name(Defect kind) {
    return words_for(kind).name;
}

std::string_view places_are(Defect kind) {
    return words_for(kind).places;
}

std::string sentence(const Finding& finding) {
    const Words& w = words_for(finding.kind);
    return fmt::format("{} {}: {} ({} {})", finding.count, finding.count == 1 ? w.one : w.many, w.done, w.places,
                       list_places(finding));
}

}  // namespace delmesh
