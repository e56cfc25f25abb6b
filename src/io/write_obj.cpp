#include "io/writers.hpp"

#include <fmt/format.h>

namespace delmesh::io {

void write_obj(OutputFile& file, const Surface& surface) {
    file.text(
        fmt::format("# written by delmesh: {} vertices, {} faces\n", surface.points.size(), surface.face_count()));
    for (const Vec3& p : surface.points) {
        char* to = put(put(file.room(4 * number_room), 'v'), ' ');
        file.advance(put(put(to, p), '\n'));
    }
    const auto add_index = [&file](std::uint32_t vertex) {
        file.advance(put(put(file.room(number_room), ' '), std::uint64_t{vertex} + 1));
    };
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
        if (surface.start(f) == surface.start(f + 1)) continue;  // the format has no faces without vertices
        file.text("f");
        for (std::size_t i = surface.start(f); i < surface.start(f + 1); ++i) add_index(surface.corner(i));
        file.text("\n");
    }
    for (const auto& line : surface.lines) {
        file.text("l");
        add_index(line[0]);
        add_index(line[1]);
        file.text("\n");
    }
}

}  // namespace delmesh::io
