#pragma once
// glTF files with packed meshes, made by the encoders of the libraries, for tests and as seeds of the fuzz target.

#include "delmesh/mesh/polygon_soup.hpp"
#include "io/scene_files.hpp"

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace delmesh::test {

/// With these nodes, mesh 0 of accessors 0 (positions) and 1 (indices).
inline std::string packed_json(const std::string& required, const std::string& nodes, const std::string& extension,
                               const std::string& accessors, const std::string& rest) {
    return "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[" + required + "],\"nodes\":" + nodes +
           ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1" + extension +
           "}]}],\"accessors\":[" + accessors + "]," + rest + "}";
}

/// The .glb file with another text in its JSON, at the first place.
inline std::string edited(const std::string& file, const std::string& from, const std::string& to) {
    const auto length = io::load<std::uint32_t, std::endian::little>(file.data() + 12);
    std::string json = file.substr(20, length);
    const std::size_t at = json.find(from);
    if (at == json.npos) return "not found: " + from;
    return glb(json.replace(at, from.size(), to), file.substr(28 + length));
}

inline std::string floats(const std::vector<Vec3>& points, std::size_t stride = 12) {
    std::string bytes;
    for (const Vec3& p : points) {
        for (const int axis : {0, 1, 2}) put(bytes, static_cast<float>(p[axis]));
        bytes.append(stride - 12, '\0');
    }
    return bytes;
}

/// Four points and four faces.
inline PolygonSoup packed_tetrahedron() {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    soup.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    return soup;
}

// --- meshoptimizer ---

inline std::string meshopt_vertices(const std::string& bytes, std::size_t stride) {
    const std::size_t count = bytes.size() / stride;
    std::vector<unsigned char> code(meshopt_encodeVertexBufferBound(count, stride));
    code.resize(meshopt_encodeVertexBuffer(code.data(), code.size(), bytes.data(), count, stride));
    return {code.begin(), code.end()};
}

inline std::string meshopt_indices(const std::vector<std::uint32_t>& corners, bool are_triangles) {
    const std::size_t points = std::size_t{1} << 31;
    std::vector<unsigned char> code(are_triangles ? meshopt_encodeIndexBufferBound(corners.size(), points)
                                                  : meshopt_encodeIndexSequenceBound(corners.size(), points));
    code.resize(are_triangles ? meshopt_encodeIndexBuffer(code.data(), code.size(), corners.data(), corners.size())
                              : meshopt_encodeIndexSequence(code.data(), code.size(), corners.data(), corners.size()));
    return {code.begin(), code.end()};
}

struct MeshoptFile {
    std::string vertices;  ///< as they are when they are unpacked, but for the filter
    std::size_t stride = 12;
    int type = 5126;
    std::string filter = "NONE";
    std::vector<std::uint32_t> corners;
    std::size_t index_size = 4;
    bool are_triangles = true;
    std::string nodes = "[{\"mesh\":0}]";
    std::string required = "\"EXT_meshopt_compression\"";
};

inline std::string meshopt_glb(const MeshoptFile& file) {
    std::string bytes = meshopt_vertices(file.vertices, file.stride);
    const std::size_t vertex_bytes = bytes.size();
    while (bytes.size() % 4 != 0) bytes += '\0';
    const std::size_t index_begin = bytes.size();
    bytes += meshopt_indices(file.corners, file.are_triangles);
    const std::size_t points = file.vertices.size() / file.stride;
    const auto view = [](std::size_t begin, std::size_t length, std::size_t stride, std::size_t count,
                         const std::string& mode, bool has_stride) {
        return "{\"buffer\":1,\"byteLength\":" + std::to_string(stride * count) +
               (has_stride ? ",\"byteStride\":" + std::to_string(stride) : "") +
               ",\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":" + std::to_string(begin) +
               ",\"byteLength\":" + std::to_string(length) + ",\"byteStride\":" + std::to_string(stride) +
               ",\"count\":" + std::to_string(count) + "," + mode + "}}}";
    };
    const std::string accessors =
        "{\"bufferView\":0,\"type\":\"VEC3\",\"componentType\":" + std::to_string(file.type) +
        ",\"count\":" + std::to_string(points) +
        "},{\"bufferView\":1,\"type\":\"SCALAR\",\"componentType\":" + (file.index_size == 4 ? "5125" : "5123") +
        ",\"count\":" + std::to_string(file.corners.size()) + "}";
    const std::string rest =
        "\"bufferViews\":[" +
        view(0, vertex_bytes, file.stride, points, R"("mode":"ATTRIBUTES","filter":")" + file.filter + '"', true) +
        "," +
        view(index_begin, bytes.size() - index_begin, file.index_size, file.corners.size(),
             file.are_triangles ? R"("mode":"TRIANGLES")" : R"("mode":"INDICES")", false) +
        "],\"buffers\":[{\"byteLength\":" + std::to_string(bytes.size()) +
        "},{\"byteLength\":1000,\"extensions\":{\"EXT_meshopt_compression\":{\"fallback\":true}}}]";
    return glb(packed_json(file.required, file.nodes, "", accessors, rest), bytes);
}

/// A tetrahedron in each of the modes.
inline MeshoptFile meshopt_tetrahedron(bool are_triangles, std::string filter = "NONE") {
    MeshoptFile file;
    file.vertices = floats(packed_tetrahedron().points);
    file.filter = std::move(filter);
    file.corners = packed_tetrahedron().corners;
    file.are_triangles = are_triangles;
    return file;
}

// --- Draco ---

struct DracoOptions {
    draco::MeshEncoderMethod method = draco::MESH_EDGEBREAKER_ENCODING;
    int speed = 5;
    int bits = 11;  ///< of a coordinate; 0: as they are
    bool has_texture = false;
};

/// Draco data of a soup of triangles. Attribute 0: positions; 1: texture coordinates, if wanted, with a seam.
inline std::string draco_data(const PolygonSoup& soup, const DracoOptions& options = {}) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(soup.face_count()));
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int texture =
        options.has_texture ? builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32) : -1;
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        std::array<std::array<float, 3>, 3> p{};
        std::array<std::array<float, 2>, 3> t{};
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec3& point = soup.points[soup.corners[3 * f + c]];
            p[c] = {static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)};
            t[c] = {p[c][0] + (2 * f < soup.face_count() ? 0.F : 9.F), p[c][1]};
        }
        const draco::FaceIndex face(static_cast<std::uint32_t>(f));
        builder.SetAttributeValuesForFace(position, face, p[0].data(), p[1].data(), p[2].data());
        if (texture >= 0) builder.SetAttributeValuesForFace(texture, face, t[0].data(), t[1].data(), t[2].data());
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetSpeedOptions(options.speed, options.speed);
    encoder.SetEncodingMethod(options.method);
    if (options.bits > 0) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, options.bits);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 10);
    draco::EncoderBuffer buffer;
    return mesh != nullptr && encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()
               ? std::string(buffer.data(), buffer.size())
               : std::string();
}

