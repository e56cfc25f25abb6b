// Files that are broken, or made to do harm: each gives an error or a soup whose indices are right, in memory and time
// that follow the size of the file.

#include "io/allocation_watch.hpp"
#include "io/io_support.hpp"

#include <algorithm>

namespace delmesh {
namespace {

struct File {
    std::string name;
    std::string bytes;
};

/// Small files of all formats and dialects.
std::vector<File> small_files() {
    std::vector<File> files{
        {"strips.ply",
         "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty int z\n"
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n"
         "6 0 1 2 -1 3 2\n"},
        {"a.obj",
         "# c\nv 0 0 0\nv 1 0 0 # c\nv 1 1e-3 0\r\nv .5 1 nan\nvt 0 0\nf 1/1 2/1 \\\n 3/1\nf -4//1 -3//1 -2//1 "
         "-1//1\nl 1 2 3\n"},
        {"a.off",
         "STCNOFF # c\n3 1 0\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1 1 1 1 1 0 0\n0 1 0 0 0 1 1 1 1 1 0 0\n3 0 1 2 "
         "0.5\n"},
        {"4n.off", "4nOFF 4\n3 1\n0 0 0 1 1\n1 0 0 1 2\n0 1 0 1 4\n3 0\n1 2\n"},
        {"a.stl",
         "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
         "0\nendloop\nendfacet\nendsolid a\n"}};
    const test::TestFolder folder;
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}};
    soup.add_face(std::vector<std::uint32_t>{0, 1, 2});
    soup.add_face(std::vector<std::uint32_t>{0, 1, 2, 3});
    for (const bool ascii : {false, true}) {
        for (const Format format : {Format::ply, Format::off, Format::stl}) {
            const std::string file = "b." + std::string(name(format));
            write_soup(folder / file, soup, {.format = format, .precision = Precision::float32, .ascii = ascii});
            files.push_back({file, test::read_bytes(folder / file)});
        }
    }
    const auto word = [](std::uint32_t v) {
        return std::string{static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
                           static_cast<char>(v)};
    };
    std::string binary_off = "OFF BINARY\n" + word(3) + word(1) + word(0);
    for (int i = 0; i < 9; ++i) binary_off += word(0x3f800000);
    for (const std::uint32_t v : {3, 0, 1, 2, 1, 0}) binary_off += word(v);
    files.push_back({"binary.off", binary_off});
    files.push_back({"big.ply",
                     "ply\nformat binary_big_endian 1.0\nelement face 1\nproperty list ushort short vertex_indices\n"
                     "property uchar red\nelement vertex 1\nproperty list uchar float a\nproperty float x\n"
                     "property double y\nproperty float z\nend_header\n" +
                         std::string("\0\3\0\0\0\0\0\0\1", 9) + std::string("\1", 1) + std::string(4 + 16, '\x3f')});
    return files;
}

/// The bytes must give an error of one line (which is returned) or a soup that holds together, and no piece of memory
/// that is asked for may be out of proportion to them.
void expect_no_harm(const std::string& bytes, const std::string& name, FileDamage* damage, std::string& message) {
    constexpr std::size_t fixed = std::size_t{1} << 20;
    constexpr std::size_t bytes_per_byte = 32;
    test::largest_allocation = 0;
    try {
        PolygonSoup soup = test::parse(bytes, name, {{}, damage});
        const auto exists = [&](std::uint32_t v) { return v < soup.points.size(); };
        ASSERT_TRUE(std::ranges::all_of(soup.corners, exists)) << name;
        for (const auto& line : soup.lines) ASSERT_TRUE(exists(line[0]) && exists(line[1])) << name;
        ASSERT_TRUE(soup.starts.empty() ? soup.corners.size() % 3 == 0 : soup.starts.back() == soup.corners.size())
            << name;
        ASSERT_TRUE(std::ranges::is_sorted(soup.starts)) << name;
        triangulate(soup);
        ASSERT_TRUE(soup.is_triangles());
    } catch (const Error& error) {
        message = error.what();
        ASSERT_TRUE(message.starts_with(name + ": ")) << message;
        ASSERT_EQ(message.find_first_of("\r\n"), message.npos) << message;
        ASSERT_LT(message.size(), 250u) << message;
    }
    ASSERT_LE(test::largest_allocation, fixed + bytes_per_byte * bytes.size());
}

