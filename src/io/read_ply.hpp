#pragma once
// What the two readers of PLY bodies share.

#include "io/input.hpp"
#include "io/ply_header.hpp"
#include "io/soup_builder.hpp"

#include <cstdint>

namespace delmesh::io {

/// Triangle strips: every three successive vertices are a triangle, every second one turned round; a negative number
/// starts anew. Triangles that repeat a vertex only carry the strip on and are left out.
class StripBuilder {
public:
    explicit StripBuilder(SoupBuilder& builder) : builder_(builder) {}

    void restart() { length_ = 0; }
    void add(std::uint32_t vertex);

private:
    SoupBuilder& builder_;
    std::uint32_t last_[2] = {0, 0};
    std::uint64_t length_ = 0;
};

/// Hands the elements of a file to the body that reads them, in their order.
template <class Body>
void read_elements(const PlyHeader& header, Body& body) {
    for (std::size_t i = 0; i < header.elements.size(); ++i) {
        const PlyElement& element = header.elements[i];
        if (element.properties.empty() || element.count == 0) continue;
        if (PlyHeader::is_vertex(element)) {
            body.read_vertices(element);
        } else if (PlyHeader::is_face(element)) {
            body.read_faces(element, header.index_list[i]);
        } else if (PlyHeader::is_strips(element)) {
            body.read_strips(element, header.index_list[i]);
        } else {
            body.skip_records(element);
        }
    }
}

void read_ply_ascii(TextScanner& scanner, Input& input, const PlyHeader& header, SoupBuilder& builder);
void read_ply_binary(Input& input, const PlyHeader& header, SoupBuilder& builder);

}  // namespace delmesh::io
