#include "io/endian.hpp"
#include "io/io_support.hpp"

#include <cmath>
#include <limits>

namespace delmesh {
namespace {

using Corners = std::vector<std::uint32_t>;

std::string binary_stl(const std::vector<std::array<Vec3, 3>>& facets, std::string header = "binary") {
    header.resize(80);
    char number[4];
    const auto add = [&](auto value) { header.append(number, io::store(number, value)); };
    add(static_cast<std::uint32_t>(facets.size()));
    for (const auto& facet : facets) {
        for (int i = 0; i < 3; ++i) add(0.0f);
        for (const Vec3& p : facet) {
            for (const int axis : {0, 1, 2}) add(static_cast<float>(p[axis]));
        }
        header += "ab";
    }
    return header;
}

const std::vector<std::array<Vec3, 3>> two_facets{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}}},
                                                  {{{0, 1, 0.1}, {1, 0, 0}, {1, 1, 0}}}};

const std::string facet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0.1\n endloop\nendfacet\n";

TEST(ReadStl, BinaryIsWeldedInOrderOfAppearance) {
    for (const char* header : {"binary", "solid looks like text", "", "ply"}) {
        const PolygonSoup soup = test::parse(binary_stl(two_facets, header), "a.stl");
        EXPECT_EQ(soup.corners, (Corners{0, 1, 2, 2, 1, 3}));
        ASSERT_EQ(soup.points.size(), 4u);
        EXPECT_EQ(soup.points[2].z, static_cast<double>(0.1f));
        EXPECT_EQ(soup.stored, Precision::float32);
    }
}

TEST(ReadStl, SolidHeaderIsSeenThroughWithoutASize) {
    const std::string bytes = binary_stl(two_facets, "solid part");
    EXPECT_EQ(test::parse_dripping(bytes, "a.stl", 7, 16).face_count(), 2u);
    EXPECT_EQ(test::parse_dripping("solid x\n" + facet + "endsolid\n", "pipe", 7, 16).face_count(), 1u);
    EXPECT_EQ(test::parse(bytes + "trailing", "a.stl").face_count(), 2u);
}

TEST(ReadStl, ZerosAreWeldedAndNansAreKept) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const PolygonSoup soup = test::parse(binary_stl({{{{0, 0, 0}, {-0.0, 0, -0.0}, {nan, 0, 0}}}}), "a.stl");
    EXPECT_EQ(soup.corners, (Corners{0, 0, 1}));
    EXPECT_TRUE(std::isnan(soup.points[1].x));
}

TEST(ReadStl, AsciiKeepsDoubles) {
    const PolygonSoup soup = test::parse("solid a name\n" + facet + facet + "endsolid a name\n", "a.stl");
    EXPECT_EQ(soup.corners, (Corners{0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(soup.points[2].z, 0.1);
    EXPECT_EQ(soup.stored, Precision::float64);
}

TEST(ReadStl, SeveralSolidsAreOneSoup) {
    const std::string text = "solid one\n" + facet + "endsolid one\n\nsolid\n" + facet + "endsolid\n";
    EXPECT_EQ(test::parse(text, "a.stl").face_count(), 2u);
}

TEST(ReadStl, AsciiDialects) {
    std::string upper = "solid x\n" + facet + "endsolid x\n";
    for (char& c : upper) c = static_cast<char>(std::toupper(c));
    std::string one_line = "solid x\n" + facet;
    for (char& c : one_line) c = c == '\n' && &c != &one_line[7] ? ' ' : c;
    std::string windows = "solid x\n" + facet + "endsolid x\n";
    for (std::size_t i = 0; (i = windows.find('\n', i)) != windows.npos; i += 2) windows.insert(i, "\r");
    for (const std::string& text : {upper, one_line + "endsolid\n", windows, "  solid\n" + facet + "endsolid",
                                    "solid\ncolor 1 0 0\n" + facet + "end\\solid"}) {
        SCOPED_TRACE(text);
        if (text.ends_with("end\\solid")) {
            test::expect_parse_error(text, "a.stl", "expected 'facet' or 'endsolid', found 'end\\solid'");
        } else {
            EXPECT_EQ(test::parse(text, "a.stl").face_count(), 1u);
        }
    }
}

TEST(ReadStl, FacetsOfMoreThanThreeVertices) {
    const PolygonSoup soup = test::parse(
        "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
        "0\nendloop\nendfacet\nendsolid\n",
        "a.stl");
    EXPECT_EQ(soup.starts, (std::vector<std::size_t>{0, 4}));
}

TEST(ReadStl, ErrorsNameThePlace) {
    const std::string bytes = binary_stl(two_facets);
    test::expect_parse_error(bytes.substr(0, bytes.size() - 1), "a.stl",
                             "byte 80: expected the number of facets that follow, found 2, but the file holds 1");
    test::expect_parse_error(bytes.substr(0, 83), "a.stl", "byte 83: expected 80 bytes of header");
    // Where the size is not known, the end comes as a surprise.
    const std::string many = binary_stl(std::vector(2000, two_facets.front()));
    test::expect_error([&] { (void)test::parse_dripping(many.substr(0, 84 + 1999 * 50 + 16), "a.stl", 500, 1600); },
                       ErrorCode::file_format, "byte 100050: expected facet 1999 of 2000, found the end of the file");
    test::expect_parse_error("solid\n" + facet, "a.stl",
                             "line 9: expected 'facet' or 'endsolid', found the end of the file");
    test::expect_parse_error("solid\n" + facet.substr(0, 40), "a.stl",
                             "line 4: expected a coordinate, found the end of the line");
    test::expect_parse_error("solid\n" + facet.substr(0, 50), "a.stl",
                             "line 5: expected 'vertex' or 'endloop', found 've'");
    test::expect_parse_error("solid\n" + facet.substr(0, 46), "a.stl",
                             "line 5: expected 'vertex' or 'endloop', found the end of the file");
    test::expect_parse_error("solid\nfacet\nouter loop\nvertex 1 2 3\nendloop\nendfacet\n", "a.stl",
                             "line 5: expected a facet of three vertices, found 1");
    test::expect_parse_error("solid\nfacet\nouter loop\nvertex 1 2\n", "a.stl",
                             "line 4: expected a coordinate, found the end of the line");
    test::expect_parse_error("solid\nfacet\nouter space\n", "a.stl", "line 3: expected 'outer loop', found 'space'");
    test::expect_parse_error("solid\n" + facet + "endsolid\n" + facet, "a.stl",
                             "line 10: expected 'solid', found 'facet'");
}

}  // namespace
}  // namespace delmesh