/// That, and reading what can be read: it finds damage where there is an error, and the same one first.
void expect_no_harm(const std::string& bytes, const std::string& name) {
    std::string error;
    std::string error_in_part;
    FileDamage damage;
    expect_no_harm(bytes, name, nullptr, error);
    expect_no_harm(bytes, name, &damage, error_in_part);
    if (damage.count > 0) {
        ASSERT_EQ(damage.sentences.front(), error);
        ASSERT_EQ(damage.sentences.size(), std::min<std::size_t>(damage.count, 16));
    } else {
        ASSERT_EQ(error_in_part, error);
    }
}

TEST(Hostile, SmallFilesAreValid) {
    for (const File& file : small_files()) EXPECT_NO_THROW((void)test::parse(file.bytes, file.name)) << file.name;
}

TEST(Hostile, CutOffAnywhere) {
    for (const File& file : small_files()) {
        for (std::size_t n = 0; n <= file.bytes.size(); ++n) expect_no_harm(file.bytes.substr(0, n), file.name);
    }
}

TEST(Hostile, BinaryFilesThatAreCutOffAreErrors) {
    for (const File& file : small_files()) {
        if (file.bytes.find("binary") == file.bytes.npos && file.bytes.find("BINARY") == file.bytes.npos) continue;
        for (std::size_t n = 0; n < file.bytes.size(); ++n) {
            // Without any colours at the end, this is a file of another dialect.
            if (file.name == "binary.off" && n + 8 == file.bytes.size()) continue;
            EXPECT_THROW((void)test::parse(file.bytes.substr(0, n), file.name), Error) << file.name << " " << n;
        }
    }
}

TEST(Hostile, ChangedBytes) {
    test::Random random(3);
    const std::string telling = "0123456789-+.eEnf \n\r\t\\#/\0\xff\x7f\x80";
    for (const File& file : small_files()) {
        for (int round = 0; round < 1500; ++round) {
            std::string bytes = file.bytes;
            for (std::uint64_t i = 1 + random.below(4); i > 0; --i) {
                char& byte = bytes[random.below(bytes.size())];
                switch (random.below(3)) {
                    case 0:
                        byte = static_cast<char>(random.bits());
                        break;
                    case 1:
                        byte = static_cast<char>(byte ^ 1 << random.below(8));
                        break;
                    default:
                        byte = telling[random.below(telling.size())];
                }
            }
            expect_no_harm(bytes, file.name);
        }
    }
}

TEST(Hostile, PiecesMovedAboutRepeatedAndLeftOut) {
    test::Random random(4);
    for (const File& file : small_files()) {
        for (int round = 0; round < 500; ++round) {
            std::string bytes = file.bytes;
            const std::size_t from = random.below(bytes.size());
            const std::string piece = bytes.substr(from, 1 + random.below(30));
            if (random.below(2) == 0) bytes.erase(from, piece.size());
            if (random.below(2) == 0) bytes.insert(random.below(bytes.size() + 1), piece);
            expect_no_harm(bytes, file.name);
        }
    }
}

