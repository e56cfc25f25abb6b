#include "io/read_ply.hpp"

#include "io/readers.hpp"

#include <algorithm>

namespace delmesh::io {

namespace {

Precision precision_of(const PlyHeader& header) {
    const auto vertices = std::ranges::find_if(header.elements, PlyHeader::is_vertex);
    for (const char* axis : {"x", "y", "z"}) {
        if (!fits_float(vertices->properties[vertices->find(axis)].type)) return Precision::float64;
    }
    return Precision::float32;
}

}  // namespace

void StripBuilder::add(std::uint32_t vertex) {
    ++length_;
    if (length_ > 2 && vertex != last_[0] && vertex != last_[1] && last_[0] != last_[1]) {
        const bool turned = length_ % 2 == 0;
        builder_.add_triangle(last_[turned ? 1 : 0], last_[turned ? 0 : 1], vertex);
    }
    last_[0] = last_[1];
    last_[1] = vertex;
}

void read_ply(Input& input, SoupBuilder& builder) {
    input.ensure(5);
    const std::string_view start = input.view();
    const bool old_mac = start.size() > 4 && start[3] == '\r' && start[4] != '\n';
    TextScanner scanner(input, {}, old_mac ? '\r' : '\n');
    const PlyHeader header = read_ply_header(scanner);
    builder.soup.stored = precision_of(header);
    if (header.encoding == PlyEncoding::ascii) {
        read_ply_ascii(scanner, input, header, builder);
    } else {
        scanner.release();
        read_ply_binary(input, header, builder);
    }
}

}  // namespace delmesh::io
