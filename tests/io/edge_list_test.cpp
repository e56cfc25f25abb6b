#include "delmesh/io/edge_list.hpp"

#include "delmesh/base/error.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace delmesh {
namespace {

std::filesystem::path file_with(const std::string& text) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "edges.txt";
    std::ofstream(path) << text;
    return path;
}

TEST(EdgeList, ReadsPairs) {
    const std::vector<std::array<std::uint32_t, 2>> expected{{0, 1}, {7, 3}};
    EXPECT_EQ(read_edge_list(file_with("# features\n0 1\n\n  7\t3  # a crease\n")), expected);
    EXPECT_TRUE(read_edge_list(file_with("")).empty());
}

TEST(EdgeList, ErrorsNameTheLine) {
    for (const char* text : {"0 1\n2\n", "0 1\n2 x\n", "0 1\n2 3 4\n", "0 1\n-1 3\n", "0 1\n4294967295 3\n"}) {
        try {
            (void)read_edge_list(file_with(text));
            ADD_FAILURE() << "no error for " << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::file_format);
            EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace delmesh
