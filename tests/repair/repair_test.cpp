#include "delmesh/repair/repair.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/io/read.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "repair/repair_support.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

namespace delmesh::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

/// The samples are clean but for the faces without area that some are made of; those of the families that are not say
/// so themselves.
TEST(Repair, LeavesCleanMeshesAsTheyAre) {
    for (const SampleInfo& sample : samples()) {
        SCOPED_TRACE(sample.name);
        const PolygonSoup soup = make_sample(sample.name, 500);
        const Repaired out = repair_and_check(soup);
        EXPECT_FALSE(out.report.changed);
        for (std::size_t v = 0; v < soup.points.size(); ++v) EXPECT_EQ(out.report.vertex_origin[v], VertexId(v));
        for (std::size_t f = 0; f < soup.face_count(); ++f) EXPECT_EQ(out.report.face_origin[f], FaceId(f));
    }
}

TEST(Repair, KeepsCleanPolygons) {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 1}};
    soup.add_face(std::vector<std::uint32_t>{0, 1, 2, 3});
    soup.add_face(std::vector<std::uint32_t>{1, 4, 5, 2});
    const Repaired out = repair_and_check(soup);
    EXPECT_FALSE(out.report.changed);
    EXPECT_EQ(out.soup.face_count(), 2U);
}

TEST(Repair, NamesPolygonsAsTheOriginOfTheirTriangles) {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {9, 9, 9}};
    soup.add_face(std::vector<std::uint32_t>{0, 1, 2, 3});
    soup.add_face(std::vector<std::uint32_t>{0, 1});
    soup.add_face(std::vector<std::uint32_t>{4, 5, 2, 2, 1});
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.points.size(), 6U);
    const std::vector<FaceId> origin{FaceId(0), FaceId(0), FaceId(2), FaceId(2)};
    EXPECT_EQ(out.report.face_origin, origin);
    EXPECT_EQ(out.report.count(Defect::repeated_vertex), 2U);
    EXPECT_EQ(out.report.count(Defect::isolated_vertex), 1U);
}

TEST(Repair, DropsWhatIsNotThere) {
    const PolygonSoup soup = triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}, {0, -inf, 0}, {5, 5, 5}},
                                       {{0, 1, 7}, {0, 1, 2}, {0, 1, 3}, {4, 3, 2}, {1, 1, 2}});
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.points.size(), 3U);
    EXPECT_EQ(out.report.face_origin, std::vector<FaceId>{FaceId(1)});
    ASSERT_EQ(out.report.findings.size(), 5U);
    const auto finding = [&](Defect kind, std::vector<std::size_t> places) {
        for (const Finding& f : out.report.findings)
            if (f.kind == kind) return f.places == places && f.count == places.size();
        return false;
    };
    EXPECT_TRUE(finding(Defect::index_out_of_range, {0}));
    EXPECT_TRUE(finding(Defect::not_finite, {3, 4}));
    EXPECT_TRUE(finding(Defect::face_not_finite, {2, 3}));
    EXPECT_TRUE(finding(Defect::repeated_vertex, {4}));
    EXPECT_TRUE(finding(Defect::isolated_vertex, {5}));
}

TEST(Repair, EmptyAndPointsOnly) {
    EXPECT_FALSE(repair_and_check({}).report.changed);
    const Repaired out = repair_and_check(triangles({{0, 0, 0}, {1, 1, 1}}, {}));
    EXPECT_TRUE(out.soup.points.empty());
    EXPECT_EQ(out.report.count(Defect::isolated_vertex), 2U);
}

TEST(Repair, KeepsStoredPrecisionAndLines) {
    PolygonSoup soup = take_apart(make_cube({0, 0, 0}));
    soup.stored = Precision::float32;
    soup.points.push_back({9, 9, 9});
    // Corners 0, 1, 2 are the cube's vertices 0, 2, 3; the last line has lost an end, the second repeats the first at
    // another copy of the vertices, and the fourth is a line on no edge.
    soup.lines = {{0, 1}, {3, 0}, {4, 3}, {1, 8}, {0, 36}};
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.stored, Precision::float32);
    EXPECT_EQ(out.soup.points.size(), 8U);
    for (const auto& line : out.soup.lines) EXPECT_NE(line[0], line[1]);
    EXPECT_EQ(out.report.count(Defect::stray_line) + out.soup.lines.size(), 5U);
    EXPECT_GE(out.report.count(Defect::stray_line), 2U);
}

TEST(Repair, CopiesLinesWithTheirEdges) {
    // Two cubes that share an edge by number: the edge is there twice afterwards, and so is its line.
    PolygonSoup soup = make_cube({0, 0, 0});
    append(soup, make_cube({1, 1, 0}));
    soup = merge_places(soup);
    const PolygonSoup alone = repair_and_check(soup).soup;
    soup.lines = {{3, 7}};
    const Repaired out = repair_and_check(soup);
    EXPECT_EQ(out.soup.corners, alone.corners);
    ASSERT_EQ(out.soup.lines.size(), 2U);
    for (const auto& line : out.soup.lines) {
        EXPECT_EQ(out.soup.points[line[0]], soup.points[3]);
        EXPECT_EQ(out.soup.points[line[1]], soup.points[7]);
    }
}

