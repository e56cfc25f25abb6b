#include "delmesh/io/format.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

TEST(Format, NamesAreReadBack) {
    for (const Format format : {Format::ply, Format::obj, Format::off, Format::stl, Format::gltf, Format::three_mf}) {
        const std::string lower(name(format));
        EXPECT_EQ(format_from_name(lower), format);
        EXPECT_EQ(format_from_name("." + lower), format);
        EXPECT_EQ(format_from_path("some.dir/file.b." + lower), format);
    }
}

TEST(Format, CaseDoesNotMatter) {
    EXPECT_EQ(format_from_name("PLY"), Format::ply);
    EXPECT_EQ(format_from_path("A.StL"), Format::stl);
    EXPECT_EQ(format_from_path("a.GLB"), Format::gltf);
}

TEST(Format, UnknownNamesAreNoFormat) {
    for (const char* text : {"", ".", "pl", "plyx", "..ply", "gl"}) EXPECT_FALSE(format_from_name(text)) << text;
    for (const char* path : {"", "ply", "dir.ply/file", ".ply"}) EXPECT_FALSE(format_from_path(path)) << path;
}

}  // namespace
}  // namespace delmesh
