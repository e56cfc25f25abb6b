#pragma once
// A file that appears whole or not at all.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace delmesh::io {

/// Bytes go to a temporary file beside the target, which `commit()` renames to the target's name. An existing target
/// keeps its permissions; a symbolic link stays and the file it names is replaced. What is not a regular file
/// (a pipe, a device, /dev/stdout) is written directly. Every failure throws `Error` (file_not_writable) with the
/// reason; the temporary file is removed when the object goes away without a commit.
class OutputFile {
public:
    explicit OutputFile(const std::filesystem::path& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Room for at least `bytes` <= `most_room` bytes; `advance` says where what was put there ends.
    char* room(std::size_t bytes) {
        if (used_ + bytes > capacity) flush();
        return buffer_.get() + used_;
    }
    void advance(const char* end) { used_ = static_cast<std::size_t>(end - buffer_.get()); }
    /// Text of any length.
    void text(std::string_view text);
    void commit();

    static constexpr std::size_t most_room = std::size_t{1} << 16;

private:
    static constexpr std::size_t capacity = std::size_t{1} << 18;

    void forget_temporary();
    void open_beside(const std::filesystem::path& target);
    void keep_permissions(const std::filesystem::path& target);
    void flush();
    [[noreturn]] void fail(int error) const;

    std::string name_;
    std::filesystem::path target_;
    std::filesystem::path temporary_;  // empty: written directly
    std::size_t place_ = 0;            // among the names that a signal handler can see, one past
    int descriptor_ = -1;
    std::unique_ptr<char[]> buffer_;
    std::size_t used_ = 0;
};

}  // namespace delmesh::io
