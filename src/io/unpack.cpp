#include "io/unpack.hpp"

#include "delmesh/base/error.hpp"
#include "io/messages.hpp"

#include <fmt/format.h>
#define ZLIB_CONST
#include <zlib.h>
#include <zstd.h>
#include <zstd_errors.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <new>

namespace delmesh::io {

namespace {

constexpr std::size_t chunk = std::size_t{1} << 16;

/// Meshes are packed to a third or a tenth. What grows more than this is made to fill memory.
constexpr std::uint64_t most_growth = 250;
constexpr std::uint64_t always_allowed = std::uint64_t{64} << 20;

constexpr std::string_view gzip_magic("\x1f\x8b", 2);
constexpr std::string_view zstd_magic("\x28\xb5\x2f\xfd", 4);
constexpr std::size_t longest_magic = 4;

/// Frames of user data, which parallel compressors write before the first frame of content.
bool is_zstd_skippable(std::string_view start) {
    return start.size() >= 4 && (start[0] & 0xf0) == 0x50 && start.substr(1, 3) == "\x2a\x4d\x18";
}

}  // namespace

bool grows_absurdly(std::uint64_t unpacked, std::uint64_t packed) {
    return unpacked > always_allowed && unpacked / most_growth > packed;
}

std::string absurd_growth(std::string_view what) {
    return fmt::format("expected a mesh, found {} that unpack to more than {} times their size", what, most_growth);
}

/// The packed bytes, a chunk at a time, and the words of errors; what unpacks them derives from it.
class UnpackedSource::Decoder {
public:
    Decoder(ByteSource& packed, std::string_view start, std::string name, const char* format)
        : packed_(packed),
          name_(std::move(name)),
          format_(format),
          end_(start.size()) {
        start.copy(buffer_.data(), start.size());
    }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
    virtual ~Decoder() = default;

    std::size_t read(char* to, std::size_t capacity) {
        const std::size_t n = decode(to, std::min<std::size_t>(capacity, std::numeric_limits<unsigned>::max()));
        given_ += n;
        if (grows_absurdly(given_, position())) fail(absurd_growth(format_) + ": unpack them first");
        return n;
    }

protected:
    virtual std::size_t decode(char* to, std::size_t capacity) = 0;

    [[nodiscard]] std::string_view view() const { return {buffer_.data() + begin_, end_ - begin_}; }
    void skip(std::size_t bytes) { begin_ += bytes; }
    /// Has at least one packed byte in view; false at their end.
    bool refill() {
        if (begin_ < end_) return true;
        before_ += end_;
        begin_ = 0;
        end_ = packed_.read(buffer_.data(), buffer_.size());
        return end_ > 0;
    }
    /// The same, where there must be more.
    void need() {
        if (!refill()) fail(fmt::format("expected more {}, found the end of the file", format_));
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::file_format, fmt::format("{}: byte {}: {}", name_, position(), what));
    }
    [[noreturn]] void fail_damaged(const char* reason) const {
        fail(fmt::format("expected {}, found damaged data ({})", format_, printable(reason)));
    }

private:
    [[nodiscard]] std::uint64_t position() const { return before_ + begin_; }

    ByteSource& packed_;
    std::string name_;
    const char* format_;
    std::array<char, chunk> buffer_;
    std::size_t begin_ = 0;
    std::size_t end_;
    std::uint64_t before_ = 0;
    std::uint64_t given_ = 0;
};

namespace {

class GzipDecoder final : public UnpackedSource::Decoder {
public:
    GzipDecoder(ByteSource& packed, std::string_view start, std::string name)
        : Decoder(packed, start, std::move(name), "gzip data") {
        constexpr int largest_window_with_gzip_header = 15 + 16;
        if (inflateInit2(&stream_, largest_window_with_gzip_header) != Z_OK) throw std::bad_alloc();
    }
    ~GzipDecoder() override { inflateEnd(&stream_); }

private:
    std::size_t decode(char* to, std::size_t capacity) override {
        stream_.next_out = reinterpret_cast<Bytef*>(to);
        stream_.avail_out = static_cast<uInt>(capacity);
        while (stream_.avail_out == capacity) {
            if (between_members_ && !next_member()) break;
            need();
            inflate_some();
        }
        return capacity - stream_.avail_out;
    }

