#include "io/io_support.hpp"

#include <cmath>

namespace delmesh {
namespace {

using Corners = std::vector<std::uint32_t>;

constexpr std::string_view square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

PolygonSoup read_square(const std::string& rest) {
    return test::parse(std::string(square) + rest, "a.obj");
}

void expect_square_error(const std::string& rest, const std::string& message, ErrorCode code = ErrorCode::file_format) {
    test::expect_parse_error(std::string(square) + rest, "a.obj", "a.obj: " + message, code);
}

TEST(ReadObj, EveryFormOfReference) {
    for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//4 2//5 3//6", "f 1/1/1 2/2/2 3/3/3", "f -4 -3 -2",
                             "f -4/-1 -3/-1/-1 -2//-1", "f\t1\t2\t3\t", "f 1/ 2/ 3/", "f 1 2 3 # comment", "f 1 2 3#c",
                             "  f +1 2 3", "f 1 \\\n 2 \\\r\n 3"}) {
        const PolygonSoup soup = read_square(face);
        EXPECT_EQ(soup.corners, (Corners{0, 1, 2})) << face;
        EXPECT_TRUE(soup.is_triangles());
    }
}

TEST(ReadObj, NegativeIndicesCountFromWhereTheyStand) {
    const PolygonSoup soup = test::parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 -2 -3\n", "a.obj");
    EXPECT_EQ(soup.corners, (Corners{0, 1, 2, 3, 2, 1}));
}

TEST(ReadObj, FacesMayComeBeforeTheirVertices) {
    EXPECT_EQ(test::parse("f 1 2 3\n" + std::string(square), "a.obj").corners, (Corners{0, 1, 2}));
}

TEST(ReadObj, PolygonsStayPolygons) {
    const PolygonSoup soup = read_square("f 1 2 3\nf 1 2 3 4\nf 2 3 4\nf 1 2\nf 1");
    ASSERT_EQ(soup.face_count(), 5u);
    EXPECT_EQ(soup.starts, (std::vector<std::size_t>{0, 3, 7, 10, 12, 13}));
    EXPECT_EQ(soup.face(1).size(), 4u);
}

TEST(ReadObj, LinesAreKept) {
    const PolygonSoup soup = read_square("l 1 2 3\nl -1/1 1/2\nl 4\n");
    using Line = std::array<std::uint32_t, 2>;
    EXPECT_EQ(soup.lines, (std::vector<Line>{{0, 1}, {1, 2}, {3, 0}}));
}

TEST(ReadObj, WhatElseVerticesCarryIsPassedOver) {
    const PolygonSoup soup =
        test::parse("v 1 2 3 1.0\nv 4 5 6 0.5 0.5 0.5\nv 7 8 9 # top\nvn 0 0 1\nvt 0 0\n", "a.obj");
    ASSERT_EQ(soup.points.size(), 3u);
    EXPECT_EQ(soup.points[1], (Vec3{4, 5, 6}));
    EXPECT_EQ(soup.stored, Precision::float64);
}

TEST(ReadObj, UnknownKeywordsArePassedOver) {
    EXPECT_EQ(read_square("mtllib a b.mtl\nusemtl x\ng\no name # x\ns off\nvp 1 2\nfoo bar\nf 1 2 3\nfo 1 2 3\nend\n")
                  .face_count(),
              1u);
}

TEST(ReadObj, ByteOrderMarkTabsAndAllLineEnds) {
    for (const char* text :
         {"\xef\xbb\xbfv\t0\t0\t0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
          "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", "v 0 0 0\r\r\nv 1 0 0\r\r\nv 0 1 0\r\r\nf 1 2 3",
          "v 0 0 0\nv 1 0 0\r\nv 0 1 0\nf 1 2 3"}) {
        EXPECT_EQ(test::parse(text, "a.obj").corners, (Corners{0, 1, 2})) << text;
    }
}

TEST(ReadObj, NotFiniteNumbersAreKept) {
    const PolygonSoup soup = test::parse("v inf nan +inf\nv -Inf -NaN 0\n", "a.obj");
    EXPECT_TRUE(std::isinf(soup.points[0].x) && std::isnan(soup.points[0].y));
    EXPECT_TRUE(std::isinf(soup.points[1].x) && std::isnan(soup.points[1].y));
}

TEST(ReadObj, BadIndicesAreNamed) {
    constexpr ErrorCode code = ErrorCode::index_out_of_range;
    expect_square_error("f 1 2 5\nf 1 2 3\n", "line 5: expected a vertex index from 1 to 4, found 5", code);
    expect_square_error("f 1 2 3\n\nf 0 1 2\n", "line 7: expected a vertex index from 1 or from -4 to -1, found 0",
                        code);
    expect_square_error("f 1 2 -5\n", "line 5: expected a vertex index from 1 or from -4 to -1, found -5", code);
    expect_square_error("f 1 2 999999999999\n", "line 5: expected a vertex index", code);
    expect_square_error("l 1 7\n", "line 5: expected a vertex index from 1 to 4, found 7", code);
}

TEST(ReadObj, BrokenLinesAreNamed) {
    expect_square_error("f 1 2 x\n", "line 5: expected a vertex index, found 'x'");
    expect_square_error("f 1 2 3/x\n", "line 5: expected an index, found 'x'");
    expect_square_error("f 1 2 3/1/1/1\n", "line 5: expected an index, found '/1'");
    expect_square_error("f 1.5 2 3\n", "line 5: expected an index, found '.5'");
    expect_square_error("f 99999999999999999999 2 3\n",
                        "line 5: expected a vertex index, found '99999999999999999999'");
    expect_square_error("f\n", "line 5: expected a vertex index, found the end of the line");
    expect_square_error("l # none\n", "line 5: expected a vertex index, found the end of the line");
    expect_square_error("v 1 2\n", "line 5: expected a coordinate, found the end of the line");
    expect_square_error("v 1 2 \\\n 1e999\n", "line 5: expected a coordinate, found '1e999', which is too large");
    expect_square_error(std::string("v 1 2 3\0 4\n", 11), "line 5: expected a coordinate, found '3\\x00'");
}

TEST(ReadObj, TextThatIsNoMesh) {
    test::expect_parse_error("Dear reader,\nthis is a letter.\n", "a.obj", "expected lines 'v X Y Z'");
    EXPECT_EQ(test::parse("# nothing here\n", "a.obj").points.size(), 0u);
}

}  // namespace
}  // namespace delmesh
