#include "io/io_support.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace delmesh {
namespace {

using Corners = std::vector<std::uint32_t>;

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string indices = "property list uchar int vertex_indices\n";

std::string ascii_header(const std::string& rest) {
    return "ply\nformat ascii 1.0\n" + rest + "end_header\n";
}

std::string triangle_file() {
    return ascii_header("element vertex 3\n" + xyz + "element face 1\n" + indices) + "0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n";
}

void expect_triangle(const std::string& text) {
    SCOPED_TRACE(text);
    const PolygonSoup soup = test::parse(text, "a.ply");
    EXPECT_EQ(soup.corners, (Corners{0, 1, 2}));
    ASSERT_EQ(soup.points.size(), 3u);
    EXPECT_EQ(soup.points[2], (Vec3{0, 1, 0.5}));
}

// --- binary files put together value by value ---

class Body {
public:
    explicit Body(bool big) : big_(big) {}
    template <class T>
    Body& add(T value) {
        char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        if (big_ != (std::endian::native == std::endian::big)) std::reverse(bytes, bytes + sizeof(T));
        text_.append(bytes, sizeof(T));
        return *this;
    }
    template <class T>
    Body& list(std::uint8_t count, std::initializer_list<T> values) {
        add(count);
        for (const T v : values) add(v);
        return *this;
    }
    [[nodiscard]] std::string file(const std::string& header) const {
        return std::string("ply\nformat binary_") + (big_ ? "big" : "little") + "_endian 1.0\n" + header +
               "end_header\n" + text_;
    }

private:
    bool big_;
    std::string text_;
};

template <class T>
void expect_coordinates_of_type(const std::string& type, Precision stored) {
    for (const bool big : {false, true}) {
        SCOPED_TRACE(type + (big ? " big" : " little"));
        Body body(big);
        for (const int v : {1, 2, 3, 4, 5, 127}) body.add(static_cast<T>(v)).add(std::uint8_t{9});
        std::string header = "element vertex 2\n";
        for (const char* axis : {"x", "y", "z"})
            header += "property " + type + " " + axis + "\nproperty uchar q" + axis + "\n";
        const PolygonSoup soup = test::parse(body.file(header), "a.ply");
        ASSERT_EQ(soup.points.size(), 2u);
        EXPECT_EQ(soup.points[0], (Vec3{1, 2, 3}));
        EXPECT_EQ(soup.points[1], (Vec3{4, 5, 127}));
        EXPECT_EQ(soup.stored, stored);
    }
}

TEST(ReadPly, CoordinatesOfEveryType) {
    expect_coordinates_of_type<float>("float", Precision::float32);
    expect_coordinates_of_type<float>("float32", Precision::float32);
    expect_coordinates_of_type<double>("double", Precision::float64);
    expect_coordinates_of_type<double>("float64", Precision::float64);
    expect_coordinates_of_type<std::int8_t>("char", Precision::float32);
    expect_coordinates_of_type<std::uint8_t>("uint8", Precision::float32);
    expect_coordinates_of_type<std::int16_t>("short", Precision::float32);
    expect_coordinates_of_type<std::uint16_t>("ushort", Precision::float32);
    expect_coordinates_of_type<std::int32_t>("int", Precision::float64);
    expect_coordinates_of_type<std::uint32_t>("uint32", Precision::float64);
    expect_coordinates_of_type<std::int64_t>("int64", Precision::float64);
    expect_coordinates_of_type<std::uint64_t>("uint64", Precision::float64);
}

template <class Count, class Index>
void expect_faces_of_type(const std::string& count_type, const std::string& index_type) {
    for (const bool big : {false, true}) {
        SCOPED_TRACE(count_type + " " + index_type);
        Body body(big);
        for (int i = 0; i < 4 * 3; ++i) body.add(static_cast<double>(i));
        body.add(std::uint16_t{77}).add(static_cast<Count>(3));
        for (const int v : {3, 1, 2}) body.add(static_cast<Index>(v));
        body.add(static_cast<Count>(2)).add(1.5f).add(2.5f).add(std::uint8_t{1});
        body.add(std::uint16_t{77}).add(static_cast<Count>(4));
        for (const int v : {0, 1, 2, 3}) body.add(static_cast<Index>(v));
        body.add(static_cast<Count>(0)).add(std::uint8_t{1});
        const PolygonSoup soup = test::parse(
            body.file("element vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face 2\n"
                      "property ushort flags\nproperty list " +
                      count_type + " " + index_type + " vertex_index\nproperty list " + count_type +
                      " float texcoord\nproperty uchar red\n"),
            "a.ply");
        EXPECT_EQ(soup.corners, (Corners{3, 1, 2, 0, 1, 2, 3}));
        EXPECT_EQ(soup.starts, (std::vector<std::size_t>{0, 3, 7}));
    }
}

TEST(ReadPly, FacesOfEveryType) {
    expect_faces_of_type<std::uint8_t, std::int32_t>("uchar", "int");
    expect_faces_of_type<std::int8_t, std::uint32_t>("char", "uint");
    expect_faces_of_type<std::uint16_t, std::uint16_t>("ushort", "ushort");
    expect_faces_of_type<std::int16_t, std::int16_t>("short", "short");
    expect_faces_of_type<std::int32_t, std::uint8_t>("int", "uchar");
    expect_faces_of_type<std::uint32_t, std::int8_t>("uint", "char");
    expect_faces_of_type<std::int64_t, std::uint64_t>("int64", "uint64");
    expect_faces_of_type<std::uint64_t, std::int64_t>("uint64", "int64");
}

TEST(ReadPly, BinaryElementsInAnyOrderAndUnknownOnesBetween) {
    for (const bool big : {false, true}) {
        Body body(big);
        body.list<std::int32_t>(3, {0, 1, 2});
        body.list<float>(2, {1, 2}).add(5.0).list<float>(0, {}).add(6.0);
        body.add(std::uint16_t{1}).add(std::uint16_t{2});
        for (int i = 0; i < 3; ++i)
            body.list<float>(1, {9}).add(static_cast<float>(i)).add(std::int8_t{3}).add(0.5).add(2.0f);
        const PolygonSoup soup = test::parse(
            body.file(
                "element face 1\n" + indices +
                "element odd 2\nproperty list uchar float a\nproperty double b\nelement edge 1\nproperty ushort v1\n"
                "property ushort v2\nelement nothing 1000000000000\nelement vertex 3\nproperty list uchar float tags\n"
                "property float x\nproperty char c\nproperty double y\nproperty float z\n"),
            "a.ply");
        EXPECT_EQ(soup.corners, (Corners{0, 1, 2}));
        ASSERT_EQ(soup.points.size(), 3u);
        EXPECT_EQ(soup.points[2], (Vec3{2, 0.5, 2}));
        EXPECT_EQ(soup.stored, Precision::float64);
    }
}

// Every other triangle of a strip is turned, -1 starts anew, repeated vertices join pieces.

TEST(ReadPly, BinaryTriangleStrips) {
    for (const bool big : {false, true}) {
        Body body(big);
        for (int i = 0; i < 5 * 3; ++i) body.add(static_cast<float>(i));
        body.add(std::int32_t{15});
        for (const std::int32_t v : {0, 1, 2, 3, 4, -1, 0, 2, 1, 1, 1, 4, -1, 3, 2}) body.add(v);
        const PolygonSoup soup = test::parse(
            body.file("element vertex 5\n" + xyz + "element tristrips 1\nproperty list int int vertex_indices\n"),
            "a.ply");
        EXPECT_EQ(soup.corners, (Corners{0, 1, 2, 2, 1, 3, 2, 3, 4, 0, 2, 1}));
    }
}

TEST(ReadPly, AsciiTriangleStrips) {
    const PolygonSoup soup = test::parse(
        ascii_header("element vertex 5\n" + xyz + "element tristrips 2\nproperty list int int vertex_indices\n") +
            "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n5 0 1 2 3 4\n7 4 4 4 -1 0 2 1\n",
        "a.ply");
    EXPECT_EQ(soup.corners, (Corners{0, 1, 2, 2, 1, 3, 2, 3, 4, 0, 2, 1}));
}

TEST(ReadPly, StripsHaveOneOrientation) {
    // A strip over a flat band: all triangles must turn the same way.
    std::string points;
    std::string list = "20";
    for (int i = 0; i < 20; ++i) {
        points += std::to_string(i / 2) + " " + std::to_string(i % 2) + " 0\n";
        list += " " + std::to_string(i);
    }
    const PolygonSoup soup = test::parse(
        ascii_header("element vertex 20\n" + xyz + "element tristrips 1\nproperty list int int vertex_indices\n") +
            points + list + "\n",
        "a.ply");
    ASSERT_EQ(soup.face_count(), 18u);
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const auto t = soup.face(f);
        const Vec3 a = soup.points[t[0]];
        EXPECT_LT(cross(soup.points[t[1]] - a, soup.points[t[2]] - a).z, 0) << f;
    }
}

