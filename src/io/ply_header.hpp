#pragma once
// The header of a PLY file: what lies in its body, and in which order.
// Source: G. Turk, "The PLY Polygon File Format", 1994.

#include "io/text_scanner.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace delmesh::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

[[nodiscard]] std::size_t size_of(PlyType type);
[[nodiscard]] constexpr bool is_integer(PlyType type) {
    return type < PlyType::float32;
}
/// True if every value of the type is a float.
[[nodiscard]] bool fits_float(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool is_list = false;
    PlyType count_type = PlyType::uint8;  ///< of lists
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// The name as it stands in messages: printable, and not too long.
    [[nodiscard]] std::string shown_name() const;
    /// The index of a property, or `properties.size()`.
    [[nodiscard]] std::size_t find(std::string_view property) const;
    /// The least number of bytes that one record takes in a binary file, or of characters in a text file.
    [[nodiscard]] std::size_t least_size(bool ascii) const;
    [[nodiscard]] bool has_lists() const;
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::uint64_t points = 0;
    /// For each element, the property that holds a face's or strip's vertices; its `properties.size()` where none does.
    std::vector<std::size_t> index_list;

    [[nodiscard]] static bool is_vertex(const PlyElement& element) { return element.name == "vertex"; }
    [[nodiscard]] static bool is_face(const PlyElement& element) { return element.name == "face"; }
    [[nodiscard]] static bool is_strips(const PlyElement& element) { return element.name == "tristrips"; }
};

/// Reads the lines up to "end_header". The elements it returns can be read: the vertices have x, y and z, faces and
/// strips have an integer list of vertices. Throws `Error` that names the line.
[[nodiscard]] PlyHeader read_ply_header(TextScanner& scanner);

}  // namespace delmesh::io
