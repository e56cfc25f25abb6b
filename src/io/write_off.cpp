#include "io/writers.hpp"

#include <fmt/format.h>

namespace delmesh::io {

void write_off(OutputFile& file, const Surface& surface) {
    file.text(fmt::format("OFF\n{} {} 0\n", surface.points.size(), surface.face_count()));
    for (const Vec3& p : surface.points) file.advance(put(put(file.room(4 * number_room), p), '\n'));
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
        const std::size_t end = surface.start(f + 1);
        std::size_t i = surface.start(f);
        file.advance(put(file.room(number_room), std::uint64_t{end - i}));
        for (; i < end; ++i) file.advance(put(put(file.room(number_room), ' '), std::uint64_t{surface.corner(i)}));
        file.text("\n");
    }
}

}  // namespace delmesh::io
