// UTF-16 text: the same mesh as from UTF-8, in any pieces; what is no UTF-16 is an error that names its place.

#include "io/utf16.hpp"

#include "io/io_support.hpp"
#include "io/packing.hpp"
#include "io/wide_text.hpp"

namespace delmesh {
namespace {

using test::utf16;
using test::utf16_unit;

constexpr const char* obj = "# \xc3\xa4 \xe2\x82\xac \xf0\x9f\x98\x80\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 .1 0\r\nf 1 2 3\r\n";
constexpr std::pair<const char*, const char*> files[] = {
    {"a.obj", obj},
    {"a.off", "OFF # \xf0\x9f\x98\x80\n3 1 0\n0 0 0\n1 0 0\n0 .1 0\n3 0 1 2\n"},
    {"a.ply",
     "ply\nformat ascii 1.0\ncomment \xf0\x9f\x98\x80\nelement vertex 3\nproperty double x\nproperty double y\n"
     "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 .1 0\n"
     "3 0 1 2\n"},
    {"a.stl",
     "solid \xf0\x9f\x98\x80\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 .1 0\nendloop\n"
     "endfacet\nendsolid\n"}};

std::string convert(std::string_view bytes, std::size_t step, std::size_t piece) {
    test::DripSource drip(bytes, step);
    io::Utf16Source source(drip, "a.obj");
    std::string text;
    std::string buffer(piece, '\0');
    while (const std::size_t n = source.read(buffer.data(), piece)) text.append(buffer, 0, n);
    EXPECT_EQ(source.read(buffer.data(), piece), 0u);
    return text;
}

TEST(Utf16, GivesTheSameMeshInBothByteOrders) {
    for (const auto& [name, text] : files) {
        SCOPED_TRACE(name);
        const PolygonSoup expected = test::parse(text, name);
        EXPECT_EQ(expected.face_count(), 1u);
        for (const bool little : {true, false}) {
            EXPECT_TRUE(test::same_soup(test::parse(utf16(text, little), name), expected));
            EXPECT_TRUE(test::same_soup(test::parse(utf16(text, little), "a"), expected)) << "by content";
            EXPECT_TRUE(test::same_soup(test::parse(test::gzip(utf16(text, little)), name), expected)) << "packed";
        }
    }
}

TEST(Utf16, GivesTheSameTextInAnyPieces) {
    std::string text;
    while (text.size() < 200'000) text += obj;
    for (const std::string& sample : {std::string(), std::string("v"), std::string(obj), text}) {
        for (const bool little : {true, false}) {
            for (const std::size_t step : {1, 3, 65'536}) {
                if (step * 10'000 < sample.size()) continue;
                for (const std::size_t piece : {1, 1000})
                    EXPECT_EQ(convert(utf16(sample, little), step, piece), sample);
            }
        }
    }
}

TEST(Utf16, LeavesOtherBytesAsTheyAre) {
    for (const std::string& text : {std::string(), std::string("v"), std::string("\xff"), std::string("\xfe\xfe\xff"),
                                    std::string("\xef\xbb\xbfv 1"), std::string("v\0 \0", 4)}) {
        for (const std::size_t step : {1, 100}) EXPECT_EQ(convert(text, step, 2), text);
    }
}

TEST(Utf16, NamesThePlaceOfWhatIsNoUtf16) {
    for (const bool little : {true, false}) {
        const auto unit = [little](unsigned code) { return utf16_unit(code, little); };
        const std::string start = utf16("v 0 ", little);
        const std::pair<std::string, const char*> broken[] = {
            {start + "\1", "a.obj: byte 10: expected the second half of a UTF-16 character, found the end of the file"},
            {start + unit(0xd800), "byte 12: expected the second half of a UTF-16 character, found the end"},
            {start + unit(0xd800) + unit('0'), "byte 12: expected the second half of a surrogate pair of UTF-16"},
            {start + unit(0xd800) + unit(0xd801), "surrogate pair of UTF-16, found 0xd801"},
            {start + unit(0xdc00), "a.obj: byte 10: expected a character of UTF-16, found 0xdc00"}};
        for (const auto& [text, message] : broken) test::expect_parse_error(text, "a.obj", message);
    }
}

TEST(Utf16, WithoutAMarkIsRefusedInOneSentence) {
    for (const bool little : {true, false})
        test::expect_parse_error(utf16("v 0 0 0\nv 1 0 0\n", little).substr(2), "a.obj",
                                 "found UTF-16 text without a byte order mark: save it as UTF-8");
}

TEST(Utf16, Utf32IsRefused) {
    test::expect_parse_error(std::string("\xff\xfe\0\0v\0\0\0", 8), "a.obj", "byte 0: expected ASCII, UTF-8 or UTF-16");
    test::expect_parse_error(std::string("\0\0\xfe\xff\0\0\0v", 8), "a.obj", "found UTF-32 text");
}

}  // namespace
}  // namespace delmesh