    void inflate_some() {
        const std::string_view packed = view();
        stream_.next_in = reinterpret_cast<const Bytef*>(packed.data());
        stream_.avail_in = static_cast<uInt>(packed.size());
        const int result = inflate(&stream_, Z_NO_FLUSH);
        skip(packed.size() - stream_.avail_in);
        if (result == Z_MEM_ERROR) throw std::bad_alloc();
        if (result == Z_STREAM_END) {
            between_members_ = true;
        } else if (result != Z_OK && result != Z_BUF_ERROR) {
            fail_damaged(stream_.msg != nullptr ? stream_.msg : "a dictionary is asked for");
        }
    }

    /// Goes to the next member, past zeros that pad a file to blocks; false at the end.
    bool next_member() {
        bool padded = false;
        while (refill()) {
            const std::size_t zeros = std::min(view().find_first_not_of('\0'), view().size());
            padded = padded || zeros > 0;
            skip(zeros);
            if (view().empty()) continue;
            if (padded || view().front() != gzip_magic.front())
                fail("expected another member or the end of the gzip data, found " + quote(view().substr(0, 4)));
            between_members_ = false;
            inflateReset(&stream_);
            return true;
        }
        return false;
    }

    z_stream stream_{};
    bool between_members_ = false;
};

class ZstdDecoder final : public UnpackedSource::Decoder {
public:
    ZstdDecoder(ByteSource& packed, std::string_view start, std::string name)
        : Decoder(packed, start, std::move(name), "Zstandard data"),
          stream_(ZSTD_createDStream(), &ZSTD_freeDStream) {
        if (stream_ == nullptr) throw std::bad_alloc();
    }

private:
    std::size_t decode(char* to, std::size_t capacity) override {
        ZSTD_outBuffer out{to, capacity, 0};
        while (out.pos == 0) {
            const bool more = refill();
            // At a frame's end everything is flushed; else the rest may wait inside without a packed byte to come.
            if (!more && at_frame_end_) break;
            const std::string_view packed = view();
            ZSTD_inBuffer in{packed.data(), packed.size(), 0};
            const std::size_t wanted = ZSTD_decompressStream(stream_.get(), &out, &in);
            skip(in.pos);
            if (ZSTD_isError(wanted)) fail_error(wanted);
            at_frame_end_ = wanted == 0;
            if (!more && out.pos == 0 && !at_frame_end_) need();
        }
        return out.pos;
    }

    [[noreturn]] void fail_error(std::size_t result) const {
        if (ZSTD_getErrorCode(result) == ZSTD_error_memory_allocation) throw std::bad_alloc();
        fail_damaged(ZSTD_getErrorName(result));
    }

    std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream_;
    bool at_frame_end_ = false;
};

std::string first_bytes(ByteSource& source) {
    std::string start(longest_magic, '\0');
    std::size_t n = 0;
    while (n < start.size()) {
        const std::size_t here = source.read(start.data() + n, start.size() - n);
        if (here == 0) break;
        n += here;
    }
    start.resize(n);
    return start;
}

}  // namespace

UnpackedSource::UnpackedSource(ByteSource& packed, std::string_view name)
    : packed_(packed),
      start_(first_bytes(packed)) {
    if (start_.starts_with(gzip_magic)) {
        decoder_ = std::make_unique<GzipDecoder>(packed, start_, printable(name));
    } else if (start_.starts_with(zstd_magic) || is_zstd_skippable(start_)) {
        decoder_ = std::make_unique<ZstdDecoder>(packed, start_, printable(name));
    }
}

UnpackedSource::~UnpackedSource() = default;

std::optional<std::uint64_t> UnpackedSource::size() const {
    return decoder_ ? std::nullopt : packed_.size();
}

std::size_t UnpackedSource::read(char* to, std::size_t capacity) {
    if (decoder_) return decoder_->read(to, capacity);
    return given_ < start_.size() ? give_start(to, capacity) : packed_.read(to, capacity);
}

std::size_t UnpackedSource::give_start(char* to, std::size_t capacity) {
    const std::size_t n = start_.copy(to, capacity, given_);
    given_ += n;
    return n;
}

}  // namespace delmesh::io
