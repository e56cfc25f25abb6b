#include "delmesh/mesh/rounding.hpp"
#include "io/io_support.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace delmesh {
namespace {

struct Case {
    const char* name;
    Format format;
    Precision precision;
    bool ascii;
};

constexpr std::array cases{Case{"ply", Format::ply, Precision::float64, false},
                           Case{"ply float", Format::ply, Precision::float32, false},
                           Case{"ply ascii", Format::ply, Precision::float64, true},
                           Case{"ply ascii float", Format::ply, Precision::float32, true},
                           Case{"obj", Format::obj, Precision::float64, false},
                           Case{"obj float", Format::obj, Precision::float32, false},
                           Case{"off", Format::off, Precision::float64, false},
                           Case{"off float", Format::off, Precision::float32, false},
                           Case{"stl", Format::stl, Precision::float32, false},
                           Case{"stl ascii", Format::stl, Precision::float32, true}};

/// Any finite double: all exponents, denormals, both zeros.
double any_double(test::Random& random) {
    constexpr std::array special{0.0, -0.0, 1e300, -1e300, 5e-324, 0x1.fffffffffffffp+1023, 0x1p-1022, 0.1};
    if (random.below(4) == 0) return special[random.below(special.size())];
    double value = 0;
    do {
        value = std::bit_cast<double>(random.bits());
    } while (!std::isfinite(value));
    return value;
}

double any_float(test::Random& random) {
    constexpr std::array special{0.0f, -0.0f, 1e38f, 1e-45f, 3.40282347e38f, 0.1f, 16777217.0f};
    if (random.below(4) == 0) return special[random.below(special.size())];
    float value = 0;
    do {
        value = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()));
    } while (!std::isfinite(value));
    return value;
}

/// Faces that use each point, first of all in the order of their numbers: what welding gives back unchanged.
PolygonSoup random_soup(test::Random& random, const Case& c) {
    PolygonSoup soup;
    const std::size_t triangles = random.below(40);
    for (std::size_t i = 0; i < 3 * triangles; ++i) {
        Vec3 p;
        for (const int axis : {0, 1, 2})
            p[axis] = c.precision == Precision::float32 ? any_float(random) : any_double(random);
        if (c.format == Format::stl) p.x = static_cast<double>(i + 1);  // no two points are equal
        soup.points.push_back(p);
        soup.corners.push_back(static_cast<std::uint32_t>(i));
    }
    if (triangles == 0) return soup;
    for (std::size_t i = random.below(100); i > 0; --i) {
        std::array<std::uint32_t, 5> face;
        for (std::uint32_t& v : face) v = static_cast<std::uint32_t>(random.below(soup.points.size()));
        soup.add_face(std::span(face).first(c.format == Format::stl ? 3 : 1 + random.below(5)));
    }
    if (c.format == Format::obj) soup.lines.push_back({0, static_cast<std::uint32_t>(soup.points.size() - 1)});
    return soup;
}

TEST(Write, RoundTripsBitForBit) {
    const test::TestFolder folder;
    test::Random random(1);
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        const auto path = folder / (std::string("mesh.") + std::string(name(c.format)));
        for (int round = 0; round < 50; ++round) {
            const PolygonSoup soup = random_soup(random, c);
            write_soup(path, soup, {.format = std::nullopt, .precision = c.precision, .ascii = c.ascii});
            const PolygonSoup back = read_soup(path);
            ASSERT_TRUE(test::same_soup(back, soup)) << test::read_bytes(path);
            const bool declared =
                c.precision == Precision::float32 && (c.format == Format::ply || (c.format == Format::stl && !c.ascii));
            EXPECT_EQ(back.stored, declared ? Precision::float32 : Precision::float64);
        }
    }
}

PolygonSoup tetrahedron() {
    PolygonSoup soup;
    soup.points = {{0.1, 0, 0}, {1, 0.2, 0}, {0, 1, 0.3}, {1.0 / 3, 0, 1}};
    soup.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    return soup;
}

TEST(Write, MeshesAndTheirSoupsGiveTheSameBytes) {
    const test::TestFolder folder;
    PolygonSoup soup = tetrahedron();
    round_to_float(soup);
    const Mesh mesh(soup);
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        const WriteOptions options{.format = c.format, .precision = c.precision, .ascii = c.ascii};
        write_mesh(folder / "mesh", mesh, options);
        write_soup(folder / "soup", soup, options);
        EXPECT_EQ(test::read_bytes(folder / "mesh"), test::read_bytes(folder / "soup"));
        EXPECT_EQ(read_soup(folder / "mesh").face_count(), 4u);
    }
}

