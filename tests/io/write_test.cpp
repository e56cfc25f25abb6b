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

}  // namespace
}  // namespace delmesh
