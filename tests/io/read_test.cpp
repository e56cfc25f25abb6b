// What all readers share: files, detection of formats, and that neither windows nor sources matter.

#include "io/io_support.hpp"

#include <array>

namespace delmesh {
namespace {

const std::string small_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(Read, FilesThatCanNotBeRead) {
    const test::TestFolder folder;
    test::expect_error([&] { (void)read_soup(folder / "missing.ply"); }, ErrorCode::file_not_readable,
                       "missing.ply: can not be read: No such file or directory");
    test::expect_error([&] { (void)read_soup(folder.path()); }, ErrorCode::file_not_readable, "Is a directory");
}

TEST(Read, EmptyFiles) {
    const test::TestFolder folder;
    test::write_bytes(folder / "empty.obj", "");
    test::expect_error([&] { (void)read_soup(folder / "empty.obj"); }, ErrorCode::file_format,
                       "empty.obj: byte 0: expected a mesh, found an empty file");
    test::expect_parse_error("", "", "empty file");
}

TEST(Read, ContentOutweighsTheExtension) {
    const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl", "a.txt", "a", ""}) {
        EXPECT_EQ(test::parse(small_obj, name).face_count(), 1u) << name;
        EXPECT_EQ(test::parse(off, name).face_count(), 1u) << name;
    }
}

TEST(Read, TheExtensionHelpsWhereContentDoesNot) {
    const std::string headless = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_EQ(test::parse(headless, "a.off").face_count(), 1u);
    EXPECT_EQ(test::parse("shiny 1\n" + small_obj, "a.obj").face_count(), 1u);
    test::expect_parse_error(headless, "a.txt", "a.txt: expected PLY, OBJ, OFF, STL, glTF or 3MF, found none of them",
                             ErrorCode::unsupported_format);
}

TEST(Read, AFormatThatIsGivenDecides) {
    EXPECT_EQ(test::parse("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.obj", {Format::off}).face_count(), 1u);
    test::expect_error([] { (void)test::parse(small_obj, "a.obj", {Format::ply}); }, ErrorCode::file_format,
                       "line 1: expected 'ply'");
}

TEST(Read, OtherFormatsAreNamed) {
    test::expect_parse_error("BZh91AY", "a.ply", "found bzip2 data, which is not read: unpack it first",
                             ErrorCode::unsupported_format);
    test::expect_parse_error("7zXZ\xfd", "a.xz", "found none of them", ErrorCode::unsupported_format);
}

TEST(Read, MessagesStayOnOneLine) {
    test::expect_parse_error("v 1 2 \x1b[31m\n", "bad\nname.obj",
                             "bad\\x0aname.obj: line 1: expected a coordinate, found '\\x1b[31m'");
}

TEST(Read, FilesAndMemoryAgree) {
    const test::TestFolder folder;
    test::write_bytes(folder / "a.obj", small_obj);
    EXPECT_TRUE(test::same_soup(read_soup(folder / "a.obj"), test::parse(small_obj, "a.obj")));
}

TEST(Read, PipesAreRead) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ASSERT_EQ(::write(ends[1], small_obj.data(), small_obj.size()), static_cast<ssize_t>(small_obj.size()));
    ::close(ends[1]);
    EXPECT_EQ(read_soup("/dev/fd/" + std::to_string(ends[0])).face_count(), 1u);
    ::close(ends[0]);
}

/// A file of each format with all it can hold.
std::vector<std::pair<std::string, std::string>> files() {
    const test::TestFolder folder;
    PolygonSoup soup;
    for (int i = 0; i < 8; ++i) soup.points.push_back({i / 4 - 0.5, i / 2 % 2 - 0.5, i % 2 + 0.25});
    for (const std::array<std::uint32_t, 4>& quad : {std::array<std::uint32_t, 4>{0, 1, 3, 2},
                                                     {4, 6, 7, 5},
                                                     {0, 4, 5, 1},
                                                     {2, 3, 7, 6},
                                                     {0, 2, 6, 4},
                                                     {1, 5, 7, 3}}) {
        soup.add_face(quad);
    }
    std::vector<std::pair<std::string, std::string>> result;
    for (const bool ascii : {false, true}) {
        for (const Format format : {Format::ply, Format::obj, Format::off, Format::stl}) {
            const std::string file = "cube." + std::string(name(format));
            write_soup(folder / file, soup, {.format = format, .precision = Precision::float64, .ascii = ascii});
            result.emplace_back(file, test::read_bytes(folder / file));
        }
    }
    return result;
}

TEST(Read, NeitherWindowsNorSourcesMatter) {
    for (const auto& [name, bytes] : files()) {
        const PolygonSoup expected = test::parse(bytes, name);
        for (const std::size_t step : {1, 2, 7, 50, 4096}) {
            for (const std::size_t window : {1, 3, 64, 1000}) {
                for (const bool says_size : {false, true}) {
                    EXPECT_TRUE(test::same_soup(test::parse_dripping(bytes, name, step, window, says_size), expected))
                        << name << " " << step << " " << window;
                }
            }
        }
    }
}

}  // namespace
}  // namespace delmesh
