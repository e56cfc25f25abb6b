#include "io/gltf_draco.hpp"

#include "io/gltf_accessor.hpp"
#include "io/messages.hpp"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

namespace delmesh::io {

namespace {

/// A table of symbols takes this many steps to fill, however few values an attribute has.
constexpr std::uint64_t cost_of_attribute = std::uint64_t{1} << 14;

/// Corners and numbers that a mesh may have beside those that its bytes stand for: a scan has 5 for each byte of Draco
/// data at 14 bits and 15 at 8, and only what is flat and regular has more than 64.
constexpr std::uint64_t always_allowed = std::uint64_t{1} << 20;
constexpr std::uint64_t most_growth = 64;

constexpr std::string_view advice = ": save the mesh anew, or without Draco";

/// The counts that the data begin with: sums in 64 bits, since they are 32 bits of anything.
struct DracoCounts {
    std::uint64_t faces = 0;
    std::uint64_t points = 0;
    std::uint64_t seams = 0;  ///< attributes whose corners have tables of their own
};

/// What the accessors promise, and what is left to spend.
struct DracoLimits {
    std::uint64_t points = 0;
    std::optional<std::uint64_t> corners;
    std::uint64_t attribute = 0;
    std::uint64_t left = 0;
};

std::optional<DracoCounts> peek_counts(const draco::MeshEdgebreakerDecoder*, draco::DecoderBuffer buffer) {
    std::uint32_t vertices = 0;
    std::uint32_t faces = 0;
    std::uint8_t seams = 0;
    std::uint32_t symbols = 0;
    std::uint32_t splits = 0;
    const bool whole = draco::DecodeVarint(&vertices, &buffer) && draco::DecodeVarint(&faces, &buffer) &&
                       buffer.Decode(&seams) && draco::DecodeVarint(&symbols, &buffer) &&
                       draco::DecodeVarint(&splits, &buffer);
    if (!whole) return std::nullopt;
    return DracoCounts{faces, std::uint64_t{vertices} + splits, seams};
}

std::optional<DracoCounts> peek_counts(const draco::MeshSequentialDecoder*, draco::DecoderBuffer buffer) {
    std::uint32_t faces = 0;
    std::uint32_t points = 0;
    if (!draco::DecodeVarint(&faces, &buffer) || !draco::DecodeVarint(&points, &buffer)) return std::nullopt;
    return DracoCounts{faces, points, 0};
}

/// Negative where there is none.
int find_attribute(const draco::PointCloud& mesh, std::uint64_t number) {
    return number <= 0xffffffffU ? mesh.GetAttributeIdByUniqueId(static_cast<std::uint32_t>(number)) : -1;
}

/// A decoder of the library that stops, before it asks for memory, where the data claim too much.
template <class Decoder>
class LimitedDecoder final : public Decoder {
public:
    explicit LimitedDecoder(DracoLimits& limits) : limits_(limits) {}