TEST(ReadPly, LineEndsCommentsAndSpaces) {
    expect_triangle(triangle_file());
    std::string windows = triangle_file();
    for (std::size_t i = 0; (i = windows.find('\n', i)) != windows.npos; i += 2) windows.insert(i, "\r");
    expect_triangle(windows);
    std::string mac = triangle_file();
    std::ranges::replace(mac, '\n', '\r');
    expect_triangle(mac);
    expect_triangle(
        "ply\nformat ascii 1.0\ncomment element face x\nobj_info a b\nelement  vertex   3 \nproperty float x\n"
        "property float y\nproperty float z\nproperty uchar red\n\nelement face 1\nproperty list uchar int "
        "vertex_index\nend_header\n0 0 0 1\n\n1 0 0 2\n0 1 .5 3\n3 0 1 2");
}

TEST(ReadPly, BinaryBehindAnyHeader) {
    Body body(false);
    for (const float v : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.5f}) body.add(v);
    body.list<std::int32_t>(3, {0, 1, 2});
    const std::string text = body.file("element vertex 3\n" + xyz + "element face 1\n" + indices);
    expect_triangle(text);
    const std::size_t end = text.find("end_header\n") + 10;
    expect_triangle(text.substr(0, end) + "\r" + text.substr(end));
    std::string mac = text;
    std::replace(mac.begin(), mac.begin() + static_cast<std::ptrdiff_t>(end) + 1, '\n', '\r');
    expect_triangle(mac);
}

