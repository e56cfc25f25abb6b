#pragma once
// A ZIP archive in memory; its files are unpacked a piece at a time.

#include "io/input.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

struct zip;

namespace delmesh::io {

class ZipArchive {
public:
    /// Throws `Error` (file_format) where the bytes are no archive.
    explicit ZipArchive(Input& input);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }
    /// Hands out the content of a file in pieces, the last of which is marked (and may be empty). Throws `Error`
    /// (file_format) where it is not there, damaged, encrypted, or where all that was read grows absurdly.
    void read(const std::string& path, const std::function<void(std::string_view piece, bool last)>& take);

private:
    [[noreturn]] void fail(const std::string& path, const std::string& what) const;

    std::string name_;
    std::string bytes_;
    std::unique_ptr<zip, void (*)(zip*)> archive_;
    std::uint64_t unpacked_ = 0;
};

}  // namespace delmesh::io
