#include "io/input.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstring>
#include <utility>

namespace delmesh::io {

std::string printable(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x20 && byte != 0x7f) {
            result += c;
        } else {
            result += fmt::format("\\x{:02x}", byte);
        }
    }
    return result;
}

std::string quote(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string result = "'";
    for (const char c : text.substr(0, longest)) {
        const auto byte = static_cast<unsigned char>(c);
        result += byte < 0x80 ? printable({&c, 1}) : fmt::format("\\x{:02x}", byte);
    }
    return result + (text.size() > longest ? "...'" : "'");
}

std::string with_advice(std::string sentence, ErrorCode code) {
    const bool is_damage = code == ErrorCode::file_format || code == ErrorCode::index_out_of_range;
    return is_damage ? std::move(sentence) + ": save the mesh anew" : std::move(sentence);
}

Input::Input(ByteSource& source, std::string_view name, std::size_t window)
    : source_(source),
      name_(printable(name)),
      buffer_(new char[window]),
      capacity_(window) {}

bool Input::more() {
    if (at_end_) return false;
    if (begin_ > 0) {
        std::memmove(buffer_.get(), buffer_.get() + begin_, available());
        window_offset_ += begin_;
        end_ -= begin_;
        begin_ = 0;
    }
    if (end_ == capacity_) {
        std::unique_ptr<char[]> larger(new char[2 * capacity_]);
        std::memcpy(larger.get(), buffer_.get(), end_);
        buffer_ = std::move(larger);
        capacity_ *= 2;
    }
    const std::size_t n = source_.read(buffer_.get() + end_, capacity_ - end_);
    end_ += n;
    at_end_ = n == 0;
    return !at_end_;
}

bool Input::skip_far(std::uint64_t bytes) {
    for (;;) {
        const std::size_t n = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, available()));
        skip(n);
        bytes -= n;
        if (bytes == 0) return true;
        if (!more()) return false;
    }
}

std::optional<std::uint64_t> Input::remaining() const {
    if (at_end_) return available();
    const auto size = source_.size();
    if (!size) return std::nullopt;
    return std::max(*size, offset() + available()) - offset();
}

std::size_t Input::plausible(std::uint64_t count, std::uint64_t record_bytes) const {
    constexpr std::uint64_t unknown_size = std::uint64_t{1} << 16;
    const auto left = remaining();
    return static_cast<std::size_t>(std::min(count, left ? *left / record_bytes : unknown_size));
}

void Input::fail_at(std::uint64_t offset, const std::string& what, ErrorCode code) const {
    throw Error(code, fmt::format("{}: byte {}: {}", name_, offset, what));
}

}  // namespace delmesh::io