TEST(Write, LargePolygons) {
    const test::TestFolder folder;
    PolygonSoup soup;
    std::vector<std::uint32_t> polygon;
    for (std::uint32_t i = 0; i < 300; ++i) {
        soup.points.push_back({std::cos(i * 0.02), std::sin(i * 0.02), 0});
        polygon.push_back(i);
    }
    soup.add_face(polygon);
    soup.add_face(std::span(polygon).first(3));
    for (const bool ascii : {false, true}) {
        for (const char* name : {"a.ply", "a.obj", "a.off"}) {
            write_soup(folder / name, soup, {.format = std::nullopt, .precision = Precision::float64, .ascii = ascii});
            EXPECT_TRUE(test::same_soup(read_soup(folder / name), soup)) << name;
        }
    }
    round_to_float(soup);
    write_soup(folder / "a.stl", soup);
    EXPECT_EQ(read_soup(folder / "a.stl").face_count(), 299u);
}

TEST(Write, WhatIsNotFiniteIsKept) {
    const test::TestFolder folder;
    PolygonSoup soup = tetrahedron();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    soup.points[1] = {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()};
    for (const bool ascii : {false, true}) {
        for (const char* name : {"a.ply", "a.obj", "a.off"}) {
            write_soup(folder / name, soup, {.format = std::nullopt, .precision = Precision::float64, .ascii = ascii});
            EXPECT_TRUE(test::same_soup(read_soup(folder / name), soup)) << name;
        }
    }
}

TEST(Write, CoordinatesThatAreNoFloatsAreRefused) {
    const test::TestFolder folder;
    for (const Case& c : cases) {
        if (c.precision != Precision::float32) continue;
        SCOPED_TRACE(c.name);
        const WriteOptions options{.format = c.format, .precision = c.precision, .ascii = c.ascii};
        test::expect_error([&] { write_soup(folder / "a", tetrahedron(), options); }, ErrorCode::bad_argument,
                           "expected coordinates that are floats, found vertex 0 at 0.1 0 0");
        PolygonSoup large = tetrahedron();
        for (Vec3& p : large.points) p = {0, 0, 1e300};
        test::expect_error([&] { write_soup(folder / "a", large, options); }, ErrorCode::bad_argument,
                           "found vertex 0");
    }
    test::expect_error([&] { write_soup(folder / "a.stl", tetrahedron()); }, ErrorCode::bad_argument, "vertex 0");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Write, BrokenSoupsAndUnknownFormatsAreRefused) {
    const test::TestFolder folder;
    PolygonSoup soup = tetrahedron();
    test::expect_error([&] { write_soup(folder / "a.xyz", soup); }, ErrorCode::unsupported_format,
                       "expected an extension");
    soup.lines.push_back({0, 9});
    test::expect_error([&] { write_soup(folder / "a.obj", soup); }, ErrorCode::index_out_of_range,
                       "a line from 0 to 9");
    soup.corners.back() = 4;
    test::expect_error([&] { write_soup(folder / "a.ply", soup); }, ErrorCode::index_out_of_range,
                       "expected vertex indices below 4, found 4 in face 3");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Write, PrecisionOfEachFormat) {
    const WriteOptions single{.format = std::nullopt, .precision = Precision::float32, .ascii = false};
    EXPECT_EQ(stored_precision(Format::ply, {}), Precision::float64);
    EXPECT_EQ(stored_precision(Format::obj, single), Precision::float32);
    EXPECT_EQ(stored_precision(Format::stl, {}), Precision::float32);
}

/// The normals of an STL file are unit vectors along the faces' own, and zero where a face has no area.
TEST(Write, StlNormals) {
    const test::TestFolder folder;
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}, {3e38f, 0, 0}, {0, 0, 3e38f}};
    soup.corners = {0, 1, 2, 0, 3, 4, 0, 1, 1};
    write_soup(folder / "a.stl", soup, {.format = std::nullopt, .precision = Precision::float32, .ascii = true});
    const std::string text = test::read_bytes(folder / "a.stl");
    for (const char* normal : {"facet normal 0 0 1\n", "facet normal 0 -1 0\n", "facet normal 0 0 0\n"}) {
        EXPECT_NE(text.find(normal), text.npos) << text;
    }
}

}  // namespace
}  // namespace delmesh
