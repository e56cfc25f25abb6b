#include "io/read_off.hpp"
#include "io/readers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace delmesh::io {

namespace {

constexpr std::size_t looked_at = 65536;
constexpr std::size_t stl_header = 80;
constexpr std::size_t stl_facet = 50;

constexpr bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

std::uint32_t little_endian(const char* bytes) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

/// The first word that is not in a comment.
std::string_view first_word(std::string_view text) {
    for (;;) {
        const auto begin = std::ranges::find_if_not(text, is_blank);
        text.remove_prefix(static_cast<std::size_t>(begin - text.begin()));
        if (!text.starts_with('#')) break;
        text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
    }
    return text.substr(0, static_cast<std::size_t>(std::ranges::find_if(text, is_blank) - text.begin()));
}

bool is_solid(std::string_view word) {
    return word == "solid" || word == "SOLID" || word == "Solid";
}

/// True if the file is as long as a binary STL file with the number of facets that it says.
bool has_size_of_stl(const Input& input, std::string_view text) {
    if (text.size() < stl_header + 4) return false;
    const std::uint64_t facets = little_endian(text.data() + stl_header);
    return input.remaining() == stl_header + 4 + stl_facet * facets;
}

/// Where the size is not known, as of a pipe: the first facets must look like facets, with normals that are none or of
/// length one.
bool looks_like_facets(std::string_view text) {
    constexpr std::size_t enough = 16;
    if (text.size() < stl_header + 4 + stl_facet || little_endian(text.data() + stl_header) == 0) return false;
    const std::size_t facets = std::min(enough, (text.size() - stl_header - 4) / stl_facet);
    for (std::size_t f = 0; f < facets; ++f) {
        const char* facet = text.data() + stl_header + 4 + f * stl_facet;
        for (std::size_t i = 0; i < 12; ++i) {
            const float size = std::abs(std::bit_cast<float>(little_endian(facet + 4 * i)));
            const bool plausible = i < 3 ? size < 1.01F : size == 0 || (size > 1e-20F && size < 1e20F);
            if (!plausible) return false;
        }
    }
    return true;
}

bool is_obj_keyword(std::string_view word) {
    constexpr std::array<std::string_view, 12> keywords{"v", "vt", "vn", "vp", "f",      "l",
                                                        "p", "o",  "g",  "s",  "mtllib", "usemtl"};
    return std::ranges::find(keywords, word) != keywords.end();
}

/// Latin letters as UTF-16 without a byte order mark: every second byte is zero, and no other.
bool looks_like_utf16(std::string_view text) {
    constexpr std::size_t enough = 16;
    if (text.size() < enough) return false;
    for (std::size_t i = 0; i + 1 < enough; i += 2) {
        if ((text[i] == '\0') == (text[i + 1] == '\0') || (text[i] == '\0') != (text[0] == '\0')) return false;
    }
    return true;
}

void refuse_foreign(const Input& input, std::string_view text) {
    struct Magic {
        std::string_view bytes;
        const char* what;
    };
    constexpr std::array magics{Magic{"\x1f\x8b", "gzip data"}, Magic{"\x28\xb5\x2f\xfd", "Zstandard data"},
                                Magic{"BZh", "bzip2 data"},
                                Magic{"\xfd"
                                      "7zXZ",
                                      "xz data"}};
    for (const Magic& magic : magics) {
        if (text.starts_with(magic.bytes)) {
            throw Error(ErrorCode::unsupported_format, input.name() +
                                                           ": expected PLY, OBJ, OFF, STL, glTF or 3MF, found " +
                                                           magic.what + ", which is not read: unpack it first");
        }
    }
}

}  // namespace

bool is_binary_stl(Input& input) {
    input.ensure(looked_at);
    const std::string_view text = input.view().substr(0, looked_at);
    if (has_size_of_stl(input, text) || !is_solid(first_word(text))) return true;
    return text.substr(0, 4 * stl_header).find('\0') != text.npos;
}

std::optional<Format> detect_format(Input& input) {
    input.ensure(looked_at);
    const std::string_view text = input.view().substr(0, looked_at);
    refuse_foreign(input, text);
    if (text.size() > 3 && text.starts_with("ply") && is_blank(text[3])) return Format::ply;
    if (text.starts_with("glTF")) return Format::gltf;
    if (text.starts_with("PK\x03\x04")) return Format::three_mf;
    if (has_size_of_stl(input, text)) return Format::stl;
    const std::string_view word = first_word(text);
    if (word.starts_with('{')) return Format::gltf;
    if (parse_off_keyword(word)) return Format::off;
    if (is_solid(word)) return Format::stl;
    if (is_obj_keyword(word)) return Format::obj;
    if (looks_like_utf16(text))
        input.fail("expected ASCII or UTF-8 text, found UTF-16 text without a byte order mark: save it as UTF-8");
    if (!input.remaining() && looks_like_facets(text)) return Format::stl;
    return std::nullopt;
}

}  // namespace delmesh::io
