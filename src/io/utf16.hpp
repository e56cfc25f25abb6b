#pragma once
// Text as UTF-16, which editors of some systems save: what the byte order mark says is UTF-16 comes out as UTF-8.

#include "io/byte_source.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace delmesh::io {

/// Gives the bytes of another source: UTF-8 without the mark if they begin with the byte order mark of UTF-16, of
/// either order, and as they are if not. Throws `Error` (file_format) that names the byte where the text is no UTF-16
/// (half a character, half a pair of surrogates), and of UTF-32. Memory: 256 KiB.
class Utf16Source final : public ByteSource {
public:
    /// Looks at the first bytes of `source`, which must outlive this; `name` stands in messages.
    Utf16Source(ByteSource& source, std::string_view name);
    std::size_t read(char* to, std::size_t capacity) override;
    /// Known only where nothing is converted.
    [[nodiscard]] std::optional<std::uint64_t> size() const override;

private:
    enum class Order { none, little, big };

    std::size_t give(char* to, std::size_t capacity);
    bool convert_more();
    void convert(std::uint32_t unit);
    void append(std::uint32_t code);
    [[noreturn]] void fail(const std::string& what) const;

    ByteSource& source_;
    std::string name_;
    Order order_ = Order::none;
    std::string raw_;   ///< not yet converted
    std::string text_;  ///< not yet given, from `given_`
    std::size_t given_ = 0;
    std::uint32_t first_half_ = 0;  ///< of a pair of surrogates, or 0
    std::uint64_t position_ = 0;    ///< of the next unit
};

}  // namespace delmesh::io
