#pragma once
// Compressed files: what the first bytes say is gzip or Zstandard is unpacked on the way, a piece at a time.

#include "io/byte_source.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace delmesh::io {

/// True where `unpacked` bytes are more than `packed` ones can honestly hold.
[[nodiscard]] bool grows_absurdly(std::uint64_t unpacked, std::uint64_t packed);
/// What to say then, of `what` (in the plural).
[[nodiscard]] std::string absurd_growth(std::string_view what);

/// Gives the bytes of another source, unpacked if they are gzip (RFC 1952, any number of members) or Zstandard
/// (RFC 8878, any number of frames), and as they are if not. Throws `Error` (file_format) that names the byte of the
/// packed data where these are damaged or cut off, and where they unpack to an absurd multiple of their size: memory
/// shall follow what a file really holds.
class UnpackedSource final : public ByteSource {
public:
    /// Looks at the first bytes of `packed`, which must outlive this; `name` stands in messages.
    UnpackedSource(ByteSource& packed, std::string_view name);
    ~UnpackedSource() override;
    std::size_t read(char* to, std::size_t capacity) override;
    /// Known only where nothing is unpacked.
    [[nodiscard]] std::optional<std::uint64_t> size() const override;

    class Decoder;

private:
    std::size_t give_start(char* to, std::size_t capacity);

    ByteSource& packed_;
    std::string start_;
    std::size_t given_ = 0;
    std::unique_ptr<Decoder> decoder_;
};

}  // namespace delmesh::io
