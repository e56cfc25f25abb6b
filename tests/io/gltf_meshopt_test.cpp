// EXT_meshopt_compression: what its encoders pack is read as it was, and what is no such code is an error.

#include "delmesh/mesh/shapes.hpp"
#include "io/allocation_watch.hpp"
#include "io/io_support.hpp"
#include "io/packed_gltf.hpp"
#include "io/packed_gltf_harm.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace delmesh {
namespace {

/// Coordinates that are floats; corners in the order of first use, as readers number them.
PolygonSoup torus() {
    PolygonSoup soup = make_sample("torus", 200);
    for (Vec3& p : soup.points) p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    return soup;
}

test::MeshoptFile file_of(const PolygonSoup& soup, std::size_t stride = 12) {
    test::MeshoptFile file;
    file.vertices = test::floats(soup.points, stride);
    file.stride = stride;
    file.corners = soup.corners;
    return file;
}

/// The corners of the triangles as places: triangles may begin at any of their corners.
std::vector<std::array<Vec3, 3>> triangles(const PolygonSoup& soup) {
    const auto less = [](const Vec3& a, const Vec3& b) {
        return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    };
    std::vector<std::array<Vec3, 3>> result;
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        std::array<Vec3, 3> t{};
        for (std::size_t c = 0; c < 3; ++c) t[c] = soup.points[soup.corners[3 * f + c]];
        std::rotate(t.begin(), std::min_element(t.begin(), t.end(), less), t.end());
        result.push_back(t);
    }
    return result;
}

TEST(GltfMeshopt, AllModesGiveWhatWasPacked) {
    const PolygonSoup soup = torus();
    for (const std::size_t stride : {12, 16}) {
        for (const std::size_t index_size : {2, 4}) {
            for (const bool are_triangles : {true, false}) {
                test::MeshoptFile file = file_of(soup, stride);
                file.index_size = index_size;
                file.are_triangles = are_triangles;
                const PolygonSoup read = test::parse(test::meshopt_glb(file), "a.glb");
                EXPECT_EQ(read.points.size(), soup.points.size());
                EXPECT_EQ(triangles(read), triangles(soup));
                EXPECT_EQ(read.stored, Precision::float32);
            }
        }
    }
}

TEST(GltfMeshopt, ScenesAndQuantisedPositions) {
    test::MeshoptFile file;
    file.required += ",\"KHR_mesh_quantization\"";
    file.type = 5122;
    file.stride = 8;
    file.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    file.nodes = "[{\"mesh\":0,\"scale\":[2,3,4],\"translation\":[10,0,0]},{\"mesh\":0}]";
    for (int v = 0; v < 4; ++v)
        for (const int axis : {1, 2, 3, 4}) test::put(file.vertices, static_cast<std::int16_t>(v == axis ? 5 : 0));
    const PolygonSoup soup = test::parse(test::meshopt_glb(file), "a.glb");
    ASSERT_EQ(soup.points.size(), 8U);
    EXPECT_NEAR(test::volume6(soup), 125 * (24 + 1), 1e-9);
    EXPECT_TRUE(std::ranges::count(soup.points, Vec3{20, 0, 0}) == 1);
    EXPECT_TRUE(std::ranges::count(soup.points, Vec3{0, 0, 5}) == 1);
}

/// 2 to an exponent of 8 bits, times a whole number of 24.
TEST(GltfMeshopt, ExponentialFilter) {
    test::MeshoptFile file;
    file.filter = "EXPONENTIAL";
    file.corners = {0, 1, 2};
    std::vector<double> expected;
    for (int i = 0; i < 9; ++i) {
        const int exponent = 5 * i - 30;
        const int mantissa = i % 2 == 0 ? 1234 * i + 1 : -77 * i;
        test::put(file.vertices,
                  static_cast<std::uint32_t>(exponent) << 24 | (static_cast<std::uint32_t>(mantissa) & 0xffffffU));
        expected.push_back(std::ldexp(mantissa, exponent));
    }
    const PolygonSoup soup = test::parse(test::meshopt_glb(file), "a.glb");
    ASSERT_EQ(soup.points.size(), 3U);
    for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(soup.points[i / 3][static_cast<int>(i % 3)], expected[i]) << i;
}

/// Where the extension is not needed the plain data are read, as long as there are any.
TEST(GltfMeshopt, PlainDataGoFirstWhereTheyMay) {
    const PolygonSoup soup = torus();
    const std::string needed = test::meshopt_glb(file_of(soup));
    const std::string used = test::edited(needed, "\"extensionsRequired\"", "\"extensionsUsed\"");
    EXPECT_EQ(triangles(test::parse(used, "a.glb")), triangles(soup));
    const std::string zeros = R"("uri":"data:,)" + test::base64(std::string(5'000, '\0')) + R"(","byteLength":1000)";
    for (const std::string& file : {needed, used}) {
        const PolygonSoup read = test::parse(test::edited(file, "\"byteLength\":1000", zeros), "a.glb");
        EXPECT_EQ(read.face_count(), soup.face_count());
        EXPECT_EQ(read.points.size(), file == used ? 1U : soup.points.size());
    }
}

/// Its newer name may also hold a newer code of vertices, which the first byte tells.
TEST(GltfMeshopt, IsReadByItsNewerNameToo) {
    const PolygonSoup soup = torus();
    std::string file = test::meshopt_glb(file_of(soup));
    for (std::size_t at = 0; (at = file.find("EXT_meshopt", at)) != std::string::npos;) file.replace(at, 3, "KHR");
    EXPECT_EQ(triangles(test::parse(file, "a.glb")), triangles(soup));
    const std::size_t code = file.find(std::string("BIN\0", 4)) + 4;
    ASSERT_EQ(file[code], '\xa0');
    file[code] = '\xa1';
    test::expect_parse_error(file, "a.glb", "mode ATTRIBUTES, found another kind or version: save the mesh anew, or");
}