    /// What made it stop; empty where the data are damaged.
    [[nodiscard]] const std::string& fault() const { return fault_; }

private:
    bool DecodeConnectivity() override {
        const std::optional<DracoCounts> counts = peek_counts(this, *this->buffer());
        if (!counts) return false;
        if (limits_.corners && *limits_.corners != 3 * counts->faces)
            return stop(fmt::format("expected {} corners, as the accessor of its indices says, found {} faces",
                                    *limits_.corners, counts->faces));
        encoded_points_ = counts->points;
        return spend(3 * counts->faces * (1 + counts->seams), 1) && spend(counts->points, 1) &&
               Decoder::DecodeConnectivity();
    }
    bool CreateAttributesDecoder(std::int32_t number) override {
        // Each has a table of all attributes before its own.
        constexpr std::int32_t most = 64;
        if (number >= most)
            return stop(fmt::format("expected at most {} groups of Draco attributes, found more", most));
        return Decoder::CreateAttributesDecoder(number);
    }
    /// Decodes no further than to the positions.
    bool DecodeAllAttributes() override {
        const draco::PointCloud& mesh = *this->point_cloud();
        if (mesh.num_points() != limits_.points)
            return stop(fmt::format("expected {} points, as the accessor of its positions says, found {}",
                                    limits_.points, mesh.num_points()));
        const int wanted = find_attribute(mesh, limits_.attribute);
        if (wanted < 0 || mesh.attribute(wanted)->attribute_type() != draco::GeometryAttribute::POSITION)
            return stop(fmt::format("expected positions as Draco attribute {}, found none", limits_.attribute));
        for (int i = 0; i < this->num_attributes_decoders(); ++i) {
            // (The library gives out no other pointer.)
            auto& decoder = const_cast<draco::AttributesDecoderInterface&>(*this->attributes_decoder(i));
            std::uint64_t components = 0;
            bool is_last = false;
            for (int a = 0; a < decoder.GetNumAttributes(); ++a) {
                components += mesh.attribute(decoder.GetAttributeId(a))->num_components();
                is_last = is_last || decoder.GetAttributeId(a) == wanted;
            }
            const std::uint64_t values = std::max<std::uint64_t>(mesh.num_points(), encoded_points_);
            const auto attributes = static_cast<std::uint64_t>(decoder.GetNumAttributes());
            if (!spend(attributes, cost_of_attribute) || !spend(values, components)) return false;
            if (!decoder.DecodeAttributes(this->buffer()) || !fault_.empty()) return false;
            if (is_last) return true;
        }
        return false;
    }
    /// The library asks for this once it has read by which method an attribute is predicted from the faces. What
    /// texture coordinates need begins with a count that it takes by its word; they come after the positions.
    const draco::MeshAttributeIndicesEncodingData* GetAttributeEncodingData(int attribute) const override {
        constexpr std::ptrdiff_t back = 2;  // the method, and how differences wrap
        const char method = *(const_cast<LimitedDecoder*>(this)->buffer()->data_head() - back);
        if (method == draco::MESH_PREDICTION_TEX_COORDS_PORTABLE ||
            method == draco::MESH_PREDICTION_TEX_COORDS_DEPRECATED) {
            fault_ = "expected positions before texture coordinates, found them later";
            return nullptr;
        }
        return Decoder::GetAttributeEncodingData(attribute);
    }

    bool stop(std::string fault) {
        fault_ = std::move(fault);
        return false;
    }
    bool spend(std::uint64_t elements, std::uint64_t each) {
        if (elements > limits_.left || (each > 0 && elements > limits_.left / each))
            return stop("expected a mesh in proportion to its bytes, found more corners and attributes");
        limits_.left -= elements * each;
        return true;
    }

    DracoLimits& limits_;
    std::uint64_t encoded_points_ = 0;
    mutable std::string fault_;
};

class DracoReader {
public:
    DracoReader(GltfFile& file, std::uint64_t view) : file_(file), view_(view), bytes_(file.buffer_view(view).bytes) {}

    void decode(DracoLimits& limits, SceneBuilder& scene) {
        const std::uint64_t allowed = std::min(scene.left(), always_allowed + most_growth * bytes_.size());
        limits.left = allowed;
        draco::DecoderBuffer buffer;
        buffer.Init(bytes_.data(), bytes_.size());
        draco::DracoHeader header;
        draco::DecoderBuffer start = buffer;
        if (!draco::PointCloudDecoder::DecodeHeader(&start, &header).ok())
            fail("expected Draco data, found " + quote(bytes_.substr(0, 5)));
        // What glTF knows. Older data are read by other parts of the library, and metadata nest.
        if (header.version_major != 2 || header.version_minor != 2)
            fail(fmt::format("expected Draco data of version 2.2, found version {}.{}", header.version_major,
                             header.version_minor));
        if (header.encoder_type != draco::TRIANGULAR_MESH) fail("expected a mesh, found Draco data of another kind");
        if ((header.flags & METADATA_FLAG_MASK) != 0) fail("expected Draco data without metadata, found some");
        if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
            decode_with<draco::MeshEdgebreakerDecoder>(buffer, limits);
        } else if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
            decode_with<draco::MeshSequentialDecoder>(buffer, limits);
        } else {
            fail("expected Draco data of one of its two methods, found another");
        }
        scene.expect(allowed - limits.left);
    }

