#include "io/endian.hpp"
#include "io/writers.hpp"

#include <fmt/format.h>

namespace delmesh::io {

namespace {

std::size_t largest_face(const Surface& surface) {
    std::size_t largest = surface.is_triangles() ? 3 : 0;
    for (std::size_t f = 0; f < surface.face_count() && !surface.is_triangles(); ++f) {
        largest = std::max(largest, surface.start(f + 1) - surface.start(f));
    }
    return largest;
}

void write_header(OutputFile& file, const Surface& surface, const WriteOptions& options, bool long_faces) {
    constexpr std::size_t most_signed = 0x7fffffff;
    file.text(
        fmt::format("ply\nformat {} 1.0\ncomment written by delmesh\nelement vertex {}\n"
                    "property {type} x\nproperty {type} y\nproperty {type} z\n"
                    "element face {}\nproperty list {} {} vertex_indices\nend_header\n",
                    options.ascii ? "ascii" : "binary_little_endian", surface.points.size(), surface.face_count(),
                    long_faces ? "uint" : "uchar", surface.points.size() > most_signed ? "uint" : "int",
                    fmt::arg("type", options.precision == Precision::float32 ? "float" : "double")));
}

template <class T>
void write_binary_points(OutputFile& file, const Surface& surface) {
    for (const Vec3& p : surface.points) {
        char* to = file.room(3 * sizeof(T));
        to = store(to, static_cast<T>(p.x));
        to = store(to, static_cast<T>(p.y));
        file.advance(store(to, static_cast<T>(p.z)));
    }
}

void write_binary_faces(OutputFile& file, const Surface& surface, bool long_faces) {
    std::size_t i = 0;
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
        const std::size_t end = surface.start(f + 1);
        char* to = file.room(4);
        file.advance(long_faces ? store(to, static_cast<std::uint32_t>(end - i))
                                : store(to, static_cast<std::uint8_t>(end - i)));
        for (; i < end; ++i) file.advance(store(file.room(4), surface.corner(i)));
    }
}

void write_ascii(OutputFile& file, const Surface& surface) {
    for (const Vec3& p : surface.points) file.advance(put(put(file.room(4 * number_room), p), '\n'));
    std::size_t i = 0;
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
        const std::size_t end = surface.start(f + 1);
        file.advance(put(file.room(number_room), std::uint64_t{end - i}));
        for (; i < end; ++i) file.advance(put(put(file.room(number_room), ' '), std::uint64_t{surface.corner(i)}));
        file.text("\n");
    }
}

}  // namespace

void write_ply(OutputFile& file, const Surface& surface, const WriteOptions& options) {
    const bool long_faces = largest_face(surface) > 255;
    write_header(file, surface, options, long_faces);
    if (options.ascii) {
        write_ascii(file, surface);
    } else {
        if (options.precision == Precision::float32) {
            write_binary_points<float>(file, surface);
        } else {
            write_binary_points<double>(file, surface);
        }
        write_binary_faces(file, surface, long_faces);
    }
}

}  // namespace delmesh::io
