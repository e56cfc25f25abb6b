#include "io/gltf_file.hpp"

#include "io/endian.hpp"
#include "io/gltf_meshopt.hpp"
#include "io/messages.hpp"
#include "io/read_all.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>
#include <utility>

namespace delmesh::io {

namespace {

constexpr std::string_view glb_magic = "glTF";

std::uint32_t word(std::string_view bytes, std::size_t at) {
    return load<std::uint32_t, std::endian::little>(bytes.data() + at);
}

/// Extensions that change nothing about where triangles are, or that are read.
bool is_harmless(std::string_view extension) {
    constexpr std::array<std::string_view, 11> prefixes{"KHR_materials_",  "KHR_technique",         "KHR_texture_",
                                                        "EXT_texture_",    "MSFT_texture_",         "KHR_lights_",
                                                        "KHR_xmp",         "KHR_mesh_quantization", draco_extension,
                                                        meshopt_extension, newer_meshopt_extension};
    return std::ranges::any_of(prefixes, [&](std::string_view prefix) { return extension.starts_with(prefix); });
}

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// "%20" is a blank.
std::string decode_percent(std::string_view uri) {
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escaped =
            uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0;
        result += escaped ? static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])) : uri[i];
        if (escaped) i += 2;
    }
    return result;
}

}  // namespace

GltfFile::GltfFile(Input& input, std::filesystem::path folder)
    : name_(input.name()),
      folder_(std::move(folder)),
      bytes_(read_all(input)),
      size_(bytes_.size()) {
    parse(open_container());
    check_version();
    note_extensions();
    buffers_.resize(list(root_, "buffers").size());
}

void GltfFile::fail(const std::string& what, ErrorCode code) const {
    refuse(with_advice(what, code), code);
}

void GltfFile::refuse(const std::string& what, ErrorCode code) const {
    throw Error(code, name_ + ": " + what);
}

// --- the container ---

std::string_view GltfFile::open_container() {
    const std::string_view all = bytes_;
    if (!all.starts_with(glb_magic)) return all;
    constexpr std::size_t header = 12;
    constexpr std::size_t chunk_header = 8;
    if (all.size() < header)
        fail(fmt::format("byte {}: expected 12 bytes of a glTF header, found the end of the file", all.size()));
    if (word(all, 4) != 2)
        fail(fmt::format("expected binary glTF of version 2, found version {}: save it as glTF 2.0", word(all, 4)),
             ErrorCode::unsupported_format);
    std::optional<std::string_view> json;
    std::size_t at = header;
    while (!chunk_ && all.size() - at >= chunk_header) {
        const std::uint32_t length = word(all, at);
        const std::string_view type = all.substr(at + 4, 4);
        at += chunk_header;
        if (length > all.size() - at)
            fail(fmt::format("byte {}: expected a glTF chunk of {} bytes, found {} before the end of the file", at,
                             length, all.size() - at));
        if (!json && type == "JSON") {
            json = all.substr(at, length);
            json_begin_ = at;
        } else if (type == std::string_view("BIN\0", 4)) {
            chunk_ = all.substr(at, length);
        }
        at += length;
    }
    if (!json) fail(fmt::format("byte {}: expected a chunk of JSON, found none", header));
    // Some programs pad with zeros, not with blanks.
    return json->substr(0, json->find_last_not_of('\0') + 1);
}

void GltfFile::parse(std::string_view json) {
    if (const auto fault = parse_gltf_json(json, root_)) {
        if (fault->too_deep) fail(fmt::format("expected at most {} levels of glTF JSON, found more", deepest_json));
        const std::size_t at = std::min(fault->position, json.size());
        fail(fmt::format("byte {}: expected glTF JSON, found {}", json_begin_ + at,
                         at < json.size() ? quote(json.substr(at, 20)) : "its end"));
    }
}

