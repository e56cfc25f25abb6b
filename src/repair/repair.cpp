#include "delmesh/repair/repair.hpp"

#include "delmesh/base/error.hpp"
#include "repair/complex.hpp"
#include "repair/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace delmesh {
namespace repairing {
namespace {

/// Joins what meets, cuts what can not be joined, and turns what faces the wrong way. Usually once: what is left of a
/// surface that can not be oriented, or of faces at one place, may look different afterwards, and then it takes until
/// nothing changes any more. Each round drops faces or shortens the cuts, or is the last.
void make_manifold(Complex& complex, const RepairOptions& options, Log& log, const Context* context) {
    std::uint64_t cut_before = std::numeric_limits<std::uint64_t>::max();
    Log later;
    for (bool is_first = true;; is_first = false) {
        EdgeGroups groups(complex);
        const Doubled doubled = remove_duplicates(complex, groups, log);
        if (doubled.dropped) cut_before = std::numeric_limits<std::uint64_t>::max();
        Partners partners = pair_halfedges(complex, groups, is_first ? log : later, context);
        const std::uint64_t cut = orient(complex, groups, partners, log, context);
        separate_fans(complex, groups, partners, log);
        if (open_pillows(complex, partners, log)) {
            cut_before = std::numeric_limits<std::uint64_t>::max();
            continue;
        }
        turn_outward(complex, partners, options.outward, log);
        report_progress(context, "repair", 0.9);
        if ((cut == 0 && !doubled.kept) || cut >= cut_before) return;
        cut_before = cut;
    }
}

/// The soup that comes of a complex, and what is to be said about it.
class Outcome {
public:
    Outcome(const PolygonSoup& input, const Complex& complex, Log& log) : input_(input), complex_(complex), log_(log) {
        number_vertices();
        report_turned_faces();
        report_lost_vertices();
        write_soup();
    }

    /// True if nothing was changed, `triangles` being the corners of the input's triangles.
    [[nodiscard]] bool is_input(const std::vector<Index>& triangles) const {
        const std::size_t n = input_.points.size();
        return soup.points.size() == n && complex_.points.size() == n && soup.corners == triangles &&
               soup.lines == input_.lines && std::equal(soup.points.begin(), soup.points.end(), input_.points.begin());
    }

    PolygonSoup soup;
    std::vector<VertexId> vertex_origin;
    std::vector<FaceId> face_origin;

private:
    void number_vertices() {
        number_.assign(complex_.points.size(), none);
        for (const Index v : complex_.corners) number_[v] = 0;
        Index count = 0;
        for (Index& n : number_)
            if (n != none) n = count++;
    }

    void report_turned_faces() {
        for (std::size_t f = 0; f < complex_.face_count(); ++f)
            if (complex_.turned[f] != 0) log_.add(Defect::inconsistent_face, complex_.origin[f]);
    }

    void report_lost_vertices() {
        std::vector<char> place_kept(complex_.points.size(), 0);
        for (const Index v : complex_.corners) place_kept[complex_.place[v]] = 1;
        for (std::size_t v = 0; v < input_.points.size(); ++v) {
            // Not finite or moved: has been reported.
            if (number_[v] != none || !(complex_.points[v] == input_.points[v]) || !is_finite(input_.points[v]))
                continue;
            log_.add(place_kept[complex_.place[v]] != 0 ? Defect::duplicate_vertex : Defect::isolated_vertex, v);
        }
    }

    void write_soup() {
        soup.stored = input_.stored;
        const auto kept = static_cast<std::size_t>(
            std::count_if(number_.begin(), number_.end(), [](const Index n) { return n != none; }));
        soup.points.reserve(kept);
        vertex_origin.reserve(kept);
        face_origin.reserve(complex_.face_count());
        for (std::size_t v = 0; v < number_.size(); ++v) {
            if (number_[v] == none) continue;
            soup.points.push_back(complex_.points[v]);
            vertex_origin.emplace_back(complex_.source[v]);
        }
        soup.corners.reserve(complex_.corners.size());
        for (const Index v : complex_.corners) soup.corners.push_back(number_[v]);
        for (const Index f : complex_.origin) face_origin.emplace_back(f);
        soup.lines = carry_lines(input_, complex_, number_, log_);
    }

    const PolygonSoup& input_;
    const Complex& complex_;
    Log& log_;
    std::vector<Index> number_;
};

void check_options(const RepairOptions& options) {
    if (options.weld_tolerance_rel >= 0 && options.weld_tolerance_rel <= 1) return;
    throw Error(ErrorCode::bad_argument,
                fmt::format("the tolerance of welding is {}; it must be between 0 and 1", options.weld_tolerance_rel));
}

template <class Id>
std::vector<Id> all_ids(std::size_t count) {
    std::vector<Id> ids;
    ids.reserve(count);
    for (std::size_t i = 0; i < count; ++i) ids.emplace_back(i);
    return ids;
}

/// Does all of it and leaves the input alone; `result` is written only if anything was changed.
RepairReport run(const PolygonSoup& soup, const RepairOptions& options, const Context* context, PolygonSoup& result) {
    Log log;
    report_progress(context, "repair", 0);
    Complex complex = sift(soup, log);
    const bool all_passed = log.findings().empty();
    // Where nothing has been left out of triangles, they are the input's own.
    const std::vector<Index> cut = all_passed && !soup.is_triangles() ? complex.corners : std::vector<Index>();
    check_cancelled(context);
    weld(complex, options.weld_tolerance_rel, log);
    check_cancelled(context);
    report_progress(context, "repair", 0.2);
    remove_degenerate(complex, log, context);
    report_progress(context, "repair", 0.4);
    make_manifold(complex, options, log, context);
    Outcome outcome(soup, complex, log);

    RepairReport report;
    report.changed = !all_passed || !outcome.is_input(soup.is_triangles() ? soup.corners : cut);
    if (report.changed) {
        report.findings = log.findings();
        report.vertex_origin = std::move(outcome.vertex_origin);
        report.face_origin = std::move(outcome.face_origin);
        result = std::move(outcome.soup);
    } else {
        // Polygons stay polygons.
        report.vertex_origin = all_ids<VertexId>(soup.points.size());
        report.face_origin = all_ids<FaceId>(soup.face_count());
    }
    report_progress(context, "repair", 1);
    return report;
}

RepairReport run_unless_cancelled(const PolygonSoup& soup, const RepairOptions& options, const Context* context,
                                  PolygonSoup& result) {
    check_options(options);
    try {
        return run(soup, options, context, result);
    } catch (const Cancelled&) {
        RepairReport report;
        report.cancelled = true;
        return report;
    }
}

}  // namespace
}  // namespace repairing

RepairReport repair(PolygonSoup& soup, const RepairOptions& options, const Context* context) {
    PolygonSoup result;
    RepairReport report = repairing::run_unless_cancelled(soup, options, context, result);
    if (report.changed) soup = std::move(result);
    return report;
}

RepairReport diagnose(const PolygonSoup& soup, const RepairOptions& options, const Context* context) {
    PolygonSoup ignored;
    return repairing::run_unless_cancelled(soup, options, context, ignored);
}

}  // namespace delmesh
