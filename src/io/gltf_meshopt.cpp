#include "io/gltf_meshopt.hpp"

#include "io/messages.hpp"

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace delmesh::io {

namespace {

class MeshoptReader {
public:
    MeshoptReader(const GltfFile& file, const Json& extension, std::uint64_t view)
        : file_(file),
          view_(view),
          mode_(file.text(extension, "mode")),
          filter_(file.text(extension, "filter")),
          stride_(file.number(extension, "byteStride")),
          count_(file.number(extension, "count")) {}

    /// The library takes what its description forbids for mistakes of the program, and ends it.
    void check(std::size_t packed, std::uint64_t length) const {
        const bool are_vertices = mode_ == "ATTRIBUTES";
        const bool are_indices = mode_ == "TRIANGLES" || mode_ == "INDICES";
        const bool fits = are_vertices  ? stride_ >= 4 && stride_ <= 256 && stride_ % 4 == 0
                          : are_indices ? stride_ == 2 || stride_ == 4
                                        : false;
        if (!are_vertices && !are_indices)
            fail("expected meshopt data of mode ATTRIBUTES, TRIANGLES or INDICES, found " + quote(mode_));
        if (!fits) fail(fmt::format("expected a stride that meshopt mode {} allows, found {}", mode_, stride_));
        // Normals and rotations are no positions; and what becomes of them depends on the processor.
        const bool is_filtered = !filter_.empty() && filter_ != "NONE";
        if (is_filtered && (filter_ != "EXPONENTIAL" || !are_vertices))
            fail(fmt::format("expected meshopt mode {} without a filter for other data, found {}", mode_,
                             quote(filter_)));
        if (count_ > length || count_ * stride_ != length)
            fail(fmt::format("expected {} bytes as {} meshopt elements of {} bytes, found others", length, count_,
                             stride_));
        if (mode_ == "TRIANGLES" && count_ % 3 != 0)
            fail(fmt::format("expected a multiple of three meshopt indices of triangles, found {}", count_));
        if (length / meshopt_growth > packed)
            fail(fmt::format("expected meshopt data of {} bytes, found {} packed bytes, which are too few", length,
                             packed));
    }

    void decode(std::string_view packed, std::string& to) const {
        const auto* const from = reinterpret_cast<const unsigned char*>(packed.data());
        const auto count = static_cast<std::size_t>(count_);
        const auto stride = static_cast<std::size_t>(stride_);
        const int fault =
            mode_ == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(to.data(), count, stride, from, packed.size())
            : mode_ == "TRIANGLES" ? meshopt_decodeIndexBuffer(to.data(), count, stride, from, packed.size())
                                   : meshopt_decodeIndexSequence(to.data(), count, stride, from, packed.size());
        if (fault == -1)
            fail("expected meshopt data of mode " + std::string(mode_) + ", found another kind or version");
        if (fault != 0) fail(fmt::format("expected {} meshopt elements, found damaged data", count));
        if (filter_ == "EXPONENTIAL") meshopt_decodeFilterExp(to.data(), count, stride);
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        file_.refuse(
            fmt::format("glTF buffer view {}: {}: save the mesh anew, or without meshopt compression", view_, what),
            ErrorCode::file_format);
    }

    const GltfFile& file_;
    std::uint64_t view_;
    std::string_view mode_;
    std::string_view filter_;
    std::uint64_t stride_;
    std::uint64_t count_;
};

}  // namespace

std::string decode_meshopt(const GltfFile& file, const Json& extension, std::string_view packed, std::uint64_t length,
                           std::uint64_t view) {
    const MeshoptReader reader(file, extension, view);
    reader.check(packed.size(), length);
    std::string bytes(static_cast<std::size_t>(length), '\0');
    reader.decode(packed, bytes);
    return bytes;
}

}  // namespace delmesh::io
