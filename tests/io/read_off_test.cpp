#include "io/io_support.hpp"

namespace delmesh {
namespace {

using Corners = std::vector<std::uint32_t>;

const std::string triangle = "0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n";

void expect_triangle(const std::string& text) {
    SCOPED_TRACE(text);
    const PolygonSoup soup = test::parse(text, "a.off");
    EXPECT_EQ(soup.corners, (Corners{0, 1, 2}));
    ASSERT_EQ(soup.points.size(), 3u);
    EXPECT_EQ(soup.points[0], (Vec3{0, 0, 0}));
    EXPECT_EQ(soup.points[2], (Vec3{0, 1, 0.5}));
    EXPECT_EQ(soup.stored, Precision::float64);
}

TEST(ReadOff, CountsStandInManyWays) {
    for (const char* head :
         {"OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF\n\n# c\n3 1 0 # c\n\n#c\n", "# c\n\nOFF # c\n3 1 0\n", "3 1 0\n",
          "OFF\n3 1\n", "OFF\n3\n1\n3\n", "OFF\n3\n1 0\n", "OFF\r\n3 1 0\r\n", "OFF\n3 1 0 7\n"}) {
        expect_triangle(head + triangle);
    }
}

TEST(ReadOff, WhatElseAVertexCarriesIsPassedOver) {
    expect_triangle("COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 .5 1 0 0\n3 0 1 2\n");
    expect_triangle("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 .5 0 0 1\n3 0 1 2\n");
    expect_triangle(
        "STCNOFF\n3 1 0\n0 0 0 1 1 1 .1 .2 .3 1 0 0\n1 0 0 1 1 1 .1 .2 .3 1 0 0\n0 1 .5 1 1 1 .1 .2 .3 1 0 0\n3 0 1 "
        "2\n");
    expect_triangle("OFF\n3 1 0\n0 0 0 200 0 0\n1 0 0 200 0 0\n0 1 .5 200 0 0\n3 0 1 2\n");
}

TEST(ReadOff, FacesMayHaveColoursAndSpanLines) {
    expect_triangle("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 .5\n3 0 1 2 255 0 0 # red\n");
    expect_triangle("OFF\n3 1 0\n0 0 0\n1 0\n0\n0 1 .5\n3 0\n\n1 # c\n2 0.5 0.5 0.5 1\n");
    const PolygonSoup soup = test::parse("OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 7\n3 0 1 2\n0\n", "a.off");
    EXPECT_EQ(soup.starts, (std::vector<std::size_t>{0, 4, 7, 7}));
}

TEST(ReadOff, OtherDimensions) {
    expect_triangle("4OFF\n3 1 0\n0 0 0 1\n2 0 0 2\n0 -1 -.5 -1\n3 0 1 2\n");
    expect_triangle("nOFF 5\n3 1 0\n0 0 0 8 9\n1 0 0 8 9\n0 1 .5 8 9\n3 0 1 2\n");
    expect_triangle("nOFF\n3\n3 1 0\n" + triangle);
    expect_triangle("4nOFF\n3\n3 1 0\n0 0 0 1\n2 0 0 2\n0 2 1 2\n3 0 1 2\n");
    EXPECT_EQ(test::parse("nOFF 2\n1 0 0\n3 4\n", "a.off").points[0], (Vec3{3, 4, 0}));
}

TEST(ReadOff, ErrorsNameTheLine) {
    test::expect_parse_error("OFF\n3 1 0\n0 0 0\n1 0 0\n", "a.off",
                             "line 5: expected vertex 2 of 3, found the end of the file");
    test::expect_parse_error("OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n", "a.off", "line 4: expected a coordinate, found 'x'");
    test::expect_parse_error("OFF\n1 1 0\n0 0 0\n3 0 0 1\n", "a.off",
                             "line 4: expected a vertex index below 1, found 1", ErrorCode::index_out_of_range);
    test::expect_parse_error("OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", "a.off",
                             "line 4: expected a vertex index below 1, found -1", ErrorCode::index_out_of_range);
    test::expect_parse_error("OFF\n1 1 0\n0 0 0\n-3 0 0 0\n", "a.off",
                             "line 4: expected the number of vertices of a face, found '-3'");
    test::expect_parse_error("OFF\n1 1 0\n0 0 0\n3 0 0\n", "a.off",
                             "line 5: expected a vertex index, found the end of the file");
    test::expect_parse_error("OFF\nx\n", "a.off", "line 2: expected the number of vertices, found 'x'");
    test::expect_parse_error("OFF\n5000000000 0 0\n", "a.off", "line 2: expected fewer than", ErrorCode::too_large);
    test::expect_parse_error("4OFF\n1 0 0\n1 1 1 0\n", "a.off",
                             "line 3: expected a homogeneous coordinate other than 0");
    test::expect_parse_error("nOFF 0\n1 0 0\n", "a.off", "line 1: expected vertices of one dimension or more");
}

// --- binary ---

class Bytes {
public:
    explicit Bytes(bool big) : big_(big) {}
    Bytes& integers(std::initializer_list<std::uint32_t> values) {
        for (const std::uint32_t v : values) add(v);
        return *this;
    }
    Bytes& floats(std::initializer_list<float> values) {
        for (const float v : values) add(std::bit_cast<std::uint32_t>(v));
        return *this;
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void add(std::uint32_t v) {
        for (int i = 0; i < 4; ++i) text_ += static_cast<char>(v >> 8 * (big_ ? 3 - i : i));
    }
    bool big_;
    std::string text_;
};

std::string binary_triangle(bool big, bool colours) {
    Bytes bytes(big);
    bytes.integers({3, 2, 0}).floats({0, 0, 0, 1, 0, 0, 0, 1, 0.5f});
    for (int face = 0; face < 2; ++face) {
        bytes.integers({3, 0, 1, 2});
        if (colours) bytes.integers({3}).floats({0.1f, 0.2f, 0.3f});
    }
    return "OFF BINARY\n" + bytes.text();
}

TEST(ReadOff, BinaryOfEitherDialect) {
    for (const bool big : {true, false}) {
        for (const bool colours : {true, false}) {
            const PolygonSoup soup = test::parse(binary_triangle(big, colours), "a.off");
            EXPECT_EQ(soup.corners, (Corners{0, 1, 2, 0, 1, 2})) << big << colours;
            EXPECT_EQ(soup.points.at(2), (Vec3{0, 1, 0.5}));
            EXPECT_EQ(soup.stored, Precision::float32);
        }
    }
}

TEST(ReadOff, BinaryVerticesMayCarryMore) {
    const std::string text = "STCN4OFF BINARY # c\r\n" + Bytes(true)
                                                             .integers({1, 1, 0})
                                                             .floats({2, 4, 6, 2, 0, 0, 1, 1, 0, 0, 1, 0.5f, 0.5f})
                                                             .integers({3, 0, 0, 0, 0})
                                                             .text();
    const PolygonSoup soup = test::parse(text, "a.off");
    EXPECT_EQ(soup.points.at(0), (Vec3{1, 2, 3}));
    EXPECT_EQ(soup.corners, (Corners{0, 0, 0}));
    EXPECT_EQ(soup.stored, Precision::float64);
}

TEST(ReadOff, BinaryErrorsNameTheByte) {
    std::string text = binary_triangle(true, true);
    test::expect_parse_error(text.substr(0, 40), "a.off",
                             "byte 23: expected 3 vertices, found the end of the file after 1");
    text[11 + 12 + 36 + 7] = 9;
    test::expect_parse_error(text, "a.off", "byte 63: expected a vertex index below 3 in face 0, found 9",
                             ErrorCode::index_out_of_range);
}

}  // namespace
}  // namespace delmesh