TEST(Repair, RefusesBadArguments) {
    PolygonSoup soup = make_cube({0, 0, 0});
    EXPECT_THROW(repair(soup, {.weld_tolerance_rel = -1}), Error);
    EXPECT_THROW(repair(soup, {.weld_tolerance_rel = nan}), Error);
    soup.starts = {0, 3, 99};
    EXPECT_THROW(repair(soup), Error);
    soup.starts.clear();
    soup.corners.pop_back();
    EXPECT_THROW(repair(soup), Error);
}

TEST(Repair, LeavesTheSoupAloneWhenCancelled) {
    PolygonSoup soup = take_apart(make_cube({0, 0, 0}));
    const PolygonSoup before = soup;
    Context context;
    context.cancel();
    const RepairReport report = repair(soup, {}, &context);
    EXPECT_TRUE(report.cancelled);
    EXPECT_FALSE(report.changed);
    EXPECT_TRUE(same_bits(soup, before));
}

TEST(Repair, DiagnosisIsTheReportOfTheRepair) {
    PolygonSoup soup = take_apart(make_cube({0, 0, 0}));
    soup.add_face(Triangle{0, 1, 99});
    const PolygonSoup before = soup;
    const RepairReport foreseen = diagnose(soup);
    EXPECT_TRUE(same_bits(soup, before));
    const RepairReport report = repair(soup);
    ASSERT_EQ(foreseen.findings.size(), report.findings.size());
    for (std::size_t i = 0; i < report.findings.size(); ++i)
        EXPECT_EQ(sentence(foreseen.findings[i]), sentence(report.findings[i]));
    EXPECT_FALSE(diagnose(soup).changed);
}

TEST(Repair, TellsItsProgress) {
    std::vector<double> fractions;
    Context context([&](std::string_view, double fraction) { fractions.push_back(fraction); });
    PolygonSoup soup = make_cube({0, 0, 0});
    repair(soup, {}, &context);
    ASSERT_GE(fractions.size(), 2U);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.back(), 1);
}

TEST(Repair, ReportReadsWell) {
    PolygonSoup soup = make_cube({0, 0, 0});
    for (int i = 0; i < 20; ++i) soup.points.push_back({9, 9, 9});
    soup.add_face(Triangle{0, 0, 1});
    const RepairReport report = repair_and_check(soup).report;
    ASSERT_EQ(report.findings.size(), 2U);
    EXPECT_EQ(sentence(report.findings[0]),
              "1 face repeats a vertex: dropped, or cut down where three vertices remain (faces 12)");
    EXPECT_EQ(sentence(report.findings[1]),
              "20 vertices have no face: dropped (vertices 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, "
              "23, ...)");
    std::vector<std::string> names;
    report.visit([&](std::string_view name, std::size_t count, const std::vector<std::size_t>& places, std::string_view,
                     const std::string& text) {
        names.emplace_back(name);
        EXPECT_LE(places.size(), std::min<std::size_t>(count, 16));
        EXPECT_FALSE(text.empty());
    });
    EXPECT_EQ(names, (std::vector<std::string>{"repeated_vertex", "isolated_vertex"}));
    for (std::size_t kind = 0; kind < defect_kinds; ++kind) EXPECT_FALSE(name(static_cast<Defect>(kind)).empty());
}

TEST(Repair, DescribesItsOptions) {
    RepairOptions options;
    int described = 0;
    RepairOptions::describe(options, [&](auto& field, const OptionInfo& info) {
        EXPECT_LE(info.lowest, field);
        EXPECT_LE(field, info.highest);
        EXPECT_FALSE(info.name.empty() || info.help.empty());
        ++described;
    });
    EXPECT_EQ(described, 2);
}

/// Scaling by a power of two changes coordinates only.
TEST(Repair, DoesNotDependOnScale) {
    PolygonSoup soup = make_klein_bottle(12, 8);
    append(soup, make_cube({9, 9, 9}));
    append(soup, make_cube({10, 10, 9}));
    const PolygonSoup expected = repair_and_check(soup).soup;
    for (const int exponent : {-1000, -500, 500, 1000}) {
        SCOPED_TRACE(exponent);
        PolygonSoup scaled = soup;
        for (Vec3& p : scaled.points)
            p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
        EXPECT_EQ(repair(scaled).changed, true);
        EXPECT_EQ(scaled.corners, expected.corners);
    }
}

TEST(Repair, MendsTheMeshesOfTheWild) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(DELMESH_SHARED_DIR) / "meshes" / "wild";
    if (!fs::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
    std::size_t mended = 0;
    for (const fs::directory_entry& file : fs::directory_iterator(folder)) {
        if (file.file_size() > 400'000) continue;
        PolygonSoup soup;
        try {
            soup = read_soup(file.path());
        } catch (const Error&) {
            continue;  // what the readers refuse is their business
        }
        SCOPED_TRACE(file.path().filename());
        repair_and_check(soup);
        ++mended;
    }
    EXPECT_GT(mended, 30U);
}

}  // namespace
}  // namespace delmesh::test
