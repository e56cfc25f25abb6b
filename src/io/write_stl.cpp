#include "delmesh/base/error.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "io/endian.hpp"
#include "io/writers.hpp"

#include <array>
#include <cstring>
#include <limits>

namespace delmesh::io {

namespace {

constexpr std::size_t header_bytes = 80;
constexpr std::size_t facet_bytes = 50;

std::array<Vec3, 3> corners_of(const Surface& surface, std::size_t face) {
    const std::size_t i = surface.start(face);
    return {surface.points[surface.corner(i)], surface.points[surface.corner(i + 1)],
            surface.points[surface.corner(i + 2)]};
}

/// Of length 1; zero for a face without area. Products of floats neither overflow nor vanish in doubles.
Vec3 unit_normal(const std::array<Vec3, 3>& p) {
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    const double length = std::sqrt(squared_norm(normal));
    return length > 0 ? normal * (1 / length) : Vec3{};
}

char* store_floats(char* to, const Vec3& p) {
    to = store(to, static_cast<float>(p.x));
    to = store(to, static_cast<float>(p.y));
    return store(to, static_cast<float>(p.z));
}

void write_binary(OutputFile& file, const Surface& surface) {
    if (surface.face_count() > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorCode::too_large, "expected at most 4294967295 faces for binary STL, found more: write PLY");
    }
    // Must not begin with "solid", which would make it an ascii file to many readers.
    char header[header_bytes] = "binary STL written by delmesh";
    file.text({header, header_bytes});
    file.advance(store(file.room(4), static_cast<std::uint32_t>(surface.face_count())));
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
        const auto corners = corners_of(surface, f);
        char* to = store_floats(file.room(facet_bytes), unit_normal(corners));
        for (const Vec3& p : corners) to = store_floats(to, p);
        file.advance(store(to, std::uint16_t{0}));
    }
}

void write_ascii(OutputFile& file, const Surface& surface) {
    const auto line = [&file](std::string_view start, const Vec3& p, std::string_view rest) {
        file.text(start);
        file.advance(put(file.room(4 * number_room), p));
        file.text(rest);
    };
    file.text("solid delmesh\n");
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
        const auto corners = corners_of(surface, f);
        line("facet normal ", round_to_float(unit_normal(corners)), "\n outer loop\n");
        for (const Vec3& p : corners) line("  vertex ", p, "\n");
        file.text(" endloop\nendfacet\n");
    }
    file.text("endsolid delmesh\n");
}

}  // namespace

void write_stl(OutputFile& file, const Surface& surface, bool ascii) {
    if (ascii) {
        write_ascii(file, surface);
    } else {
        write_binary(file, surface);
    }
}

}  // namespace delmesh::io
