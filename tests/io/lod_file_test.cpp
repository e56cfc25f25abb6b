#include "delmesh/io/lod_file.hpp"

#include "delmesh/mesh/shapes.hpp"
#include "io/io_support.hpp"

namespace delmesh {
namespace {

ProgressiveMesh small_progressive_mesh() {
    Mesh mesh(make_sample("terrain", 200));
    SimplifyOptions options;
    options.vertices = 10;
    ProgressiveMesh record;
    (void)simplify(mesh, options, record);
    return record;
}

std::string text_of(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(LodFile, HoldsTheBytesThatAreDocumentedAndComesBack) {
    const test::TestFolder folder;
    const ProgressiveMesh before = small_progressive_mesh();
    ASSERT_GT(before.steps.size(), 20U);
    write_lod(folder / "a.dlod", before);
    EXPECT_EQ(test::read_bytes(folder / "a.dlod"), text_of(encode(before)));
    const ProgressiveMesh after = read_lod(folder / "a.dlod");
    for (const std::size_t vertices : {before.least_vertices(), before.most_vertices()}) {
        EXPECT_TRUE(test::same_soup(to_soup(after.at(vertices)), to_soup(before.at(vertices))));
    }
}

TEST(LodFile, ErrorsNameTheFile) {
    const test::TestFolder folder;
    test::expect_error([&] { (void)read_lod(folder / "absent.dlod"); }, ErrorCode::file_not_readable, "absent.dlod");
    test::expect_error([&] { (void)read_lod(folder.path()); }, ErrorCode::file_not_readable, "LodFile");
    test::write_bytes(folder / "empty.dlod", "");
    test::expect_error([&] { (void)read_lod(folder / "empty.dlod"); }, ErrorCode::file_format, "empty.dlod");
    const std::string bytes = text_of(encode(small_progressive_mesh()));
    test::write_bytes(folder / "cut.dlod", bytes.substr(0, bytes.size() / 2));
    test::expect_error([&] { (void)read_lod(folder / "cut.dlod"); }, ErrorCode::file_format, "cut.dlod");
}

TEST(LodFile, AppearsWholeOrNotAtAll) {
    const test::TestFolder folder;
    const ProgressiveMesh progressive = small_progressive_mesh();
    test::expect_error([&] { write_lod(folder / "absent" / "a.dlod", progressive); }, ErrorCode::file_not_writable,
                       "a.dlod");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace delmesh
