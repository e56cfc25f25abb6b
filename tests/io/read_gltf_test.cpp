// glTF: the same tetrahedron by every way that the format has of storing and placing it.

#include "io/allocation_watch.hpp"
#include "io/io_support.hpp"
#include "io/scene_files.hpp"

#include "delmesh/mesh/mesh.hpp"

namespace delmesh {
namespace {

using test::tetrahedron_buffer;
using test::tetrahedron_json;

const std::string one_node = "[{\"mesh\":0}]";

std::string embedded(std::string_view bytes) {
    return "data:application/octet-stream;base64," + test::base64(bytes);
}

PolygonSoup tetrahedron() {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
    soup.corners = {0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 3};
    return soup;
}

TEST(ReadGltf, IndicesOfAllSizesInBothContainers) {
    for (const int indices : {1, 2, 3}) {
        for (const std::string& file : {test::glb(tetrahedron_json(one_node, indices), tetrahedron_buffer()),
                                        tetrahedron_json(one_node, indices, embedded(tetrahedron_buffer()))}) {
            for (const char* name : {"a.glb", "a.gltf", "a.obj", "a"}) {
                const PolygonSoup soup = test::parse(file, name);
                EXPECT_TRUE(test::same_soup(soup, tetrahedron()));
                EXPECT_EQ(soup.stored, Precision::float32);
            }
        }
    }
}

TEST(ReadGltf, BuffersInFilesBesideIt) {
    const test::TestFolder folder;
    std::filesystem::create_directory(folder / "sub");
    test::write_bytes(folder / "a b.bin", tetrahedron_buffer());
    test::write_bytes(folder / "sub/b.bin", tetrahedron_buffer());
    for (const char* uri : {"a%20b.bin", "a b.bin", "sub/b.bin"}) {
        test::write_bytes(folder / "a.gltf", tetrahedron_json(one_node, 1, uri));
        EXPECT_TRUE(test::same_soup(read_soup(folder / "a.gltf"), tetrahedron())) << uri;
    }
    test::write_bytes(folder / "sub/up.gltf", tetrahedron_json(one_node, 1, "../a%20b.bin"));
    test::expect_error([&] { (void)read_soup(folder / "sub/up.gltf"); }, ErrorCode::unsupported_format, "its folder");
    for (const std::string& uri : {(folder / "a b.bin").string(), std::string("https://example.org/a.bin")}) {
        test::write_bytes(folder / "a.gltf", tetrahedron_json(one_node, 1, uri));
        test::expect_error([&] { (void)read_soup(folder / "a.gltf"); }, ErrorCode::unsupported_format, "its folder");
    }
    // Names that the system takes for no file at all.
    std::filesystem::create_symlink("loop", folder / "loop");
    for (const std::string& uri : {std::string(3'000, 'a'), std::string("loop")}) {
        test::write_bytes(folder / "a.gltf", tetrahedron_json(one_node, 1, uri));
        test::expect_error([&] { (void)read_soup(folder / "a.gltf"); }, ErrorCode::file_not_readable, "found none");
    }
    test::write_bytes(folder / "a.gltf", tetrahedron_json(one_node, 1, "gone.bin"));
    test::expect_error([&] { (void)read_soup(folder / "a.gltf"); }, ErrorCode::file_not_readable, "gone.bin");
    test::expect_parse_error(tetrahedron_json(one_node, 1, "a.bin"), "a.gltf", "a.bin", ErrorCode::unsupported_format);
}

/// What a scene may hold follows the bytes of all its files.
TEST(ReadGltf, LargeMeshesInFilesBesideIt) {
    constexpr std::size_t faces = 1'500'000;
    std::string bytes = tetrahedron_buffer().substr(0, 48);
    for (std::size_t f = 0; f < faces; ++f) bytes += std::string("\0\1\2", 3);
    const test::TestFolder folder;
    test::write_bytes(folder / "a.bin", bytes);
    std::string json = tetrahedron_json(one_node, 1, "a.bin");
    json.replace(json.find("\"byteLength\":12}"), 16, "\"byteLength\":4500000}");
    json.replace(json.find("\"count\":12"), 10, "\"count\":4500000");
    test::write_bytes(folder / "a.gltf", json);
    EXPECT_EQ(read_soup(folder / "a.gltf").face_count(), faces);
}

TEST(ReadGltf, ScenesAreFlattened) {
    // Node 1 is scaled and moved by node 0; node 2 is turned by 90 degrees about z; node 3 is not in the scene.
    const std::string nodes =
        "[{\"children\":[1,2],\"translation\":[10,0,0]},{\"mesh\":0,\"scale\":[2,3,4]},"
        "{\"mesh\":0,\"rotation\":[0,0,0.7071067811865476,0.7071067811865476]},{\"mesh\":0}]";
    const PolygonSoup soup = test::parse(
        test::glb(tetrahedron_json(nodes, 1, {}, "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"), tetrahedron_buffer()),
        "a.glb");
    ASSERT_EQ(soup.points.size(), 8U);
    EXPECT_EQ(soup.points[1], (Vec3{10, 3, 0}));
    EXPECT_EQ(soup.points[3], (Vec3{10, 0, 4}));
    EXPECT_NEAR(soup.points[4 + 1].x, 9, 1e-15);
    EXPECT_NEAR(soup.points[4 + 2].y, 1, 1e-15);
    EXPECT_NEAR(test::volume6(soup), 24 + 1, 1e-12);
    EXPECT_EQ(Mesh(soup).face_count(), 8U);
    // Without scenes, whatever is nobody's child.
    EXPECT_EQ(test::parse(test::glb(tetrahedron_json(nodes), tetrahedron_buffer()), "a.glb").points.size(), 12U);
}

TEST(ReadGltf, MirrorsKeepTheOutsideOut) {
    for (const char* node :
         {"[{\"mesh\":0,\"scale\":[-1,1,1]}]", "[{\"mesh\":0,\"matrix\":[0,1,0,0,1,0,0,0,0,0,1,0,5,6,7,1]}]"}) {
        const PolygonSoup soup = test::parse(test::glb(tetrahedron_json(node), tetrahedron_buffer()), "a.glb");
        EXPECT_NEAR(test::volume6(soup), 1, 1e-14) << node;
        EXPECT_EQ(Mesh(soup).face_count(), 4U);
    }
}

/// Vertices that differ in what is not read are one; those of different nodes are not.
TEST(ReadGltf, SplitVerticesAreJoined) {
    std::string bytes;
    for (const int v : {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3})
        for (const int axis : {1, 2, 3}) test::put(bytes, v == axis ? 1.F : 0.F);
    const std::string json =
        "{\"asset\":{\"version\":\"2.0\"},\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
        "\"accessors\":[{\"bufferView\":0,\"type\":\"VEC3\",\"componentType\":5126,\"count\":12}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":144}],\"buffers\":[{\"byteLength\":144}]}";
    EXPECT_TRUE(test::same_soup(test::parse(test::glb(json, bytes), "a.glb"), tetrahedron()));
}

TEST(ReadGltf, StripsAndFans) {
    const auto corners = [](int mode) {
        std::string json = tetrahedron_json(one_node);
        json.replace(json.find("\"indices\":1"), 11, "\"mode\":" + std::to_string(mode));
        return test::parse(test::glb(json, tetrahedron_buffer()), "a.glb").corners;
    };
    EXPECT_EQ(corners(4), (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(corners(5), (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
    EXPECT_EQ(corners(6), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_TRUE(corners(1).empty());  // lines
}

/// A base of floats in which one position is replaced, and positions without any base.
TEST(ReadGltf, SparseAccessors) {
    std::string bytes = tetrahedron_buffer() + std::string("\3", 1) + std::string(3, '\0');
    for (const float x : {5.F, 6.F, 7.F}) test::put(bytes, x);
    for (const bool base : {true, false}) {
        std::string json = tetrahedron_json(one_node);
        const std::string sparse =
            "\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":4,\"componentType\":5121},"
            "\"values\":{\"bufferView\":4,\"byteOffset\":4}},";
        json.replace(json.find("\"bufferView\":0,"), 15, sparse + (base ? "\"bufferView\":0," : ""));
        json.insert(json.find("],\"buffers\""), ",{\"buffer\":0,\"byteOffset\":132,\"byteLength\":16}");
        const PolygonSoup soup = test::parse(test::glb(json, bytes), "a.glb");
        EXPECT_EQ(soup.points.back(), (Vec3{5, 6, 7}));
        EXPECT_EQ(soup.points.size(), base ? 4U : 2U);  // three zeros are one place
    }
}

/// KHR_mesh_quantization: the corners at 0 and 1, as integers of all types.
TEST(ReadGltf, QuantisedPositions) {
    struct Kind {
        int type;
        int size;
        int one;
        bool normalized;
    };
    for (const Kind& kind : {Kind{5120, 1, 127, true}, Kind{5121, 1, 255, true}, Kind{5122, 2, 32767, true},
                             Kind{5123, 2, 65535, true}, Kind{5120, 1, 1, false}, Kind{5123, 2, 1, false}}) {
        std::string bytes;
        for (int v = 0; v < 4; ++v)
            for (const int axis : {1, 2, 3}) {
                const int value = v == axis ? kind.one : 0;
                bytes += static_cast<char>(value & 255);
                if (kind.size == 2) bytes += static_cast<char>(value >> 8);
            }
        bytes.resize(48, '\0');
        std::string json = tetrahedron_json(one_node, 1, {}, "\"extensionsRequired\":[\"KHR_mesh_quantization\"],");
        json.replace(json.find("5126"), 4,
                     std::to_string(kind.type) + (kind.normalized ? ",\"normalized\":true" : ",\"normalized\":false"));
        const PolygonSoup soup = test::parse(test::glb(json, bytes + tetrahedron_buffer().substr(48)), "a.glb");
        EXPECT_TRUE(test::same_soup(soup, tetrahedron())) << kind.type;
    }
}

TEST(ReadGltf, ExtensionsThatMoveNothingArePassedOver) {
    for (const char* extension : {"KHR_materials_unlit", "KHR_techniques_webgl", "KHR_technique_webgl",
                                  "KHR_texture_transform", "MSFT_texture_dds", "KHR_lights_punctual"}) {
        const std::string json =
            tetrahedron_json(one_node, 1, {}, std::string("\"extensionsRequired\":[\"") + extension + "\"],");
        const PolygonSoup soup = test::parse(test::glb(json, tetrahedron_buffer()), "a.glb");
        EXPECT_TRUE(test::same_soup(soup, tetrahedron())) << extension;
    }
}

TEST(ReadGltf, WhatIsNotReadIsRefusedByName) {
    for (const char* extension : {"EXT_mesh_gpu_instancing", "KHR_made_up"}) {
        const std::string json =
            tetrahedron_json(one_node, 1, {}, std::string("\"extensionsRequired\":[\"") + extension + "\"],");
        test::expect_parse_error(test::glb(json, tetrahedron_buffer()), "a.glb", extension,
                                 ErrorCode::unsupported_format);
    }
}

TEST(ReadGltf, DamageIsNamed) {
    const auto changed = [](const std::string& from, const std::string& to) {
        std::string json = tetrahedron_json(one_node);
        json.replace(json.find(from), from.size(), to);
        return test::glb(json, tetrahedron_buffer());
    };
    const auto expect = [&](const std::string& from, const std::string& to, const std::string& message,
                            ErrorCode code = ErrorCode::file_format) {
        SCOPED_TRACE(to);
        test::expect_parse_error(changed(from, to), "a.glb", message, code);
    };
    expect("\"2.0\"", "\"1.0\"", "version '1.0'", ErrorCode::unsupported_format);
    expect("\"mesh\":0", "\"mesh\":1", "below 1", ErrorCode::index_out_of_range);
    expect("\"mesh\":0", "\"mesh\":-1", "found -1");
    expect("\"mesh\":0", "\"children\":[0]", "circles");
    expect("\"mesh\":0", "\"mesh\":0,\"matrix\":[1,2]", "16 numbers");
    expect("\"mesh\":0", "\"mesh\":0,", "byte 66: expected glTF JSON, found '}]");
    expect("\"count\":4", "\"count\":5", "found a buffer view of 48 bytes: save the mesh anew");
    expect("\"count\":4", "\"count\":3", "below 3, found 3", ErrorCode::index_out_of_range);
    expect("\"count\":4", "\"count\":9007199254740993", "found a buffer view");
    expect("\"count\":4", "\"count\":1e400", "expected glTF JSON");
    expect("\"byteOffset\":48", "\"byteOffset\":18446744073709551615", "found a buffer of 132");
    expect("VEC3", "VEC2", "another type");
    expect("5126", "5130", "another type");
    expect("\"bufferView\":0,", "", "found none");
    const std::string whole = test::glb(tetrahedron_json(one_node), tetrahedron_buffer());
    test::expect_parse_error(whole.substr(0, whole.size() - 1), "a.glb", "found 131 before the end");
    test::expect_parse_error("{}", "a.gltf", "names no version", ErrorCode::unsupported_format);
    test::expect_parse_error("{\"a\":[", "a.gltf", "byte 6: expected glTF JSON, found its end");
}

/// Ten thousand nodes that show one mesh: more than its file can honestly mean, where the mesh is large.
TEST(ReadGltf, ScenesCanNotFillMemory) {
    std::string nodes = "[{\"mesh\":0}";
    for (int i = 0; i < 10'000; ++i) nodes += ",{\"mesh\":0}";
    EXPECT_EQ(test::parse(test::glb(tetrahedron_json(nodes + "]"), tetrahedron_buffer()), "a.glb").face_count(),
              40'004U);
    std::string faces;
    for (int i = 0; i < 40'000; ++i) faces += std::string("\0\1\2", 3);
    std::string json = tetrahedron_json(nodes + "]");
    json.replace(json.find("\"byteLength\":12}"), 16, "\"byteLength\":120000}");
    json.replace(json.find("\"count\":12"), 10, "\"count\":120000");
    test::expect_parse_error(test::glb(json, tetrahedron_buffer().substr(0, 48) + faces), "a.glb",
                             "in proportion to its file");
    // Zeros that stand nowhere in the file.
    json = tetrahedron_json(one_node);
    json.replace(json.find("\"indices\":1"), 11, "\"mode\":4");
    json.replace(json.find("\"bufferView\":0,"), 15,
                 "\"sparse\":{\"count\":0,\"indices\":{\"bufferView\":1,\"componentType\":5121},\"values\":"
                 "{\"bufferView\":0}},");
    json.replace(json.find("\"count\":4"), 9, "\"count\":4000000000");
    test::expect_parse_error(test::glb(json, tetrahedron_buffer()), "a.glb", "in proportion to its file");
}

TEST(ReadGltf, DeepAndDenseJsonDoesNoHarm) {
    constexpr std::size_t many = 200'000;
    const auto repeated = [](const std::string& text) {
        std::string result;
        for (std::size_t i = 0; i < many; ++i) result += text;
        return result;
    };
    for (const std::string& json :
         {repeated("["), repeated("{\"nodes\":"), "{\"nodes\":[" + repeated("{},") + "{}]}",
          "{\"meshes\":[" + repeated("[],") + "[]]}", "{\"extras\":" + repeated("[") + repeated("]") + "}"}) {
        test::largest_allocation = 0;
        EXPECT_THROW((void)test::parse(json, "a.gltf"), Error);
        EXPECT_LE(test::largest_allocation, (std::size_t{1} << 20) + 32 * json.size());
    }
}

TEST(ReadGltf, IsNotWritten) {
    const test::TestFolder folder;
    test::expect_error([&] { write_soup(folder / "a.glb", tetrahedron()); }, ErrorCode::unsupported_format, "a.glb");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
}

}  // namespace
}  // namespace delmesh