TEST(Hostile, HugeCountsReserveNothing) {
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    const std::string body(1000, '\1');
    for (const char* encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const std::string start = std::string("ply\nformat ") + encoding + " 1.0\n";
        expect_no_harm(start + "element vertex 4000000000\n" + xyz + "end_header\n" + body, "a.ply");
        for (const char* count : {"4000000000", "999999999999999999"}) {
            const std::string faces =
                std::string("element face ") + count + "\nproperty list uchar int vertex_indices\n";
            const std::string strips =
                std::string("element tristrips ") + count + "\nproperty list int int vertex_indices\n";
            const std::string other =
                std::string("element odd ") + count + "\nproperty list uint double a\nproperty int b\n";
            const std::string empty = std::string("element odd ") + count + "\n";
            for (const std::string& elements : {faces, strips, other, empty}) {
                expect_no_harm(start + elements + "element vertex 0\n" + xyz + "end_header\n" + body, "a.ply");
                expect_no_harm(start + "element vertex 9\n" + xyz + elements + "end_header\n" + body, "a.ply");
            }
        }
        expect_no_harm(start + "element vertex 0\n" + xyz +
                           "element face 1\nproperty list uint uchar vertex_indices\nend_header\n\xff\xff\xff\x7f",
                       "a.ply");
        expect_no_harm(start + "element vertex 1\nproperty list uint64 double a\n" + xyz + "end_header\n" + body,
                       "a.ply");
    }
    expect_no_harm("OFF\n4000000000 999999999999999999 0\n0 0 0\n", "a.off");
    expect_no_harm("OFF\n1 999999999999999999 0\n0 0 0\n999999999999999999 0 0\n", "a.off");
    expect_no_harm("nOFF 999999999999999999\n4000000000 1 0\n0 0 0\n", "a.off");
    expect_no_harm("OFF BINARY\n" + std::string(100, '\x7f'), "a.off");
    expect_no_harm("nOFF BINARY\n" + std::string(100, '\xff'), "a.off");
    expect_no_harm(std::string(84, '\xff') + body, "a.stl");
    test::expect_error([] { (void)test::parse_dripping(std::string(84, '\xff'), "a.stl", 10, 10); },
                       ErrorCode::file_format, "found 4294967295, but the file holds 0");
}

TEST(Hostile, LongLines) {
    constexpr std::size_t longest = 1'000'000;
    const std::string blanks(longest, ' ');
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(test::parse("#" + blanks + "\n" + triangle, "a.obj").face_count(), 1u);
    EXPECT_EQ(test::parse("v 0 0" + blanks + "0\nv 1 0 0\nv 0 1 0\nf" + blanks + "1 2 3" + blanks + "\n", "a.obj")
                  .face_count(),
              1u);
    std::string face = "f";
    for (std::size_t i = 0; i < longest / 2; ++i) face += " 1";
    EXPECT_EQ(test::parse(triangle + face, "a.obj").starts.back(), 3 + longest / 2);
    std::string joined;
    for (std::size_t i = 0; i < longest / 4; ++i) joined += "\\\n1 ";
    EXPECT_EQ(test::parse(triangle + "f " + joined, "a.obj").starts.back(), 3 + longest / 4);
    expect_no_harm("ply\nformat ascii 1.0\ncomment" + blanks + "\nelement vertex 0", "a.ply");
    expect_no_harm("ply\n" + std::string(longest, 'x'), "a.ply");
    expect_no_harm("v 1 2 " + std::string(longest, '9'), "a.obj");
    expect_no_harm("f " + std::string(longest, '9'), "a.obj");
    expect_no_harm(std::string(longest, '#'), "a.off");
    expect_no_harm(std::string(longest, '\0'), "a.obj");
    expect_no_harm(std::string(longest, '\\'), "a.obj");
}

/// What takes the most memory for each byte: faces without corners, and strips of one-byte indices.
TEST(Hostile, DenseFiles) {
    constexpr std::size_t many = 1'000'000;
    const std::string start =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\n"
        "property char z\n";
    const std::string points("\0\0\0\1\0\0\0\1\0", 9);
    const std::string faces = start + "element face 1000000\nproperty list uchar int vertex_indices\nend_header\n" +
                              points + std::string(many, '\0');
    EXPECT_EQ(test::parse(faces, "a.ply").face_count(), many);
    expect_no_harm(faces, "a.ply");
    std::string strip = start + "element tristrips 1\nproperty list int uchar vertex_indices\nend_header\n" + points +
                        std::string("\x40\x42\x0f\0", 4);
    for (std::size_t i = 0; i < many; ++i) strip += static_cast<char>(i % 3);
    EXPECT_EQ(test::parse(strip, "a.ply").face_count(), many - 2);
    expect_no_harm(strip, "a.ply");
}

}  // namespace
}  // namespace delmesh