void GltfFile::check_version() const {
    const Json* const asset = root_.find("asset");
    const std::string_view version = asset == nullptr ? std::string_view() : text(*asset, "version");
    if (version.starts_with("2.")) return;
    fail(fmt::format("expected glTF of version 2, found {}: save it as glTF 2.0",
                     version.empty() ? "JSON that names no version of glTF" : "version " + quote(version)),
         ErrorCode::unsupported_format);
}

void GltfFile::note_extensions() {
    for (const Json& extension : list(root_, "extensionsRequired")) {
        const std::string name = extension.text() == nullptr ? std::string() : *extension.text();
        if (is_harmless(name)) {
            required_.insert(name);
            continue;
        }
        fail(fmt::format("expected plain glTF, found that the extension {} is needed, which is not read: save the mesh "
                         "without it",
                         quote(name)),
             ErrorCode::unsupported_format);
    }
}

bool GltfFile::is_required(std::string_view extension) const {
    return required_.contains(extension);
}

// --- JSON ---

const Json* GltfFile::extension(const Json& object, const char* name) const {
    const Json* const extensions = object.find("extensions");
    return extensions == nullptr ? nullptr : extensions->find(name);
}

const Json::List& GltfFile::list(const Json& object, const char* key) const {
    static const Json::List empty;
    const Json* const found = object.find(key);
    if (found == nullptr) return empty;
    if (found->list() == nullptr) fail(fmt::format("expected a glTF list {}, found another kind of value", quote(key)));
    return *found->list();
}

const Json& GltfFile::element(const char* key, std::uint64_t number) const {
    const Json::List& all = list(root_, key);
    if (number >= all.size())
        fail(fmt::format("expected a number below {} in the glTF list {}, found {}", all.size(), quote(key), number),
             ErrorCode::index_out_of_range);
    return all[static_cast<std::size_t>(number)];
}

std::uint64_t GltfFile::whole_number(const Json& value, const char* what) const {
    constexpr double largest = 0x1p53;
    if (const auto whole = value.whole()) return *whole;
    const auto real = value.real();  // some programs write 3.0
    if (real && *real >= 0 && *real <= largest && *real == std::floor(*real)) return static_cast<std::uint64_t>(*real);
    fail(fmt::format("expected a whole number as glTF {}, found {}", quote(what),
                     real ? fmt::format("{}", *real) : std::string("another kind of value")));
}

std::optional<std::uint64_t> GltfFile::find_number(const Json& object, const char* key) const {
    const Json* const found = object.find(key);
    if (found == nullptr) return std::nullopt;
    return whole_number(*found, key);
}

std::uint64_t GltfFile::number(const Json& object, const char* key) const {
    const auto found = find_number(object, key);
    if (!found) fail(fmt::format("expected a number as glTF {}, found none", quote(key)));
    return *found;
}

std::vector<double> GltfFile::reals(const Json& object, const char* key, std::size_t count) const {
    const Json::List& values = list(object, key);
    std::vector<double> result;
    for (const Json& value : values)
        if (const auto real = value.real(); real && result.size() < count) result.push_back(*real);
    if (result.size() != values.size() || (!values.empty() && values.size() != count))
        fail(fmt::format("expected {} numbers as glTF {}, found others", count, quote(key)));
    return result;
}

std::string_view GltfFile::text(const Json& object, const char* key) const {
    const Json* const found = object.find(key);
    if (found == nullptr) return {};
    if (found->text() == nullptr)
        fail(fmt::format("expected text as glTF {}, found another kind of value", quote(key)));
    return *found->text();
}

// --- buffers ---

std::string_view GltfFile::buffer(std::uint64_t number) {
    const Json& json = element("buffers", number);
    Buffer& buffer = buffers_[static_cast<std::size_t>(number)];
    if (buffer.known) return buffer.bytes;
    const std::string_view uri = text(json, "uri");
    if (uri.empty()) {
        if (number != 0 || !chunk_) fail(fmt::format("expected data of glTF buffer {}, found none", number));
        buffer.bytes = *chunk_;
    } else {
        const std::size_t comma = uri.find(',');
        const bool embedded = uri.starts_with("data:") && comma != uri.npos;
        if (embedded) buffer.owned = decode_base64(uri.substr(comma + 1));
        buffer.bytes = embedded ? std::string_view(buffer.owned) : read_beside(uri);
    }
    buffer.known = true;
    return buffer.bytes;
}

