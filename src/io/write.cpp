#include "delmesh/io/write.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "io/messages.hpp"
#include "io/writers.hpp"

#include <fmt/format.h>
#include <cmath>

namespace delmesh {

namespace io {

namespace {

Format format_of(const std::filesystem::path& path, const WriteOptions& options) {
    const std::optional<Format> format = options.format ? options.format : format_from_path(path);
    if (format && can_write(*format)) return *format;
    throw Error(ErrorCode::unsupported_format,
                printable(path.string()) + ": expected an extension .ply, .obj, .off or .stl, or a format to write");
}

bool is_float(double value) {
    return !std::isfinite(value) || round_to_float(value) == value;
}

void check_floats(const std::filesystem::path& path, const Surface& surface) {
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        const Vec3& p = surface.points[i];
        if (is_float(p.x) && is_float(p.y) && is_float(p.z)) continue;
        throw Error(ErrorCode::bad_argument,
                    fmt::format("{}: expected coordinates that are floats, found vertex {} at {} {} {}: round before "
                                "the surface is processed",
                                printable(path.string()), i, p.x, p.y, p.z),
                    {i});
    }
}

void check_indices(const std::filesystem::path& path, const Surface& surface) {
    const std::size_t points = surface.points.size();
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
        for (std::size_t i = surface.start(f); i < surface.start(f + 1); ++i) {
            if (surface.corner(i) < points) continue;
            throw Error(ErrorCode::index_out_of_range,
                        fmt::format("{}: expected vertex indices below {}, found {} in face {}",
                                    printable(path.string()), points, surface.corner(i), f),
                        {f});
        }
    }
    for (const auto& line : surface.lines) {
        if (line[0] < points && line[1] < points) continue;
        throw Error(ErrorCode::index_out_of_range,
                    fmt::format("{}: expected vertex indices below {}, found a line from {} to {}",
                                printable(path.string()), points, line[0], line[1]));
    }
}

void write(const std::filesystem::path& path, const Surface& surface, const WriteOptions& options) {
    const Format format = format_of(path, options);
    if (stored_precision(format, options) == Precision::float32) check_floats(path, surface);
    check_indices(path, surface);
    OutputFile file(path);
    switch (format) {
        case Format::ply:
            write_ply(file, surface, options);
            break;
        case Format::obj:
            write_obj(file, surface);
            break;
        case Format::off:
            write_off(file, surface);
            break;
        case Format::stl:
            write_stl(file, surface, options.ascii);
            break;
        case Format::gltf:
        case Format::three_mf:
            break;  // refused by format_of
    }
    file.commit();
}

}  // namespace

}  // namespace io

Precision stored_precision(Format format, const WriteOptions& options) {
    return format == Format::stl ? Precision::float32 : options.precision;
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const WriteOptions& options) {
    io::write(path, io::Surface(mesh), options);
}

void write_soup(const std::filesystem::path& path, const PolygonSoup& soup, const WriteOptions& options) {
    if (io::format_of(path, options) == Format::stl && !soup.is_triangles()) {
        PolygonSoup triangles = soup;
        triangulate(triangles);
        io::write(path, io::Surface(triangles), options);
    } else {
        io::write(path, io::Surface(soup), options);
    }
}

}  // namespace delmesh
