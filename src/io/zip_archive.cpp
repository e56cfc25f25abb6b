#include "io/zip_archive.hpp"

#include "io/read_all.hpp"
#include "io/unpack.hpp"

#include <fmt/format.h>
#include <zip.h>
#include <array>
#include <cerrno>
#include <new>

namespace delmesh::io {

namespace {

/// libzip calls an archive damaged, or has no error at all, where some of its allocations failed; `errno` still tells,
/// if it was 0 before the call.
bool lacks_memory(zip_error_t* error) {
    return errno == ENOMEM || zip_error_code_zip(error) == ZIP_ER_MEMORY;
}

[[noreturn]] void fail_open(zip_error_t& error, const std::string& name) {
    const bool no_memory = lacks_memory(&error);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    if (no_memory) throw std::bad_alloc();
    throw Error(
        ErrorCode::file_format,
        fmt::format("{}: {}", name,
                    with_advice(fmt::format("expected a ZIP archive, found damaged data ({})", printable(reason)),
                                ErrorCode::file_format)));
}

zip_t* open(const std::string& bytes, const std::string& name) {
    zip_error_t error;
    zip_error_init(&error);
    errno = 0;
    zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source == nullptr) fail_open(error, name);
    zip_t* const archive = zip_open_from_source(source, ZIP_RDONLY, &error);
    if (archive == nullptr) {
        zip_source_free(source);
        fail_open(error, name);
    }
    zip_error_fini(&error);
    return archive;
}

}  // namespace

ZipArchive::ZipArchive(Input& input)
    : name_(input.name()),
      bytes_(read_all(input)),
      archive_(open(bytes_, name_), &zip_discard) {}

void ZipArchive::fail(const std::string& path, const std::string& what) const {
    throw Error(ErrorCode::file_format,
                fmt::format("{}: {}: {}", name_, quote(path), with_advice(what, ErrorCode::file_format)));
}

void ZipArchive::read(const std::string& path, const std::function<void(std::string_view, bool)>& take) {
    errno = 0;
    const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(
        zip_fopen(archive_.get(), path.c_str(), ZIP_FL_NOCASE), &zip_fclose);
    if (file == nullptr && lacks_memory(zip_get_error(archive_.get()))) throw std::bad_alloc();
    if (file == nullptr) fail(path, fmt::format("can not be unpacked ({})", printable(zip_strerror(archive_.get()))));
    std::array<char, std::size_t{1} << 16> buffer;
    for (;;) {
        errno = 0;
        const zip_int64_t n = zip_fread(file.get(), buffer.data(), buffer.size());
        if (n < 0 && lacks_memory(zip_file_get_error(file.get()))) throw std::bad_alloc();
        if (n < 0)
            fail(path, fmt::format("expected packed data, found damaged ones ({})",
                                   printable(zip_file_strerror(file.get()))));
        unpacked_ += static_cast<std::uint64_t>(n);
        if (grows_absurdly(unpacked_, bytes_.size())) fail(path, absurd_growth("an archive's files"));
        take({buffer.data(), static_cast<std::size_t>(n)}, n == 0);
        if (n == 0) return;
    }
}

}  // namespace delmesh::io