TEST(ReadPly, AsciiRecordsBeginOnTheirLines) {
    const std::string header =
        ascii_header("element vertex 3\n" + xyz + "element face 2\n" + indices + "property uchar red\n");
    const PolygonSoup soup =
        test::parse(header + "0 0 0 9 9\n1 0\n0\n0 1 0\n3 0 1 2 255 255 255\n3 0\n2 1\n7\n", "a.ply");
    EXPECT_EQ(soup.corners, (Corners{0, 1, 2, 0, 2, 1}));
}

TEST(ReadPly, AsciiFloatsAreFloatsAndDoublesAreDoubles) {
    const std::string body = "0.1 1e-50 16777217\n";
    const PolygonSoup floats = test::parse(ascii_header("element vertex 1\n" + xyz) + body, "a.ply");
    EXPECT_EQ(floats.points[0], (Vec3{static_cast<double>(0.1f), 0, 16777216}));
    EXPECT_EQ(floats.stored, Precision::float32);
    const PolygonSoup doubles = test::parse(
        ascii_header("element vertex 1\nproperty double x\nproperty double y\nproperty double z\n") + body, "a.ply");
    EXPECT_EQ(doubles.points[0], (Vec3{0.1, 1e-50, 16777217}));
    EXPECT_EQ(doubles.stored, Precision::float64);
    const PolygonSoup mixed = test::parse(
        ascii_header("element vertex 1\nproperty float x\nproperty double y\nproperty float z\n") + body, "a.ply");
    EXPECT_EQ(mixed.points[0], (Vec3{static_cast<double>(0.1f), 1e-50, 16777216}));
    EXPECT_EQ(mixed.stored, Precision::float64);
    EXPECT_TRUE(
        std::isnan(test::parse(ascii_header("element vertex 1\n" + xyz) + "nan -inf 0\n", "a.ply").points[0].x));
}

