// 3MF: packages made by code.

#include "io/io_support.hpp"
#include "io/scene_files.hpp"

#include "delmesh/mesh/mesh.hpp"

namespace delmesh {
namespace {

using test::model_3mf;
using test::package_3mf;
using test::tetrahedron_3mf;

PolygonSoup parse_model(const std::string& resources, const std::string& items, const std::string& more = {}) {
    return test::parse(package_3mf(model_3mf(resources, items, more)), "a.3mf");
}

void expect_model_error(const std::string& resources, const std::string& items, const std::string& message,
                        ErrorCode code = ErrorCode::file_format, const std::string& more = {}) {
    SCOPED_TRACE(resources + items);
    test::expect_parse_error(package_3mf(model_3mf(resources, items, more)), "a.3mf", message, code);
}

TEST(Read3mf, DoublesAndFacesAsTheyStand) {
    for (const char* name : {"a.3mf", "a.stl", "a"}) {
        const PolygonSoup soup =
            test::parse(package_3mf(model_3mf(tetrahedron_3mf(7), "<item objectid=\"7\"/>")), name);
        EXPECT_EQ(soup.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0, 1}}));
        EXPECT_EQ(soup.corners, (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}));
        EXPECT_EQ(soup.stored, Precision::float64);
    }
}

TEST(Read3mf, ItemsAndComponentsAreFlattened) {
    const std::string resources =
        tetrahedron_3mf(1) +
        "<object id=\"2\"><components><component objectid=\"1\" transform=\"2 0 0 0 3 0 0 0 4 0 0 0\"/>"
        "<component objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/></components></object>" +
        tetrahedron_3mf(3);
    const PolygonSoup soup =
        parse_model(resources, "<item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 10 20 30\"/><item objectid=\"1\"/>");
    ASSERT_EQ(soup.points.size(), 12U);
    EXPECT_EQ(soup.points[2], (Vec3{10, 23, 30}));
    EXPECT_NEAR(test::volume6(soup), 24 + 1 + 1, 1e-11);
    EXPECT_EQ(Mesh(soup).face_count(), 12U);
}

/// The production extension: objects in other model files.
TEST(Read3mf, ObjectsInOtherParts) {
    const std::string root = model_3mf(
        "<object id=\"1\"><components><component p:path=\"/3D/b.model\" "
        "objectid=\"5\"/></components></object>",
        "<item objectid=\"1\"/>", "requiredextensions=\"p\"");
    std::string archive =
        test::zip({{"_rels/.rels",
                    "<Relationships><Relationship Target=\"/3D/3dmodel.model\" "
                    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
                   {"3D/3dmodel.model", root},
                   {"3D/b.model", model_3mf(tetrahedron_3mf(5), "<item objectid=\"5\"/>")}});
    EXPECT_EQ(test::parse(archive, "a.3mf").face_count(), 4U);
}

TEST(Read3mf, DamageIsNamed) {
    const std::string item = "<item objectid=\"1\"/>";
    expect_model_error("<object id=\"1\"><mesh><vertices><vertex x=\"1\" y=\"q\"/></vertices></mesh></object>", item,
                       "'3D/3dmodel.model': line 3: expected a coordinate y, found 'q'");
    expect_model_error("<object id=\"1\"><mesh><vertices><vertex x=\"1\" y=\"2\"/></vertices></mesh></object>", item,
                       "expected a coordinate z, found none");
    expect_model_error(
        "<object id=\"1\"><mesh><triangles><triangle v1=\"0\" v2=\"0\" v3=\"0\"/></triangles></mesh></object>", item,
        "below 0, found 0", ErrorCode::index_out_of_range);
    expect_model_error(tetrahedron_3mf(1) + tetrahedron_3mf(1), item, "found 1 again: save the mesh anew");
    expect_model_error(tetrahedron_3mf(1), "<item objectid=\"2\"/>", "found number 2");
    expect_model_error(tetrahedron_3mf(1), "<item objectid=\"1\" transform=\"1 2 3\"/>", "twelve numbers");
    expect_model_error("<vertex x=\"0\" y=\"0\" z=\"0\"/>", item, "found it outside");
    expect_model_error("<object", item, "expected XML");
    expect_model_error(
        tetrahedron_3mf(1), item, "'s'", ErrorCode::unsupported_format,
        "xmlns:s=\"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07\" requiredextensions=\"p s\"");
    test::expect_parse_error(package_3mf("<!DOCTYPE a [<!ENTITY b \"c\">]><a>&b;</a>"), "a.3mf", "document type");
    test::expect_parse_error(test::zip({{"a.txt", "b"}}), "a.3mf", "'_rels/.rels': can not be unpacked");
    test::expect_parse_error(test::zip({{"_rels/.rels", "<a/>"}}), "a.3mf", "names no 3D model",
                             ErrorCode::unsupported_format);
    const std::string whole = package_3mf(model_3mf(tetrahedron_3mf(1), item));
    for (std::size_t n = 4; n < whole.size(); ++n)
        EXPECT_THROW((void)test::parse(whole.substr(0, n), "a.3mf"), Error) << n;
}

/// Objects that use themselves, and objects that double at each level.
TEST(Read3mf, ScenesCanNotFillMemory) {
    expect_model_error("<object id=\"1\"><components><component objectid=\"1\"/></components></object>",
                       "<item objectid=\"1\"/>", "32 deep");
    std::string doubling = tetrahedron_3mf(0);
    for (int i = 1; i <= 30; ++i) {
        const std::string use = "<component objectid=\"" + std::to_string(i - 1) + "\"/>";
        doubling += "<object id=\"" + std::to_string(i) + "\"><components>" + use + use + "</components></object>";
    }
    expect_model_error(doubling, "<item objectid=\"30\"/>", "in proportion to its file");
}

TEST(Read3mf, BombsAreRefused) {
    const std::string blanks(std::size_t{80} << 20, ' ');
    test::expect_parse_error(package_3mf(model_3mf(blanks, "")), "a.3mf", "more than 250 times their size");
    const std::string tag = "<object " + std::string(std::size_t{2} << 20, ' ') + "/>";
    expect_model_error(tag, "", "found a tag of more than");
}

}  // namespace
}  // namespace delmesh