inline std::string draco_glb(const std::string& data, std::size_t points, std::size_t corners,
                             const std::string& nodes = "[{\"mesh\":0}]",
                             const std::string& required = "\"KHR_draco_mesh_compression\"") {
    const std::string accessors = "{\"type\":\"VEC3\",\"componentType\":5126,\"count\":" + std::to_string(points) +
                                  "},{\"type\":\"SCALAR\",\"componentType\":5125,\"count\":" + std::to_string(corners) +
                                  "}";
    const std::string length = std::to_string(data.size());
    return glb(packed_json(required, nodes,
                           ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0,\"attributes\":{"
                           "\"POSITION\":0}}}",
                           accessors,
                           "\"bufferViews\":[{\"buffer\":0,\"byteLength\":" + length +
                               "}],\"buffers\":[{\"byteLength\":" + length + "}]"),
               data);
}

/// With the counts that Draco itself finds in the data.
inline std::string draco_glb(const std::string& data, const std::string& nodes = "[{\"mesh\":0}]") {
    draco::DecoderBuffer buffer;
    buffer.Init(data.data(), data.size());
    draco::Decoder decoder;
    const std::unique_ptr<draco::Mesh> mesh = decoder.DecodeMeshFromBuffer(&buffer).value();
    return draco_glb(data, mesh->num_points(), 3 * std::size_t{mesh->num_faces()}, nodes);
}

}  // namespace delmesh::test