TEST(ReadPly, FacesOfOtherNamesAndEmptyElements) {
    const std::string vertices = "element vertex 3\n" + xyz;
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_EQ(
        test::parse(ascii_header(vertices + "element face 1\nproperty list uchar int corners\n") + points + "3 2 1 0\n",
                    "a.ply")
            .corners,
        (Corners{2, 1, 0}));
    EXPECT_EQ(test::parse(ascii_header(vertices) + points, "a.ply").face_count(), 0u);
    EXPECT_EQ(test::parse(ascii_header(vertices + "element face 0\n") + points, "a.ply").points.size(), 3u);
    EXPECT_EQ(test::parse(ascii_header("element vertex 0\n" + xyz + "element face 0\nproperty uchar red\n"), "a.ply")
                  .points.size(),
              0u);
}

void expect_header_error(const std::string& text, const std::string& message) {
    test::expect_parse_error(text, "a.ply", "a.ply: " + message);
}

TEST(ReadPly, HeaderErrorsNameTheLine) {
    const std::string start = "ply\nformat ascii 1.0\n";
    expect_header_error("plyx\n", "line 1: expected 'ply' at the start of the file");
    expect_header_error("ply\nformat text 1.0\n",
                        "line 2: expected ascii, binary_little_endian or binary_big_endian, found 'text'");
    expect_header_error("ply\nformat ascii 2.0\n", "line 2: expected format version 1.0, found '2.0'");
    expect_header_error("ply\nelement vertex 1\n" + xyz + "end_header\n", "line 6: expected a line 'format ...'");
    expect_header_error(start + "element vertex\n", "line 3: expected a count, found the end of the line");
    expect_header_error(start + "element vertex -1\n", "line 3: expected a count, found '-1'");
    expect_header_error(start + "element vertex 1e3\n", "line 3: expected a count, found '1e3'");
    expect_header_error(start + "property float x\n", "line 3: expected an element before its properties");
    expect_header_error(start + "element vertex 1\nproperty real x\n", "line 4: expected a type, found 'real'");
    expect_header_error(start + "element vertex 1\nproperty float\n",
                        "line 4: expected a name, found the end of the line");
    expect_header_error(start + "element face 1\nproperty list float int v\n",
                        "line 4: expected an integer type, found 'float'");
    expect_header_error(start + "vertices 1\n", "line 3: expected a keyword of a PLY header, found 'vertices'");
    expect_header_error(start + "element vertex 1\n" + xyz, "line 7: expected 'end_header', found the end of the file");
    expect_header_error(start + "element vertex 1\nproperty float x\nproperty float y\nend_header\n",
                        "line 6: expected the vertices to have the properties x, y and z, found no z");
    expect_header_error(
        start + "element vertex 1\nproperty float x\nproperty float y\nproperty list uchar float z\nend_header\n",
        "line 7: expected the vertices to have the properties x, y and z, found no z");
    expect_header_error(start + "element face 1\n" + indices + "end_header\n", "line 5: expected an element 'vertex'");
    expect_header_error(start + "element vertex 1\n" + xyz + "element vertex 1\n" + xyz + "end_header\n",
                        "line 11: expected one vertex element, found two");
    expect_header_error(
        start + "element vertex 1\n" + xyz + "element face 1\nproperty list uchar float vertex_indices\nend_header\n",
        "line 9: expected a list of integers 'vertex_indices' in element 'face', found none");
    test::expect_parse_error(start + "element vertex 4294967295\n" + xyz + "end_header\n", "a.ply",
                             "expected fewer than 4294967295 vertices", ErrorCode::too_large);
}

