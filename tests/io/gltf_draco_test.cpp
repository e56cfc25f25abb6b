// KHR_draco_mesh_compression: what Draco itself decodes is read, and hostile data do no harm.

#include "delmesh/mesh/shapes.hpp"
#include "io/allocation_watch.hpp"
#include "io/io_support.hpp"
#include "io/packed_gltf.hpp"
#include "io/packed_gltf_harm.hpp"
#include "support/random.hpp"

#include <algorithm>

namespace delmesh {
namespace {

using test::DracoOptions;

/// As Draco decodes them.
std::vector<std::array<Vec3, 3>> decoded(const std::string& data) {
    draco::DecoderBuffer buffer;
    buffer.Init(data.data(), data.size());
    draco::Decoder decoder;
    const std::unique_ptr<draco::Mesh> mesh = decoder.DecodeMeshFromBuffer(&buffer).value();
    const draco::PointAttribute& positions = *mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION);
    std::vector<std::array<Vec3, 3>> result;
    for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f) {
        std::array<Vec3, 3> triangle;
        for (std::size_t c = 0; c < 3; ++c) {
            std::array<float, 3> p{};
            positions.GetMappedValue(mesh->face(f)[c], p.data());
            triangle[c] = {p[0], p[1], p[2]};
        }
        result.push_back(triangle);
    }
    return result;
}

std::vector<std::array<Vec3, 3>> triangles(const PolygonSoup& soup) {
    std::vector<std::array<Vec3, 3>> result;
    for (std::size_t f = 0; f < soup.face_count(); ++f)
        result.push_back({soup.points[soup.corners[3 * f]], soup.points[soup.corners[3 * f + 1]],
                          soup.points[soup.corners[3 * f + 2]]});
    return result;
}

std::vector<DracoOptions> ways() {
    std::vector<DracoOptions> result{{draco::MESH_SEQUENTIAL_ENCODING, 5, 11, false},
                                     {draco::MESH_SEQUENTIAL_ENCODING, 10, 0, true}};
    for (const int speed : {0, 3, 5, 8, 10})
        for (const bool has_texture : {false, true})
            result.push_back({draco::MESH_EDGEBREAKER_ENCODING, speed, speed == 8 ? 0 : 11, has_texture});
    return result;
}

TEST(GltfDraco, GivesWhatDracoDecodes) {
    const PolygonSoup soup = make_sample("torus", 300);
    for (const DracoOptions& way : ways()) {
        SCOPED_TRACE(testing::Message() << way.method << ' ' << way.speed << ' ' << way.has_texture);
        const std::string data = test::draco_data(soup, way);
        const PolygonSoup read = test::parse(test::draco_glb(data), "a.glb");
        EXPECT_EQ(triangles(read), decoded(data));
        EXPECT_EQ(read.face_count(), soup.face_count());
        EXPECT_EQ(read.points.size(), soup.points.size());  // seams of textures are none
        EXPECT_EQ(read.stored, Precision::float32);
    }
}

TEST(GltfDraco, StandsWhereTheSceneSays) {
    const std::string data = test::draco_data(make_sample("torus", 60));
    const double once = test::volume6(test::parse(test::draco_glb(data), "a.glb"));
    const PolygonSoup soup = test::parse(
        test::draco_glb(data, "[{\"mesh\":0,\"scale\":[2,3,-4],\"translation\":[100,0,0]},{\"mesh\":0},{\"mesh\":0}]"),
        "a.glb");
    EXPECT_EQ(soup.face_count(), 3 * decoded(data).size());
    EXPECT_NEAR(test::volume6(soup), once * (24 + 2), 1e-9 * once);
}

