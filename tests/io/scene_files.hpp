#pragma once
// glTF and 3MF files made by code, for tests and as seeds of the fuzz targets.

#include "io/endian.hpp"
#include "io/packing.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace delmesh::test {

template <class T>
void put(std::string& to, T value) {
    char bytes[sizeof(T)];
    io::store(bytes, value);
    to.append(bytes, sizeof(T));
}

inline std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t j = 0; j < 3; ++j)
            bits = bits << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0);
        for (std::size_t j = 0; j < 4; ++j) text += i + j > bytes.size() ? '=' : digits[bits >> (18 - 6 * j) & 63];
    }
    return text;
}

inline std::string glb(std::string json, std::string binary) {
    while (json.size() % 4 != 0) json += ' ';
    while (binary.size() % 4 != 0) binary += '\0';
    std::string file = "glTF";
    put(file, std::uint32_t{2});
    put(file, static_cast<std::uint32_t>(28 + json.size() + binary.size()));
    put(file, static_cast<std::uint32_t>(json.size()));
    file += "JSON" + json;
    put(file, static_cast<std::uint32_t>(binary.size()));
    return file + std::string("BIN\0", 4) + binary;
}

/// A ZIP archive, its files deflated.
inline std::string zip(const std::vector<std::pair<std::string, std::string>>& files) {
    std::string archive;
    std::string directory;
    for (const auto& [name, text] : files) {
        const std::string packed = deflated(text, -15);
        std::string common;
        for (const int v : {20, 0, 8, 0, 0x21}) put(common, static_cast<std::uint16_t>(v));
        put(common, static_cast<std::uint32_t>(
                        crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()))));
        put(common, static_cast<std::uint32_t>(packed.size()));
        put(common, static_cast<std::uint32_t>(text.size()));
        put(common, static_cast<std::uint16_t>(name.size()));
        put(common, std::uint16_t{0});
        directory += std::string("PK\1\2\24\0", 6) + common + std::string(10, '\0');
        put(directory, static_cast<std::uint32_t>(archive.size()));
        directory += name;
        archive += "PK\3\4" + common + name + packed;
    }
    std::string end("PK\5\6\0\0\0\0", 8);
    for (int i = 0; i < 2; ++i) put(end, static_cast<std::uint16_t>(files.size()));
    put(end, static_cast<std::uint32_t>(directory.size()));
    put(end, static_cast<std::uint32_t>(archive.size()));
    put(end, std::uint16_t{0});
    return archive + directory + end;
}

/// A 3MF package with one model file.
inline std::string package_3mf(const std::string& model) {
    return zip({{"_rels/.rels",
                 "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship "
                 "Target=\"/3D/3dmodel.model\" Id=\"a\" "
                 "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
                {"3D/3dmodel.model", model}});
}

/// A model file with these resources and build items.
inline std::string model_3mf(const std::string& resources, const std::string& items, const std::string& more = {}) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" "
           "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
           "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" " +
           more + ">\n<resources>" + resources + "</resources>\n<build>" + items + "</build>\n</model>\n";
}

inline std::string tetrahedron_3mf(int id) {
    return "<object id=\"" + std::to_string(id) +
           "\" type=\"model\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" "
           "z=\"0\"/><vertex "
           "x=\"0\" y=\"1\" z=\"0\"/><vertex x=\" +0.1 \" y=\"0\" z=\"1e0\"/></vertices><triangles><triangle v1=\"0\" "
           "v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/><triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle "
           "v1=\"2\" v2=\"0\" v3=\"3\"/></triangles></mesh></object>";
}

/// The four corners of a tetrahedron as floats (48 bytes), then its faces as 8-bit, 16-bit and 32-bit indices (12, 24
/// and 48 bytes): 132 bytes.
inline std::string tetrahedron_buffer() {
    std::string bytes;
    for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F}) put(bytes, x);
    constexpr std::uint8_t faces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    for (const std::uint8_t v : faces) put(bytes, v);
    for (const std::uint8_t v : faces) put(bytes, std::uint16_t{v});
    for (const std::uint8_t v : faces) put(bytes, std::uint32_t{v});
    return bytes;
}

/// Accessors 0: positions; 1, 2, 3: the faces as 8-bit, 16-bit and 32-bit indices. Mesh 0 uses `indices`.
inline std::string tetrahedron_json(const std::string& nodes, int indices = 1, const std::string& uri = {},
                                    const std::string& more = {}) {
    const auto accessor = [](int view, const char* type, int component, int count) {
        return "{\"bufferView\":" + std::to_string(view) + ",\"type\":\"" + type +
               "\",\"componentType\":" + std::to_string(component) + ",\"count\":" + std::to_string(count) + "}";
    };
    const auto view = [](int offset, int length) {
        return "{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) + ",\"byteLength\":" + std::to_string(length) +
               "}";
    };
    return "{\"asset\":{\"version\":\"2.0\"}," + more + "\"nodes\":" + nodes +
           ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":" + std::to_string(indices) +
           "}]}],\"accessors\":[" + accessor(0, "VEC3", 5126, 4) + "," + accessor(1, "SCALAR", 5121, 12) + "," +
           accessor(2, "SCALAR", 5123, 12) + "," + accessor(3, "SCALAR", 5125, 12) + "],\"bufferViews\":[" +
           view(0, 48) + "," + view(48, 12) + "," + view(60, 24) + "," + view(84, 48) +
           "],\"buffers\":[{\"byteLength\":132" + (uri.empty() ? "" : ",\"uri\":\"" + uri + "\"") + "}]}";
}

}  // namespace delmesh::test
