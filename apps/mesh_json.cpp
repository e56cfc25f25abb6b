#include "mesh_json.hpp"

#include <fmt/format.h>

namespace delmesh::app {

Measured measure(const Mesh& mesh, const Context* context) {
    Measured measured{measure_size(mesh), certify(mesh, context), measure_angles(mesh, context), {}};
    if (measured.certificate.worst_edge) {
        const HalfedgeId h = Mesh::halfedge(*measured.certificate.worst_edge);
        measured.worst_edge = {mesh.origin(h).index(), mesh.target(h).index()};
    }
    return measured;
}

Json to_json(const Measured& measured) {
    const MeshSize& size = measured.size;
    const Certificate& certificate = measured.certificate;
    const AngleStatistics& angles = measured.angles;
    Json json;
    json["mesh"] = {{"vertices", size.vertices},     {"edges", size.edges},
                    {"faces", size.faces},           {"boundary_edges", size.boundary_edges},
                    {"components", size.components}, {"euler", size.euler}};
    json["delaunay"] = {{"certified", certificate.certified},
                        {"non_delaunay_edges", certificate.non_delaunay_edges},
                        {"obtuse_boundary_edges", certificate.obtuse_boundary_edges},
                        {"degenerate_faces", certificate.degenerate_faces},
                        {"worst_excess_deg", certificate.worst_excess_deg},
                        {"worst_edge", measured.worst_edge.empty() ? Json() : Json(measured.worst_edge)},
                        {"exact_edges", certificate.exact_edges}};
    json["quality"] = {{"min_angle_deg", angles.min_angle_deg},
                       {"max_angle_deg", angles.max_angle_deg},
                       {"small_angles_percent", angles.small_angles_percent},
                       {"large_angles_percent", angles.large_angles_percent}};
    return json;
}

std::string verdict(const Measured& measured) {
    const Certificate& certificate = measured.certificate;
    if (certificate.certified)
        return fmt::format("Delaunay: all {} edges hold, checked exactly", with_commas(measured.size.edges));
    std::string text = "not Delaunay:";
    if (certificate.non_delaunay_edges > 0)
        text += fmt::format(" {} interior edges have opposite angles above 180 degrees in sum;",
                            with_commas(certificate.non_delaunay_edges));
    if (certificate.obtuse_boundary_edges > 0)
        text += fmt::format(" {} boundary edges face an obtuse angle;", with_commas(certificate.obtuse_boundary_edges));
    if (certificate.degenerate_faces > 0)
        text += fmt::format(" {} faces have no area;", with_commas(certificate.degenerate_faces));
    if (!measured.worst_edge.empty())
        text += fmt::format(" worst: {:.4g} degrees too much at the edge between vertices {} and {};",
                            certificate.worst_excess_deg, measured.worst_edge[0], measured.worst_edge[1]);
    text.pop_back();
    return text;
}

std::string comparison_table(const std::vector<std::string>& titles, const std::vector<Measured>& columns) {
    std::vector<std::vector<std::string>> rows{{""}};
    rows[0].insert(rows[0].end(), titles.begin(), titles.end());
    const auto row = [&](const std::string& title, auto&& cell) {
        rows.push_back({title});
        for (const Measured& measured : columns) rows.back().push_back(cell(measured));
    };
    row("vertices", [](const Measured& m) { return with_commas(m.size.vertices); });
    row("edges", [](const Measured& m) { return with_commas(m.size.edges); });
    row("faces", [](const Measured& m) { return with_commas(m.size.faces); });
    row("boundary edges", [](const Measured& m) { return with_commas(m.size.boundary_edges); });
    row("non-Delaunay edges", [](const Measured& m) { return with_commas(m.certificate.non_delaunay_edges); });
    row("obtuse boundary edges", [](const Measured& m) { return with_commas(m.certificate.obtuse_boundary_edges); });
    row("worst excess, degrees",
        [](const Measured& m) { return fmt::format("{:.4g}", m.certificate.worst_excess_deg); });
    row("smallest angle, degrees", [](const Measured& m) { return fmt::format("{:.4g}", m.angles.min_angle_deg); });
    row("largest angle, degrees", [](const Measured& m) { return fmt::format("{:.4g}", m.angles.max_angle_deg); });
    row("angles under 30 degrees",
        [](const Measured& m) { return fmt::format("{:.2f} %", m.angles.small_angles_percent); });
    row("angles over 120 degrees",
        [](const Measured& m) { return fmt::format("{:.2f} %", m.angles.large_angles_percent); });
    row("certified", [](const Measured& m) { return std::string(m.certificate.certified ? "yes" : "no"); });
    return format_table(rows);
}

}  // namespace delmesh::app