TEST(GltfMeshopt, DamageIsNamed) {
    const std::string whole = test::meshopt_glb(file_of(torus()));
    const auto expect = [&](const std::string& from, const std::string& to, const std::string& message,
                            ErrorCode code = ErrorCode::file_format) {
        SCOPED_TRACE(to);
        test::expect_parse_error(test::edited(whole, from, to), "a.glb", message, code);
    };
    const auto elements = [](std::uint64_t stride, std::uint64_t count) {
        return R"("byteStride":)" + std::to_string(stride) + R"(,"count":)" + std::to_string(count);
    };
    const std::uint64_t points = torus().points.size();
    const std::string length = std::to_string(12 * points);
    const std::string found = elements(12, points);
    expect("ATTRIBUTES", "SOMETHING", "buffer view 0: expected meshopt data of mode ATTRIBUTES, TRIANGLES or INDICES");
    expect("ATTRIBUTES", "TRIANGLES", "buffer view 0: expected a stride that meshopt mode TRIANGLES allows, found 12");
    expect("NONE", "OCTAHEDRAL", "buffer view 0: expected meshopt mode ATTRIBUTES without a filter for other data");
    expect("TRIANGLES", "INDICES",
           "buffer view 1: expected 624 meshopt elements, found damaged data: save the mesh anew, or without meshopt");
    expect(found, elements(12, 999), "expected " + length + " bytes as 999 meshopt elements of 12 bytes, found others");
    expect(found, elements(12, points + (std::uint64_t{1} << 62)), "expected " + length + " bytes as 46116860184273");
    expect(found, elements(10, points), "allows, found 10");
    expect(found, elements(0, points), "allows, found 0");
    expect(found, elements(12 * points, 1), "allows, found " + length);
    expect(R"("byteLength":)" + length, R"("byteLength":24)", "expected 24 bytes as");
    expect(R"("byteOffset":0)", R"("byteOffset":1)", "buffer view 0: expected meshopt data of mode ATTRIBUTES, found");
    expect(R"("buffer":0)", R"("buffer":9)", "below 2 in the glTF list 'buffers', found 9",
           ErrorCode::index_out_of_range);
    expect(R"("mode")", R"("modi")", "found ''");
    expect(R"("byteOffset":0,"byteLength":)", R"("byteOffset":0,"byteLength":1)", "found a buffer of");
}

/// Bytes that are missing or others give an error, or numbers; indices stay in range, memory in proportion.
TEST(GltfMeshopt, AnyBytesDoNoHarm) {
    test::Random random(5);
    const std::string whole = test::meshopt_glb(file_of(torus()));
    const std::size_t data = whole.find("BIN");
    std::size_t errors = 0;
    for (int round = 0; round < 3'000; ++round) {
        std::string bytes = whole;
        for (std::uint64_t i = 0, n = random.below(5); i < n; ++i)
            bytes[data + 4 + random.below(bytes.size() - data - 4)] = static_cast<char>(random.below(256));
        if (!test::reads_without_harm(bytes, (std::size_t{1} << 20) + 32 * bytes.size())) ++errors;
        if (HasFailure()) return;
    }
    EXPECT_GT(errors, 500U);
}

/// A count that no code of that length can stand for, and many views that unpack the same bytes.
TEST(GltfMeshopt, CanNotFillMemory) {
    test::MeshoptFile file = file_of(torus());
    const std::string whole = test::meshopt_glb(file);
    const std::size_t points = torus().points.size();
    const auto bomb_of = [&](std::uint64_t count) {
        const auto changed = [&](const std::string& text, const std::string& what, std::uint64_t size) {
            return test::edited(text, what + std::to_string(size * points), what + std::to_string(size * count));
        };
        return changed(changed(whole, R"("byteLength":)", 12), R"("byteStride":12,"count":)", 1);
    };
    test::largest_allocation = 0;
    test::expect_parse_error(bomb_of(1'000'000'000), "a.glb", "buffer view 0: expected meshopt data in proportion");
    test::expect_parse_error(bomb_of(9'000), "a.glb", "which are too few");
    EXPECT_LE(test::largest_allocation, std::size_t{1} << 20);

    file.vertices = std::string(1'200'000, '\0');
    file.corners = {0, 1, 2};
    std::string views = test::meshopt_glb(file);
    EXPECT_EQ(test::parse(views, "a.glb").points.size(), 1U);
    const std::size_t begin = views.find(R"({"buffer":1)");
    const std::string view = views.substr(begin, views.find("}}},", begin) + 4 - begin);
    std::string more_views;
    std::string primitives;
    for (int i = 0; i < 500; ++i) {
        more_views += view;
        primitives += R"({"attributes":{"POSITION":)" + std::to_string(i + 2) + "}},";
    }
    std::string accessors;
    for (int i = 0; i < 500; ++i)
        accessors += R"(,{"bufferView":)" + std::to_string(i) + R"(,"type":"VEC3","componentType":5126,"count":3})";
    views = test::edited(views, R"("bufferViews":[)", R"("bufferViews":[)" + more_views);
    views = test::edited(views, R"("primitives":[)", R"("primitives":[)" + primitives);
    views = test::edited(views, R"("count":3})", R"("count":3})" + accessors);
    test::expect_parse_error(views, "a.glb", "expected meshopt data in proportion to the file, found more");
}

}  // namespace
}  // namespace delmesh