    DracoMesh mesh(std::uint64_t attribute, std::uint64_t type) const {
        DracoMesh result;
        result.corners.reserve(3 * std::size_t{mesh_.num_faces()});
        for (draco::FaceIndex f(0); f < mesh_.num_faces(); ++f)
            for (const draco::PointIndex& corner : mesh_.face(f)) {
                if (corner.value() >= mesh_.num_points())
                    fail(fmt::format("expected a Draco vertex below {}, found {}", mesh_.num_points(), corner.value()));
                result.corners.push_back(corner.value());
            }
        const draco::PointAttribute& found = positions(attribute, type);
        if (!found.is_mapping_identity() && found.indices_map_size() < mesh_.num_points())
            fail("expected Draco data, found points without positions");
        const std::size_t size = 3 * size_of_component(type);
        result.positions.reserve(size * mesh_.num_points());
        for (draco::PointIndex p(0); p < mesh_.num_points(); ++p) {
            const std::uint64_t begin = std::uint64_t{found.mapped_index(p).value()} * size;
            const auto& data = *found.buffer();
            if (begin + size > data.data_size()) fail("expected Draco data, found points without positions");
            result.positions.append(reinterpret_cast<const char*>(data.data()) + begin, size);
        }
        return result;
    }

    [[noreturn]] void fail(const std::string& what) const {
        file_.refuse(fmt::format("glTF buffer view {}: {}{}", view_, what, advice), ErrorCode::file_format);
    }

private:
    template <class Decoder>
    void decode_with(draco::DecoderBuffer& buffer, DracoLimits& limits) {
        LimitedDecoder<Decoder> decoder(limits);
        std::string reason;
        try {
            const draco::Status status = decoder.Decode(draco::DecoderOptions(), &buffer, &mesh_);
            if (status.ok() && decoder.fault().empty()) return;
            reason = status.error_msg_string();
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& error) {
            reason = error.what();
        }
        if (!decoder.fault().empty()) fail(decoder.fault());
        fail(fmt::format("expected Draco data, found damaged data ({})", printable(reason)));
    }

    /// Requires that it is there.
    const draco::PointAttribute& positions(std::uint64_t number, std::uint64_t type) const {
        const draco::PointAttribute& found = *mesh_.attribute(find_attribute(mesh_, number));
        if (found.num_components() != 3 || type_of(found.data_type()) != type ||
            found.byte_stride() != static_cast<std::int64_t>(3 * size_of_component(type)) || found.buffer() == nullptr)
            fail(fmt::format("expected Draco attribute {} to be three numbers of its accessor's type, found others",
                             number));
        return found;
    }

    static std::uint64_t type_of(draco::DataType type) {
        switch (type) {
            case draco::DT_INT8:
                return type_byte;
            case draco::DT_UINT8:
                return type_unsigned_byte;
            case draco::DT_INT16:
                return type_short;
            case draco::DT_UINT16:
                return type_unsigned_short;
            case draco::DT_FLOAT32:
                return type_float;
            default:
                return 0;
        }
    }

    GltfFile& file_;
    std::uint64_t view_;
    std::string_view bytes_;
    draco::Mesh mesh_;
};

}  // namespace

DracoMesh decode_draco(GltfFile& file, const Json& primitive, const Json& extension, SceneBuilder& scene) {
    const Json* const attributes = extension.find("attributes");
    const Json* const accessors = primitive.find("attributes");
    if (attributes == nullptr || accessors == nullptr)
        file.refuse(fmt::format("expected attributes of Draco data, found none{}", advice), ErrorCode::file_format);
    const Json& positions = file.element("accessors", file.number(*accessors, "POSITION"));
    DracoLimits limits;
    limits.points = file.number(positions, "count");
    limits.attribute = file.number(*attributes, "POSITION");
    // Of a strip there are fewer indices than corners.
    const bool are_triangles = file.find_number(primitive, "mode").value_or(4) == 4;
    if (const auto indices = file.find_number(primitive, "indices"); indices && are_triangles)
        limits.corners = file.number(file.element("accessors", *indices), "count");
    DracoReader reader(file, file.number(extension, "bufferView"));
    scene.set_file_bytes(file.size());
    reader.decode(limits, scene);
    return reader.mesh(limits.attribute, file.number(positions, "componentType"));
}

}  // namespace delmesh::io
