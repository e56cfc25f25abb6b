// Every mesh of the shared collection, where it is there: counts agree with its catalogue.

#include "io/io_support.hpp"

#include <algorithm>
#include <map>

namespace delmesh {
namespace {

struct Entry {
    std::string path;
    std::size_t points = 0;
    std::size_t faces = 0;
};

std::filesystem::path meshes() {
    return std::filesystem::path(DELMESH_SHARED_DIR) / "meshes";
}

std::vector<Entry> catalogue() {
    std::vector<Entry> entries;
    std::ifstream file(meshes() / "CATALOGUE.tsv");
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream fields(line);
        Entry entry;
        std::string source, format, points, faces;
        std::getline(fields, entry.path, '\t');
        std::getline(fields, source, '\t');
        std::getline(fields, format, '\t');
        std::getline(fields, points, '\t');
        std::getline(fields, faces, '\t');
        entry.points = std::stoul(points);
        entry.faces = std::stoul(faces);
        if (entry.path == "wild/utf16-box.obj")
            entry = {entry.path, 8, 12};  // which the catalogue's reader can not read
        entries.push_back(entry);
    }
    return entries;
}

/// Files that are to be refused, with what the message must say.
const std::map<std::string, std::string> refused{
    {"wild/malformed.obj", "line 28: expected a vertex index from 1 or from -8 to -1, found 0"},
    {"wild/crash-30d6.ply", "line 7"},
    {"wild/empty-0-bytes.obj", "empty file"},
    {"wild/unparseable.stl", "line 4: expected a coordinate, found '\\x10'"},
    {"wild/made-truncated-binary.ply",
     "expected 3 values in a list of face 72 of 80, found 0 before the end of the file"},
    {"wild/made-count-larger-than-data.stl", "found 1000, but the file holds 12"},
};

/// The catalogue counts the numbers of this file as if lines meant nothing.
const std::map<std::string, std::size_t> other_face_counts{{"wild/fuze-ascii-bad-face-list.ply", 1000}};

TEST(Catalogue, CountsAgree) {
    if (!std::filesystem::exists(meshes() / "CATALOGUE.tsv")) GTEST_SKIP() << "the mesh collection is not here";
    std::size_t read = 0;
    for (const Entry& entry : catalogue()) {
        const std::filesystem::path path = meshes() / entry.path;
        if (!format_from_path(path) || !std::filesystem::exists(path)) continue;
        SCOPED_TRACE(entry.path);
        if (const auto found = refused.find(entry.path); found != refused.end()) {
            const auto error = test::error_of([&] { (void)read_soup(path); });
            ASSERT_TRUE(error);
            EXPECT_NE(std::string(error->what()).find(found->second), std::string::npos) << error->what();
            continue;
        }
        PolygonSoup soup = read_soup(path);
        triangulate(soup);
        const auto other = other_face_counts.find(entry.path);
        // In glTF, vertices are split where normals differ; here they are one.
        const bool is_gltf = format_from_path(path) == Format::gltf;
        EXPECT_EQ(is_gltf ? std::max(soup.points.size(), entry.points) : soup.points.size(), entry.points);
        EXPECT_EQ(soup.face_count(), other == other_face_counts.end() ? entry.faces : other->second);
        EXPECT_TRUE(std::ranges::all_of(soup.corners, [&](std::uint32_t v) { return v < soup.points.size(); }));
        ++read;
    }
    EXPECT_GT(read, 50u);
}

TEST(Catalogue, ContentDecidesWithoutAnExtension) {
    if (!std::filesystem::exists(meshes() / "CATALOGUE.tsv")) GTEST_SKIP() << "the mesh collection is not here";
    for (const Entry& entry : catalogue()) {
        const std::filesystem::path path = meshes() / entry.path;
        if (!format_from_path(path) || !std::filesystem::exists(path) || refused.contains(entry.path)) continue;
        // A .gltf file has its numbers in another file, which bytes in memory can not name.
        if (std::filesystem::file_size(path) > 300000 || path.extension() == ".gltf") continue;
        SCOPED_TRACE(entry.path);
        const std::string bytes = test::read_bytes(path);
        const PolygonSoup soup = read_soup(path);
        EXPECT_TRUE(test::same_soup(test::parse(bytes, "no-extension"), soup));
        EXPECT_TRUE(test::same_soup(test::parse(bytes, "misleading.ply"), soup));
    }
}

}  // namespace
}  // namespace delmesh
