#include "io/byte_source.hpp"

#include "delmesh/base/error.hpp"
#include "io/messages.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

namespace delmesh::io {

std::size_t MemorySource::read(char* to, std::size_t capacity) {
    const std::size_t n = std::min(capacity, bytes_.size() - given_);
    if (n > 0) std::memcpy(to, bytes_.data() + given_, n);
    given_ += n;
    return n;
}

namespace {

[[noreturn]] void fail(const std::string& name, int error) {
    throw Error(ErrorCode::file_not_readable, name + ": can not be read: " + std::strerror(error));
}

}  // namespace

FileSource::FileSource(const std::filesystem::path& path) : name_(printable(path.string())) {
    // Opening "/dev/stdin" anew would start at the beginning of a file that others have read from.
    const bool standard_input = path == "/dev/stdin";
    descriptor_ =
        standard_input ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(name_, errno);
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) return;
    const off_t done = standard_input ? ::lseek(descriptor_, 0, SEEK_CUR) : 0;
    if (status.st_size > done) size_ = static_cast<std::uint64_t>(status.st_size - done);
}

FileSource::~FileSource() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t FileSource::read(char* to, std::size_t capacity) {
    for (;;) {
        const ssize_t n = ::read(descriptor_, to, capacity);
        if (n >= 0) return static_cast<std::size_t>(n);
        if (errno != EINTR) fail(name_, errno);
    }
}

}  // namespace delmesh::io
