#pragma once
// Text in UTF-16, for tests.

#include <string>
#include <string_view>

namespace delmesh::test {

inline std::string utf16_unit(unsigned unit, bool little) {
    const char low = static_cast<char>(unit & 0xff);
    const char high = static_cast<char>(unit >> 8);
    return little ? std::string{low, high} : std::string{high, low};
}

/// UTF-8 (which must be right) as UTF-16 with its byte order mark.
inline std::string utf16(std::string_view text, bool little) {
    std::string wide = utf16_unit(0xfeff, little);
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
        unsigned code = length == 1 ? lead : lead & (0x7fu >> length);
        for (std::size_t k = 1; k < length; ++k) code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3fu);
        i += length;
        if (code < 0x10000) {
            wide += utf16_unit(code, little);
        } else {
            wide += utf16_unit(0xd800 + ((code - 0x10000) >> 10), little);
            wide += utf16_unit(0xdc00 + ((code - 0x10000) & 0x3ff), little);
        }
    }
    return wide;
}

}  // namespace delmesh::test
