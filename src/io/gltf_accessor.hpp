#pragma once
// The numbers behind the accessors of a glTF file, every offset checked.

#include "delmesh/base/vec3.hpp"
#include "io/gltf_file.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace delmesh::io {

/// The numbers that glTF has for types, as in OpenGL.
enum ComponentType : std::uint64_t {
    type_byte = 5120,
    type_unsigned_byte = 5121,
    type_short = 5122,
    type_unsigned_short = 5123,
    type_unsigned_int = 5125,
    type_float = 5126,
};

/// In bytes; 0 for what is no type.
[[nodiscard]] std::size_t size_of_component(std::uint64_t type);

/// Equal steps through the bytes of a buffer.
struct GltfRecords {
    const char* first = nullptr;
    std::size_t stride = 0;

    [[nodiscard]] const char* at(std::uint64_t i) const { return first + static_cast<std::size_t>(i) * stride; }
};

/// Positions as floats, or as the integers, normalised or not, of KHR_mesh_quantization; sparse ones too.
class GltfPositions {
public:
    /// Throws `Error` where accessor `number` is of another type or reaches past its data.
    GltfPositions(GltfFile& file, std::uint64_t number);
    /// The same where the accessor's data are `data`, one position after another, and not in the file's buffers.
    GltfPositions(GltfFile& file, std::uint64_t number, std::string_view data);

    [[nodiscard]] std::uint64_t size() const { return count_; }
    /// `i` < size()
    [[nodiscard]] Vec3 operator[](std::uint64_t i) const;

private:
    [[nodiscard]] Vec3 decode(const char* from) const;
    void read_type(GltfFile& file, std::uint64_t number);
    void read_sparse(GltfFile& file, const Json& sparse);

    std::uint64_t count_ = 0;
    std::uint64_t type_ = 0;
    std::size_t component_size_ = 0;
    bool normalized_ = false;
    GltfRecords records_;
    std::vector<std::pair<std::uint32_t, const char*>> replaced_;  ///< in the order of their indices
};

/// Unsigned integers of any size.
class GltfIndices {
public:
    GltfIndices(GltfFile& file, std::uint64_t number);

    [[nodiscard]] std::uint64_t size() const { return count_; }
    [[nodiscard]] std::uint32_t operator[](std::uint64_t i) const;

private:
    std::uint64_t count_ = 0;
    std::uint64_t type_ = 0;
    GltfRecords records_;
};

}  // namespace delmesh::io