bool GltfFile::has_data(std::uint64_t buffer) const {
    return !text(element("buffers", buffer), "uri").empty() || (buffer == 0 && chunk_.has_value());
}

std::string_view GltfFile::slice(const Json& json) {
    const std::string_view all = buffer(number(json, "buffer"));
    const std::uint64_t begin = find_number(json, "byteOffset").value_or(0);
    const std::uint64_t length = number(json, "byteLength");
    if (begin > all.size() || length > all.size() - begin)
        fail(fmt::format("glTF buffer {}: expected {} bytes of a buffer view from byte {}, found a buffer of {}",
                         number(json, "buffer"), length, begin, all.size()));
    return all.substr(static_cast<std::size_t>(begin), static_cast<std::size_t>(length));
}

GltfView GltfFile::buffer_view(std::uint64_t number) {
    const Json& view = element("bufferViews", number);
    const std::uint64_t stride = find_number(view, "byteStride").value_or(0);
    const Json* packed = nullptr;
    for (const char* const name : {meshopt_extension, newer_meshopt_extension}) {
        const Json* const found = extension(view, name);
        // What need not be unpacked is there without.
        if (found != nullptr && (is_required(name) || !has_data(this->number(view, "buffer")))) packed = found;
    }
    if (packed == nullptr) return {slice(view), stride};
    const auto found = unpacked_.find(number);
    if (found != unpacked_.end()) return {found->second, stride};
    return {unpacked_.emplace(number, unpack(view, *packed, number)).first->second, stride};
}

std::string GltfFile::unpack(const Json& view, const Json& packed, std::uint64_t number) {
    const std::string_view bytes = slice(packed);
    const std::uint64_t length = this->number(view, "byteLength");
    // Many views may be unpacked from the same bytes.
    if (length > meshopt_growth * size_ - unpacked_bytes_)
        refuse(fmt::format("glTF buffer view {}: expected meshopt data in proportion to the file, found more: save the "
                           "mesh without meshopt compression",
                           number),
               ErrorCode::file_format);
    unpacked_bytes_ += length;
    return decode_meshopt(*this, packed, bytes, length, number);
}

std::string GltfFile::decode_base64(std::string_view text) const {
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int digit = base64_digit(c);
        if (digit < 0) fail(fmt::format("expected base64 data in a glTF buffer, found {}", quote({&c, 1})));
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xffU);
    }
    return bytes;
}

/// A file may name files in its own folder and below, and no others.
std::string_view GltfFile::read_beside(std::string_view uri) {
    const std::filesystem::path inside = decode_percent(uri);
    const bool below = inside.is_relative() && std::ranges::find(inside, "..") == inside.end() &&
                       uri.find(':') == uri.npos && uri.find('\0') == uri.npos;
    if (folder_.empty() || !below)
        fail(fmt::format("expected glTF data in the file or its folder, found that they are in {}: put them beside it",
                         quote(uri)),
             ErrorCode::unsupported_format);
    std::error_code error;
    const std::filesystem::path path = std::filesystem::canonical(folder_ / inside, error);
    if (error || !std::filesystem::is_regular_file(path, error))
        fail(fmt::format("expected the file {} of glTF data beside it, found none", quote(uri)),
             ErrorCode::file_not_readable);
    const auto found = files_.find(path);
    if (found != files_.end()) return found->second;
    FileSource source(path);
    Input input(source, (folder_ / inside).string());
    std::string bytes = read_all(input);
    size_ += bytes.size();
    return files_.emplace(path, std::move(bytes)).first->second;
}

}  // namespace delmesh::io
