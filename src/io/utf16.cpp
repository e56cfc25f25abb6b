#include "io/utf16.hpp"

#include "delmesh/base/error.hpp"
#include "io/messages.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace delmesh::io {

namespace {

constexpr std::size_t chunk = std::size_t{1} << 16;

constexpr bool is_first_half(std::uint32_t unit) {
    return unit >= 0xd800 && unit < 0xdc00;
}
constexpr bool is_second_half(std::uint32_t unit) {
    return unit >= 0xdc00 && unit < 0xe000;
}

}  // namespace

Utf16Source::Utf16Source(ByteSource& source, std::string_view name)
    : source_(source),
      name_(printable(name)),
      text_(4, '\0') {
    std::size_t n = 0;
    for (std::size_t more = 1; more > 0 && n < text_.size(); n += more)
        more = source.read(text_.data() + n, text_.size() - n);
    text_.resize(n);
    if (text_ == std::string_view("\xff\xfe\0\0", 4) || text_ == std::string_view("\0\0\xfe\xff", 4))
        fail("expected ASCII, UTF-8 or UTF-16 text, found UTF-32 text: save it as UTF-8");
    if (text_.starts_with("\xff\xfe")) order_ = Order::little;
    if (text_.starts_with("\xfe\xff")) order_ = Order::big;
    if (order_ == Order::none) return;
    raw_ = text_.substr(2);
    text_.clear();
    position_ = 2;
}

std::optional<std::uint64_t> Utf16Source::size() const {
    return order_ == Order::none ? source_.size() : std::nullopt;
}

std::size_t Utf16Source::read(char* to, std::size_t capacity) {
    if (given_ < text_.size()) return give(to, capacity);
    if (order_ == Order::none) return source_.read(to, capacity);
    while (given_ == text_.size())
        if (!convert_more()) return 0;
    return give(to, capacity);
}

std::size_t Utf16Source::give(char* to, std::size_t capacity) {
    const std::size_t n = text_.copy(to, capacity, given_);
    given_ += n;
    return n;
}

/// False at the end. What comes may hold no whole character.
bool Utf16Source::convert_more() {
    text_.clear();
    given_ = 0;
    const std::size_t left = raw_.size();
    raw_.resize(left + chunk);
    const std::size_t more = source_.read(raw_.data() + left, chunk);
    raw_.resize(left + more);
    if (more == 0 && left == 0 && first_half_ == 0) return false;
    if (more == 0 && left < 2) fail("expected the second half of a UTF-16 character, found the end of the file");
    const std::size_t low = order_ == Order::little ? 0 : 1;
    for (std::size_t i = 0; i + 1 < raw_.size(); i += 2, position_ += 2) {
        const auto unit_low = static_cast<unsigned char>(raw_[i + low]);
        const auto unit_high = static_cast<unsigned char>(raw_[i + 1 - low]);
        convert(static_cast<std::uint32_t>(unit_high << 8 | unit_low));
    }
    raw_.erase(0, raw_.size() / 2 * 2);
    return true;
}

void Utf16Source::convert(std::uint32_t unit) {
    if (is_second_half(unit) != (first_half_ != 0))
        fail(fmt::format("expected {} of UTF-16, found 0x{:04x}",
                         first_half_ != 0 ? "the second half of a surrogate pair" : "a character", unit));
    if (is_first_half(unit)) {
        first_half_ = unit;
    } else if (first_half_ == 0) {
        append(unit);
    } else {
        append(0x10000 + ((first_half_ - 0xd800) << 10) + (unit - 0xdc00));
        first_half_ = 0;
    }
}

void Utf16Source::append(std::uint32_t code) {
    const auto put = [this](std::uint32_t byte) { text_ += static_cast<char>(byte); };
    const auto put_six_bits = [&](int shift) { put(0x80 | ((code >> shift) & 0x3f)); };
    if (code < 0x80) return put(code);
    if (code < 0x800) {
        put(0xc0 | code >> 6);
    } else if (code < 0x10000) {
        put(0xe0 | code >> 12);
        put_six_bits(6);
    } else {
        put(0xf0 | code >> 18);
        put_six_bits(12);
        put_six_bits(6);
    }
    put_six_bits(0);
}

void Utf16Source::fail(const std::string& what) const {
    throw Error(ErrorCode::file_format, fmt::format("{}: byte {}: {}", name_, position_, what));
}

}  // namespace delmesh::io