TEST(ReadPly, AsciiBodyErrorsNameTheLine) {
    const std::string header = ascii_header("element vertex 2\n" + xyz + "element face 1\n" + indices);  // 9 lines
    const auto expect = [&](const std::string& body, const std::string& message,
                            ErrorCode code = ErrorCode::file_format) {
        test::expect_parse_error(header + body, "a.ply", message, code);
    };
    expect("0 0 0\n", "line 11: expected vertex 1 of 2, found the end of the file");
    expect("0 0 0\n1 1", "line 12: expected a coordinate, found the end of the file");
    expect("0 0 0\n1 1 y\n", "line 11: expected a coordinate, found 'y'");
    expect("0 0 0\n1 1 1e39\n", "line 11: expected a coordinate of type float, found 1e+39, which is too large");
    expect("0 0 0\n1 1 1\n", "line 12: expected face 0 of 1, found the end of the file");
    expect("0 0 0\n1 1 1\n3 0 1 2\n", "line 12: expected a vertex index below 2, found 2",
           ErrorCode::index_out_of_range);
    expect("0 0 0\n1 1 1\n3 0 -1 1\n", "line 12: expected a vertex index below 2, found -1",
           ErrorCode::index_out_of_range);
    expect("0 0 0\n1 1 1\n-3 0 1 1\n", "line 12: expected the length of a list, found -3");
    expect("0 0 0\n1 1 1\n4000000000 0 1\n", "line 13: expected a vertex index, found the end of the file");
    expect("0 0 0\n1 1 1\n3 0 1.0 1\n", "line 12: expected a vertex index, found '1.0'");
}

TEST(ReadPly, BinaryBodyErrorsNameTheByte) {
    Body body(false);
    for (int i = 0; i < 6; ++i) body.add(1.0f);
    const std::string header = "element vertex 2\n" + xyz + "element face 2\n" + indices;
    const std::size_t start = body.file(header).size();
    const auto at = [start](std::size_t bytes) { return "byte " + std::to_string(start + bytes) + ": "; };
    const std::string no_faces = body.file(header);
    test::expect_parse_error(
        no_faces.substr(0, start - 1), "a.ply",
        "byte " + std::to_string(start - 1) + ": expected vertex 1 of 2, found the end of the file");
    test::expect_parse_error(no_faces, "a.ply", at(0) + "expected face 0 of 2, found the end of the file");
    body.list<std::int32_t>(3, {0, 1, 1});
    const std::string one_face = body.file(header);
    test::expect_parse_error(one_face + std::string(1, '\x03'), "a.ply",
                             at(14) + "expected 3 values in a list of face 1 of 2, found 0 before");
    Body bad = body;
    bad.list<std::int32_t>(3, {0, 2, 1});
    test::expect_parse_error(bad.file(header), "a.ply", at(18) + "expected a vertex index below 2 in face 1, found 2",
                             ErrorCode::index_out_of_range);
    bad = body;
    bad.list<std::int32_t>(3, {0, 1, -1});
    test::expect_parse_error(bad.file(header), "a.ply", at(22) + "expected a vertex index below 2 in face 1, found -1",
                             ErrorCode::index_out_of_range);
    const std::string signed_counts =
        "element vertex 0\n" + xyz + "element face 1\nproperty list char int vertex_indices\n";
    test::expect_parse_error(Body(false).add(std::int8_t{-3}).file(signed_counts), "a.ply",
                             "expected the length of a list in face 0 of 1, found -3");
}

TEST(ReadPly, SkippedElementsMustBeThere) {
    for (const char* list : {"property double a\n", "property list uchar double a\n"}) {
        const std::string header = std::string("element odd 3\n") + list + "element vertex 0\n" + xyz;
        test::expect_parse_error(Body(false).list<double>(1, {1}).file(header), "a.ply", "of 3, found");
    }
}

}  // namespace
}  // namespace delmesh
