#include "io/gltf_accessor.hpp"

#include "io/endian.hpp"
#include "io/messages.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace delmesh::io {

namespace {

constexpr auto order = std::endian::little;

bool is_index_type(std::uint64_t type) {
    return type == type_unsigned_byte || type == type_unsigned_short || type == type_unsigned_int;
}

/// Normalised integers stand for -1 to 1, or 0 to 1.
double load_component(const char* from, std::uint64_t type, bool normalized) {
    switch (type) {
        case type_byte: {
            const double value = load<std::int8_t, order>(from);
            return normalized ? std::max(value / 127, -1.0) : value;
        }
        case type_unsigned_byte: {
            const double value = load<std::uint8_t, order>(from);
            return normalized ? value / 255 : value;
        }
        case type_short: {
            const double value = load<std::int16_t, order>(from);
            return normalized ? std::max(value / 32767, -1.0) : value;
        }
        case type_unsigned_short: {
            const double value = load<std::uint16_t, order>(from);
            return normalized ? value / 65535 : value;
        }
        default:
            return load<float, order>(from);
    }
}

std::uint32_t load_index(const char* from, std::uint64_t type) {
    if (type == type_unsigned_byte) return load<std::uint8_t, order>(from);
    if (type == type_unsigned_short) return load<std::uint16_t, order>(from);
    return load<std::uint32_t, order>(from);
}

/// `count` elements of `size` bytes in the buffer view that `json` names, from its offset on.
GltfRecords find_records(GltfFile& file, const Json& json, std::uint64_t count, std::size_t size) {
    const std::uint64_t number = file.number(json, "bufferView");
    const GltfView view = file.buffer_view(number);
    const std::uint64_t length = view.bytes.size();
    const std::uint64_t offset = file.find_number(json, "byteOffset").value_or(0);
    const std::uint64_t stride = view.stride != 0 ? view.stride : size;
    const bool fits = count == 0 || (stride >= size && offset <= length && size <= length - offset &&
                                     count - 1 <= (length - offset - size) / stride);
    if (!fits)
        file.fail(fmt::format(
            "glTF buffer view {}: expected {} elements of {} bytes from byte {}, found a buffer view of {} bytes",
            number, count, size, offset, length));
    return {view.bytes.data() + (count == 0 ? 0 : offset), static_cast<std::size_t>(stride)};
}

}  // namespace

std::size_t size_of_component(std::uint64_t type) {
    switch (type) {
        case type_byte:
        case type_unsigned_byte:
            return 1;
        case type_short:
        case type_unsigned_short:
            return 2;
        case type_unsigned_int:
        case type_float:
            return 4;
        default:
            return 0;
    }
}

void GltfPositions::read_type(GltfFile& file, std::uint64_t number) {
    const Json& json = file.element("accessors", number);
    count_ = file.number(json, "count");
    type_ = file.number(json, "componentType");
    component_size_ = type_ == type_unsigned_int ? 0 : size_of_component(type_);
    const Json* const normalized = json.find("normalized");
    normalized_ = normalized != nullptr && normalized->is_true();
    if (file.text(json, "type") != "VEC3" || component_size_ == 0)
        file.fail(fmt::format(
            "expected three floats or short integers as glTF position, found accessor {} of another type", number));
}

GltfPositions::GltfPositions(GltfFile& file, std::uint64_t number) {
    read_type(file, number);
    const Json& json = file.element("accessors", number);
    const Json* const sparse = json.find("sparse");
    if (json.find("bufferView") != nullptr) {
        records_ = find_records(file, json, count_, 3 * component_size_);
    } else if (sparse == nullptr) {
        file.refuse(
            fmt::format("expected data of glTF accessor {}, found none: save the mesh without compression", number),
            ErrorCode::file_format);
    }
    if (sparse != nullptr) read_sparse(file, *sparse);
}

GltfPositions::GltfPositions(GltfFile& file, std::uint64_t number, std::string_view data) {
    read_type(file, number);
    count_ = data.size() / (3 * component_size_);
    records_ = {data.data(), 3 * component_size_};
}

void GltfPositions::read_sparse(GltfFile& file, const Json& sparse) {
    const std::uint64_t count = file.number(sparse, "count");
    const Json* const indices = sparse.find("indices");
    const Json* const values = sparse.find("values");
    if (indices == nullptr || values == nullptr)
        file.fail("expected indices and values of a sparse glTF accessor, found none");
    const std::uint64_t type = file.number(*indices, "componentType");
    if (!is_index_type(type)) file.fail("expected unsigned integers as glTF indices, found another type");
    const GltfRecords where = find_records(file, *indices, count, size_of_component(type));
    const GltfRecords what = find_records(file, *values, count, 3 * component_size_);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint32_t index = load_index(where.at(i), type);
        if (index >= count_)
            file.fail(fmt::format("expected a sparse glTF index below {}, found {}", count_, index),
                      ErrorCode::index_out_of_range);
        replaced_.emplace_back(index, what.at(i));
    }
    std::ranges::stable_sort(replaced_, {}, &std::pair<std::uint32_t, const char*>::first);
}

Vec3 GltfPositions::decode(const char* from) const {
    Vec3 p;
    for (const int axis : {0, 1, 2})
        p[axis] = load_component(from + static_cast<std::size_t>(axis) * component_size_, type_, normalized_);
    return p;
}

Vec3 GltfPositions::operator[](std::uint64_t i) const {
    if (!replaced_.empty()) {
        const auto found = std::ranges::lower_bound(replaced_, i, {}, &std::pair<std::uint32_t, const char*>::first);
        if (found != replaced_.end() && found->first == i) return decode(found->second);
    }
    return records_.first == nullptr ? Vec3{} : decode(records_.at(i));
}

GltfIndices::GltfIndices(GltfFile& file, std::uint64_t number) {
    const Json& json = file.element("accessors", number);
    count_ = file.number(json, "count");
    type_ = file.number(json, "componentType");
    if (file.text(json, "type") != "SCALAR" || !is_index_type(type_) || json.find("sparse") != nullptr)
        file.fail(
            fmt::format("expected plain unsigned integers as glTF indices, found accessor {} of another kind", number));
    records_ = find_records(file, json, count_, size_of_component(type_));
}

std::uint32_t GltfIndices::operator[](std::uint64_t i) const {
    return load_index(records_.at(i), type_);
}

}  // namespace delmesh::io
