#pragma once
// A window that moves over the bytes of a source. It only grows where a reader asks for more than fits.

#include "delmesh/base/error.hpp"
#include "io/byte_source.hpp"
#include "io/messages.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace delmesh::io {

class Input {
public:
    static constexpr std::size_t default_window = std::size_t{1} << 18;

    Input(ByteSource& source, std::string_view name, std::size_t window = default_window);

    /// The file's name as it stands in messages.
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] char* begin() { return buffer_.get() + begin_; }
    [[nodiscard]] char* end() { return buffer_.get() + end_; }
    [[nodiscard]] std::size_t available() const { return end_ - begin_; }
    [[nodiscard]] std::string_view view() const { return {buffer_.get() + begin_, available()}; }

    /// Tries to have `bytes` unread bytes in the window; returns how many there are (fewer at the end only). Moves the
    /// window: pointers into it are lost.
    std::size_t ensure(std::size_t bytes) {
        while (available() < bytes && more()) {
        }
        return available();
    }
    /// Gets at least one more byte into the window; false at the end. Moves the window.
    bool more();
    /// Leaves bytes of the window behind; `bytes` <= available().
    void skip(std::size_t bytes) { begin_ += bytes; }
    /// The same for any number of bytes; false if there are not as many.
    bool skip_far(std::uint64_t bytes);

    /// Position in the file of the first unread byte.
    [[nodiscard]] std::uint64_t offset() const { return window_offset_ + begin_; }
    /// How many unread bytes there are, where that is known.
    [[nodiscard]] std::optional<std::uint64_t> remaining() const;
    /// How many of `count` records of at least `record_bytes` (> 0) to make room for: never more than the file can
    /// hold.
    [[nodiscard]] std::size_t plausible(std::uint64_t count, std::uint64_t record_bytes) const;

    /// Throws "NAME: byte OFFSET: WHAT".
    [[noreturn]] void fail_at(std::uint64_t offset, const std::string& what,
                              ErrorCode code = ErrorCode::file_format) const;
    [[noreturn]] void fail(const std::string& what) const { fail_at(offset(), what); }

private:
    ByteSource& source_;
    std::string name_;
    std::unique_ptr<char[]> buffer_;
    std::size_t capacity_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
    std::uint64_t window_offset_ = 0;
    bool at_end_ = false;
};

}  // namespace delmesh::io
