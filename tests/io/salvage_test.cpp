#include "io/io_support.hpp"

#include "delmesh/mesh/rounding.hpp"
#include "delmesh/mesh/shapes.hpp"

#include <cmath>

namespace delmesh {
namespace {

struct Read {
    PolygonSoup soup;
    FileDamage damage;
};

Read read_in_part(const std::string& bytes, const std::string& name) {
    Read read;
    read.soup = test::parse(bytes, name, {{}, &read.damage});
    return read;
}

std::vector<std::string> files_of(const PolygonSoup& soup) {
    const test::TestFolder folder;
    std::vector<std::string> names;
    for (const Format format : {Format::ply, Format::obj, Format::off, Format::stl}) {
        for (const bool ascii : {false, true}) {
            if ((format == Format::obj || format == Format::off) && !ascii) continue;
            const std::string name = std::string(ascii ? "ascii." : "binary.") + std::string(delmesh::name(format));
            write_soup(folder / name, soup, {.format = format, .precision = Precision::float32, .ascii = ascii});
            names.push_back(name);
            names.push_back(test::read_bytes(folder / name));
        }
    }
    return names;
}

PolygonSoup small_sphere() {
    PolygonSoup soup = make_sample("icosphere", 80);
    round_to_float(soup);
    return soup;
}

bool same_face(const PolygonSoup& a, std::size_t f, const PolygonSoup& b, std::size_t g) {
    for (std::size_t i = 0; i < 3; ++i)
        if (a.points[a.face(f)[i]] != b.points[b.face(g)[i]]) return false;
    return true;
}

/// What stands before the end of a file that is cut off is read, face for face; whole files are not damaged.
TEST(Salvage, FilesThatAreCutOffAreReadUpToThere) {
    const PolygonSoup sphere = small_sphere();
    const std::vector<std::string> files = files_of(sphere);
    for (std::size_t i = 0; i < files.size(); i += 2) {
        const std::string& name = files[i];
        const std::string& bytes = files[i + 1];
        const Read whole = read_in_part(bytes, name);
        EXPECT_EQ(whole.damage.count, 0u) << name;
        EXPECT_TRUE(test::same_soup(whole.soup, test::parse(bytes, name))) << name;
        std::size_t most = 0;
        for (std::size_t n = bytes.size() / 2; n < bytes.size(); n += 13) {
            Read part;
            try {
                part = read_in_part(bytes.substr(0, n), name);
            } catch (const Error&) {
                EXPECT_EQ(most, 0u) << name << " has faces before " << n;
                continue;
            }
            ASSERT_GE(part.soup.face_count(), most) << name << ' ' << n;
            most = part.soup.face_count();
            const bool is_text = name.starts_with("ascii");  // which may end within a number
            const std::size_t certain = is_text && most > 0 ? most - 1 : most;
            for (std::size_t f = 0; f < certain; ++f)
                ASSERT_TRUE(same_face(part.soup, f, whole.soup, f)) << name << ' ' << n << ' ' << f;
        }
        EXPECT_GE(most, whole.soup.face_count() - 2) << name;
    }
}

TEST(Salvage, OneBadLineCostsOneFace) {
    struct Case {
        const char* name;
        std::string bytes;
        std::size_t damages;
        std::size_t faces;
    };
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 3\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    const std::string bad_facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    for (const Case& c : {
             Case{"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 x\nf 0 1 2\nf 3 2 1\n", 2, 2},
             Case{"forward.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\nl 1 9\n", 1, 1},
             Case{"a.off", "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 7\n3 2 1 0\n", 1, 2},
             Case{"a.ply", ply + "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 0 1 4\n3 1 3 2\n", 1, 2},
             Case{"a.stl", "solid a\n" + facet + bad_facet + facet + "endsolid a\n", 1, 2},
         }) {
        const Read read = read_in_part(c.bytes, c.name);
        EXPECT_EQ(read.soup.face_count(), c.faces) << c.name;
        EXPECT_EQ(read.damage.count, c.damages) << c.name;
        const auto strict = test::error_of([&] { (void)test::parse(c.bytes, c.name); });
        EXPECT_EQ(read.damage.sentences.front(), strict->what());
    }
}

TEST(Salvage, VerticesThatCanNotBeReadKeepTheirPlace) {
    for (const auto& [name, bytes] :
         {std::pair{"a.obj", "v 0 0 0\nv one 0 0\nv 0 1 0\nv 1 1 0\nf 1 3 4\n"},
          std::pair{"a.off", "OFF\n4 1 0\n0 0 0\none 0 0\n0 1 0\n1 1 0\n3 0 2 3\n"},
          std::pair{"a.ply",
                    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                    "0 0 0\none 0 0\n0 1 0\n1 1 0\n3 0 2 3\n"}}) {
        const Read read = read_in_part(bytes, name);
        ASSERT_EQ(read.soup.points.size(), 4u) << name;
        EXPECT_TRUE(std::isnan(read.soup.points[1].x)) << name;
        EXPECT_EQ(read.soup.points[3], (Vec3{1, 1, 0})) << name;
        EXPECT_EQ(read.soup.corners, (std::vector<std::uint32_t>{0, 2, 3})) << name;
    }
}

TEST(Salvage, BinaryFacesWithWrongIndicesAreLeftOut) {
    const std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 3\nproperty list uchar int vertex_indices\nend_header\n";
    const auto face = [](char last) { return std::string("\3\0\0\0\0\1\0\0\0", 9) + last + std::string(3, '\0'); };
    const Read read = read_in_part(header + std::string(36, '\x3f') + face(2) + face(3) + face(2), "a.ply");
    EXPECT_EQ(read.soup.face_count(), 2u);
    EXPECT_EQ(read.damage.count, 1u);
}

TEST(Salvage, NothingLeftIsAnError) {
    test::expect_error([] { (void)read_in_part("v 0 0 0\nf 1 2 x\n", "a.obj"); }, ErrorCode::file_format, "line 2");
    test::expect_error([] { (void)read_in_part("ply\nformat ascii 2.0\n", "a.ply"); }, ErrorCode::file_format,
                       "line 2");
}

TEST(Salvage, OnlySixteenSentencesAreKept) {
    std::string bytes = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (int i = 0; i < 100; ++i) bytes += "f 1 2 x\n";
    const Read read = read_in_part(bytes, "a.obj");
    EXPECT_EQ(read.damage.count, 100u);
    EXPECT_EQ(read.damage.sentences.size(), 16u);
}

}  // namespace
}  // namespace delmesh
