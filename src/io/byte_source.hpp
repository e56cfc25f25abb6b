#pragma once
// Where the bytes of a mesh come from. A decompressor is one more source, put in front of a file.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace delmesh::io {

class ByteSource {
public:
    ByteSource() = default;
    ByteSource(const ByteSource&) = delete;
    ByteSource& operator=(const ByteSource&) = delete;
    virtual ~ByteSource() = default;

    /// Puts 1 to `capacity` bytes to `to` and returns how many; 0 at the end. Throws `Error` (file_not_readable).
    virtual std::size_t read(char* to, std::size_t capacity) = 0;
    /// How many bytes it gives in all, where that is known beforehand.
    [[nodiscard]] virtual std::optional<std::uint64_t> size() const = 0;
};

class MemorySource final : public ByteSource {
public:
    explicit MemorySource(std::span<const std::byte> bytes) : bytes_(bytes) {}
    std::size_t read(char* to, std::size_t capacity) override;
    [[nodiscard]] std::optional<std::uint64_t> size() const override { return bytes_.size(); }

private:
    std::span<const std::byte> bytes_;
    std::size_t given_ = 0;
};

/// A file, pipe or device, read from its beginning with read(2): a mapped file that shrinks meanwhile would end the
/// process. "/dev/stdin" is read from where it stands.
class FileSource final : public ByteSource {
public:
    explicit FileSource(const std::filesystem::path& path);
    ~FileSource() override;
    std::size_t read(char* to, std::size_t capacity) override;
    [[nodiscard]] std::optional<std::uint64_t> size() const override { return size_; }

private:
    std::string name_;
    int descriptor_ = -1;
    std::optional<std::uint64_t> size_;
};

}  // namespace delmesh::io