TEST(GltfDraco, PlainDataGoFirstWhereTheyMay) {
    const std::string data = test::draco_data(make_sample("torus", 60));
    const std::string needed = test::draco_glb(data);
    const std::string used = test::edited(needed, "extensionsRequired", "extensionsUsed");
    EXPECT_EQ(triangles(test::parse(used, "a.glb")), decoded(data));
    // The positions and indices are zeros that stand behind the data.
    const auto with_plain = [](const std::string& file) {
        std::string result = test::edited(file, R"("type":"VEC3")", R"("bufferView":1,"type":"VEC3")");
        result = test::edited(result, R"("type":"SCALAR")", R"("bufferView":1,"type":"SCALAR")");
        result = test::edited(result, R"(}],"buffers":[)",
                              R"(},{"buffer":1,"byteLength":2000}],"buffers":[{},{"uri":"data:,)" +
                                  test::base64(std::string(2'000, '\0')) + R"("},)");
        return result;
    };
    EXPECT_EQ(triangles(test::parse(with_plain(needed), "a.glb")), decoded(data));
    EXPECT_EQ(test::parse(with_plain(used), "a.glb").points.size(), 1U);
}

/// Texture coordinates, normals and what else comes behind the positions may be anything: it is not looked at.
TEST(GltfDraco, NothingIsDecodedThatIsNotRead) {
    const PolygonSoup soup = make_sample("torus", 300);
    const std::string data = test::draco_data(soup, {draco::MESH_EDGEBREAKER_ENCODING, 0, 11, true});
    const std::string whole = test::draco_glb(data);
    std::string cut = data;
    std::fill(cut.end() - 60, cut.end(), '\xff');
    std::string file = whole;
    file.replace(file.find(data), data.size(), cut);
    EXPECT_TRUE(test::same_soup(test::parse(file, "a.glb"), test::parse(whole, "a.glb")));
}

TEST(GltfDraco, DamageIsNamed) {
    const PolygonSoup torus = make_sample("torus", 60);
    const std::string data = test::draco_data(torus);
    const std::string whole = test::draco_glb(data);
    const auto expect = [&](const std::string& from, const std::string& to, const std::string& message,
                            ErrorCode code = ErrorCode::file_format) {
        SCOPED_TRACE(to);
        test::expect_parse_error(test::edited(whole, from, to), "a.glb", message, code);
    };
    const std::string place = "a.glb: glTF buffer view 0: expected ";
    const std::string count = R"("count":)";
    const std::string points = std::to_string(torus.points.size());
    const std::string corners = std::to_string(torus.corners.size());
    expect(count + points, count + "31", place + "31 points, as the accessor of its positions says, found " + points);
    expect(count + corners, count + "63",
           place + "63 corners, as the accessor of its indices says, found " + std::to_string(torus.face_count()) +
               " faces");
    expect(R"("POSITION":0}}})", R"("POSITION":1}}})", place + "positions as Draco attribute 1, found none");
    expect(R"("POSITION":0}}})", R"("POSITION":99999999999}}})", "attribute 99999999999, found none");
    expect(R"("POSITION":0}}})", R"("NORMAL":0}}})", "expected a number as glTF 'POSITION', found none");
    expect("5126", "5123", place + "Draco attribute 0 to be three numbers of its accessor's type, found others");
    expect("5126", "0", "found others");
    expect(R"("bufferView":0)", R"("bufferView":3)", "below 1 in the glTF list 'bufferViews', found 3",
           ErrorCode::index_out_of_range);
    expect(R"("bufferView":0,"attributes")", R"("bufferView":0,"attribute")", "expected attributes of Draco data");
    const auto expect_data = [&](std::size_t at, char byte, const std::string& message) {
        std::string file = whole;
        file[file.find(data) + at] = byte;
        SCOPED_TRACE(at);
        test::expect_parse_error(file, "a.glb", message);
    };
    expect_data(0, 'd', place + "Draco data, found 'dRACO': save the mesh anew, or without Draco");
    expect_data(5, 1, place + "Draco data of version 2.2, found version 1.2");
    expect_data(6, 3, "found version 2.3");
    expect_data(8, 2, place + "Draco data of one of its two methods, found another");
    expect_data(7, 0, place + "a mesh, found Draco data of another kind");
    expect_data(10, '\x80', place + "Draco data without metadata, found some");
}

/// A triangle by hand: sequential, nothing packed. `groups` of attributes are announced, and one is there.
std::string plain_data(char corner, char groups) {
    std::string data = std::string("DRACO\2\2\1\0\0\0\1\3\1\0\1", 16) + corner + groups;
    data +=
        std::string("\1\0\x9\3\0\0\0", 7);  // one attribute: positions, floats, three of them, number 0, as they are
    for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) test::put(data, x);
    return data;
}

TEST(GltfDraco, CornersAndGroupsAreCounted) {
    EXPECT_EQ(test::parse(test::draco_glb(plain_data(2, 1), 3, 3), "a.glb").points,
              (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    test::expect_parse_error(test::draco_glb(plain_data(3, 1), 3, 3), "a.glb", "a Draco vertex below 3, found 3");
    test::expect_parse_error(test::draco_glb(plain_data(2, 65), 3, 3), "a.glb",
                             "at most 64 groups of Draco attributes");
}

/// Texture coordinates that are called positions: their decoder believes a count (see docs/decisions/0014).
TEST(GltfDraco, TextureCoordinatesAreNoPositions) {
    std::string data = test::draco_data(make_sample("torus", 300), {draco::MESH_EDGEBREAKER_ENCODING, 0, 11, true});
    const std::size_t at = data.find(std::string("\3\x9\2\0\1", 5));  // of two floats, number 1
    ASSERT_NE(at, data.npos);
    const std::string file = test::edited(test::draco_glb(data), R"("POSITION":0}}})", R"("POSITION":1}}})");
    test::expect_parse_error(file, "a.glb", "expected positions as Draco attribute 1, found none");
    std::string renamed = file;
    renamed[file.find(data) + at] = draco::GeometryAttribute::POSITION;
    test::expect_parse_error(renamed, "a.glb", "expected positions before texture coordinates");
}

/// Data that end early, and data with other bytes: never more than an error, and memory in proportion.
TEST(GltfDraco, AnyBytesDoNoHarm) {
    test::Random random(6);
    std::size_t errors = 0;
    for (const DracoOptions& way : ways()) {
        const std::string data = test::draco_data(make_sample("torus", 60), way);
        const std::string whole = test::draco_glb(data);
        const std::size_t begin = whole.find(data);
        for (int round = 0; round < 400; ++round) {
            std::string bytes = whole;
            if (round % 4 == 0) {
                const std::size_t length = random.below(data.size());
                bytes = test::edited(whole, R"("byteLength":)" + std::to_string(data.size()),
                                     R"("byteLength":)" + std::to_string(length));
            } else {
                for (std::uint64_t i = 0, n = random.below(4); i < n; ++i)
                    bytes[begin + random.below(data.size())] = static_cast<char>(random.below(256));
            }
            // (Draco's largest table of symbols has 4 MiB.)
            if (!test::reads_without_harm(bytes, (std::size_t{4} << 20) + 32 * bytes.size())) ++errors;
            if (HasFailure()) return;
        }
    }
    EXPECT_GT(errors, 1'500U);
}

/// The largest count anywhere: Draco itself takes 16 seconds for one of these files, and 267 MB.
TEST(GltfDraco, LargeCountsAnywhere) {
    for (const DracoOptions& way : ways()) {
        const std::string data = test::draco_data(test::packed_tetrahedron(), way);
        const std::string whole = test::draco_glb(data);
        for (std::size_t at = 11; at + 4 <= data.size(); ++at) {
            std::string bytes = whole;
            bytes.replace(whole.find(data) + at, 4, "\xff\xff\xff\x7f");
            test::largest_allocation = 0;
            try {
                EXPECT_LE(test::parse(bytes, "a.glb").face_count(), 4U);
            } catch (const Error& error) {
                EXPECT_TRUE(std::string(error.what()).starts_with("a.glb: glTF buffer view 0: ")) << error.what();
            }
            ASSERT_LE(test::largest_allocation, (std::size_t{4} << 20) + 32 * bytes.size()) << at;
        }
    }
}

/// A header that claims many faces and attributes; the accessors agree.
TEST(GltfDraco, CanNotFillMemory) {
    const auto number = [](std::uint64_t value) {
        std::string bytes;
        for (; value > 127; value >>= 7) bytes += static_cast<char>(value | 128);
        return bytes + static_cast<char>(value);
    };
    const auto bomb = [&](std::uint64_t faces, char attributes) {
        const std::string data = std::string("DRACO\2\2\1\1\0\0\0", 12) + number(faces / 2) + number(faces) +
                                 attributes + number(faces) + number(0) + std::string(100, '\0');
        return test::draco_glb(data, faces / 2, 3 * faces);
    };
    for (const std::uint64_t faces : {400'000U, 50'000'000U, 1'431'655'765U}) {
        test::largest_allocation = 0;
        test::expect_parse_error(bomb(faces, 0), "a.glb", "view 0: expected a mesh in proportion to its bytes");
        EXPECT_LE(test::largest_allocation, std::size_t{1} << 20) << faces;
    }
    test::expect_parse_error(bomb(5'000, '\xff'), "a.glb", "in proportion to its bytes");
    // As many as are allowed, and none of them are there.
    test::expect_parse_error(bomb(200'000, 0), "a.glb", "found damaged data");
}

}  // namespace
}  // namespace delmesh
