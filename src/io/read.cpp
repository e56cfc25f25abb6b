#include "delmesh/io/read.hpp"

#include "io/readers.hpp"
#include "io/unpack.hpp"
#include "io/utf16.hpp"

#include <string>

namespace delmesh {

namespace io {

namespace {

void skip_byte_order_mark(Input& input) {
    input.ensure(3);
    if (input.view().starts_with("\xef\xbb\xbf")) input.skip(3);
}

void read_format(Format format, Input& input, SoupBuilder& builder, const std::filesystem::path& folder) {
    switch (format) {
        case Format::ply:
            return read_ply(input, builder);
        case Format::obj:
            return read_obj(input, builder);
        case Format::off:
            return read_off(input, builder);
        case Format::stl:
            return read_stl(input, builder);
        case Format::gltf:
            builder.soup = read_gltf(input, folder);
            return;
        case Format::three_mf:
            builder.soup = read_3mf(input);
            return;
    }
    throw Error(ErrorCode::unsupported_format, input.name() + ": this format is not read");
}

}  // namespace

PolygonSoup read_input(Input& input, std::optional<Format> hint, const ReadOptions& options,
                       const std::filesystem::path& folder) {
    if (input.ensure(1) == 0) input.fail("expected a mesh, found an empty file");
    skip_byte_order_mark(input);
    const std::optional<Format> detected = detect_format(input);
    const std::optional<Format> format = options.format ? options.format : detected ? detected : hint;
    if (!format) {
        throw Error(ErrorCode::unsupported_format, input.name() +
                                                       ": expected PLY, OBJ, OFF, STL, glTF or 3MF, found none of them "
                                                       "by content or extension: save the mesh as one of these");
    }
    SoupBuilder builder(options.damage);
    builder.salvage.attempt([&] { read_format(*format, input, builder, folder); });
    if (builder.salvage.found_damage()) {
        builder.leave_out_face();
        builder.leave_out_dangling();
        if (builder.soup.face_count() == 0) throw Error(ErrorCode::file_format, builder.salvage.first());
    }
    return std::move(builder.soup);
}

namespace {

/// By the extension, of what is packed if the name says that it is.
std::optional<Format> hint_of(const std::filesystem::path& path) {
    const std::string last = path.extension().string();
    return format_from_path(last == ".gz" || last == ".zst" ? path.stem() : path);
}

PolygonSoup read_source(ByteSource& source, const std::string& name, const ReadOptions& options,
                        const std::filesystem::path& folder) {
    UnpackedSource unpacked(source, name);
    Utf16Source text(unpacked, name);
    Input input(text, name);
    return read_input(input, hint_of(name), options, folder);
}

}  // namespace

}  // namespace io

PolygonSoup read_soup(const std::filesystem::path& path, const ReadOptions& options) {
    io::FileSource source(path);
    const std::filesystem::path folder = path.parent_path();
    return io::read_source(source, path.string(), options, folder.empty() ? "." : folder);
}

PolygonSoup parse_soup(std::span<const std::byte> bytes, std::string_view name, const ReadOptions& options) {
    io::MemorySource source(bytes);
    return io::read_source(source, std::string(name), options, {});
}

}  // namespace delmesh
