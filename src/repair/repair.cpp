#include "delmesh/repair/repair.hpp"

#include "delmesh/base/error.hpp"
#include "repair/complex.hpp"
#include "repair/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

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
        std::optional<Edges> edges(complex);
        const Doubled doubled = remove_duplicates(complex, *edges, log);
        if (doubled.dropped) {
            edges.emplace(complex);
            cut_before = std::numeric_limits<std::uint64_t>::max();
        }
        Joined joined = pair_halfedges(complex, *edges, is_first ? log : later, context);
        edges.reset();
        const std::uint64_t cut = orient(complex, joined, log, context);
        separate_fans(complex, joined, log);
        if (open_pillows(complex, joined.partners, log)) {
            cut_before = std::numeric_limits<std::uint64_t>::max();
            continue;
        }
        turn_outward(complex, joined.partners, options.outward, log);
        report_progress(context, "repair", 0.9);
        if ((cut == 0 && !doubled.kept) || cut >= cut_before) return;
        cut_before = cut;
    }
}

/// The soup that comes of a complex, which is used up, and what is to be said about it.
class Outcome {
public:
    Outcome(const PolygonSoup& input, Complex& complex, Log& log)
        : input_(input),
          complex_(complex),
          log_(log),
          number_(complex.vertex_count(), none) {
        number_vertices();
        report_turned_faces();
        report_lost_vertices();
        soup_.stored = input_.stored;
        soup_.lines = carry_lines(input_, complex_, number_, log_);
        soup_.corners = std::move(complex_.corners);
        for (Index& v : soup_.corners) v = number_[v];
    }

    /// True if nothing was changed, `triangles` being the corners of the input's triangles.
    [[nodiscard]] bool is_input(const std::vector<Index>& triangles) const {
        const std::size_t n = input_.points.size();
        return kept_ == n && complex_.vertex_count() == n && soup_.corners == triangles &&
               soup_.lines == input_.lines &&
               std::equal(complex_.points.begin(), complex_.points.end(), input_.points.begin());
    }

    /// The soup, once; the report gets where its elements are from.
    [[nodiscard]] PolygonSoup finish(RepairReport& report) {
        soup_.points.reserve(kept_);
        report.vertex_origin.reserve(kept_);
        for (Index v = 0; v < number_.size(); ++v) {
            if (number_[v] == none) continue;
            soup_.points.push_back(complex_.point(v));
            report.vertex_origin.emplace_back(complex_.source(v));
        }
        report.face_origin = std::move(complex_.origin);
        return std::move(soup_);
    }

private:
    void number_vertices() {
        for (const Index v : complex_.corners) number_[v] = 0;
        for (Index& n : number_)
            if (n != none) n = kept_++;
    }

    void report_turned_faces() {
        for (std::size_t f = 0; f < complex_.face_count(); ++f)
            if (complex_.turned[f]) log_.add(Defect::inconsistent_face, complex_.origin[f].index());
    }

    void report_lost_vertices() {
        std::vector<char> place_kept(input_.points.size(), 0);
        for (const Index v : complex_.corners) place_kept[complex_.place(v)] = 1;
        for (Index v = 0; v < input_.points.size(); ++v) {
            // Not finite or moved: has been reported.
            if (number_[v] != none || !(complex_.point(v) == input_.points[v]) || !is_finite(input_.points[v]))
                continue;
            log_.add(place_kept[complex_.place(v)] != 0 ? Defect::duplicate_vertex : Defect::isolated_vertex, v);
        }
    }

    const PolygonSoup& input_;
    Complex& complex_;
    Log& log_;
    std::vector<Index> number_;  ///< of each vertex in the output, or none
    Index kept_ = 0;
    PolygonSoup soup_;
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
        result = outcome.finish(report);
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
