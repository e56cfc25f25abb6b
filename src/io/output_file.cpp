#include "io/output_file.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/io/write.hpp"
#include "io/messages.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>

namespace delmesh::io {

namespace {

/// The number of an open descriptor that the path names, or -1: opening "/dev/stdout" anew would start at the beginning
/// of a file that the shell appends to.
int named_descriptor(const std::string& path) {
    if (path == "/dev/stdout") return STDOUT_FILENO;
    if (path == "/dev/stderr") return STDERR_FILENO;
    for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
        if (!path.starts_with(folder)) continue;
        int descriptor = -1;
        const char* end = path.data() + path.size();
        const auto [after, error] = std::from_chars(path.data() + folder.size(), end, descriptor);
        if (error == std::errc() && after == end) return descriptor;
    }
    return -1;
}

/// The name behind a chain of symbolic links, whether it is there or not.
std::filesystem::path follow_links(std::filesystem::path path, std::error_code& error) {
    constexpr int most_links = 40;
    for (int i = 0; i < most_links; ++i) {
        if (!std::filesystem::is_symlink(std::filesystem::symlink_status(path, error))) {
            error.clear();
            return path;
        }
        const std::filesystem::path link = std::filesystem::read_symlink(path, error);
        if (error) return path;
        path = link.is_absolute() ? link : path.parent_path() / link;
    }
    error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    return path;
}

std::filesystem::path temporary_name(const std::filesystem::path& target) {
    static std::atomic<unsigned> counter{0};
    constexpr std::size_t longest = 200;  // of the 255 bytes that file systems allow
    const std::string stem = target.filename().string().substr(0, longest);
    return target.parent_path() / fmt::format(".{}.{}-{}.tmp", stem, ::getpid(), counter++);
}

/// Names of temporary files, for a signal handler; more writes at once than this stay unknown to it.
constexpr std::size_t most_names = 64;
std::array<std::atomic<const char*>, most_names> unfinished{};

/// The place of the name, counted from 1; 0 if there was none left.
std::size_t publish(const char* name) {
    for (std::size_t i = 0; i < most_names; ++i) {
        const char* none = nullptr;
        if (unfinished[i].compare_exchange_strong(none, name)) return i + 1;
    }
    return 0;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path)
    : name_(printable(path.string())),
      target_(path),
      buffer_(new char[capacity]) {
    if (const int open_one = named_descriptor(path.string()); open_one >= 0) {
        descriptor_ = ::fcntl(open_one, F_DUPFD_CLOEXEC, 0);
        if (descriptor_ < 0) fail(errno);
        return;
    }
    struct stat status {};
    const bool exists = ::stat(path.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
    if (exists && !S_ISREG(status.st_mode)) {
        descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) fail(errno);
        return;
    }
    std::error_code error;
    target_ = follow_links(path, error);
    if (error) fail(error.value());
    open_beside(target_);
    if (exists) keep_permissions(target_);
}

void OutputFile::open_beside(const std::filesystem::path& target) {
    constexpr int attempts = 100;
    for (int i = 0; i < attempts; ++i) {
        temporary_ = temporary_name(target);
        place_ = publish(temporary_.c_str());
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ >= 0) return;
        const int error = errno;
        forget_temporary();
        if (error != EEXIST) fail(error);
    }
    fail(EEXIST);
}

void OutputFile::forget_temporary() {
    if (place_ > 0) unfinished[place_ - 1].store(nullptr);
    place_ = 0;
    temporary_.clear();
}

/// A file that may not be written must not be replaced either.
void OutputFile::keep_permissions(const std::filesystem::path& target) {
    struct stat status {};
    if (::access(target.c_str(), W_OK) == 0 && ::stat(target.c_str(), &status) == 0 &&
        ::fchmod(descriptor_, status.st_mode & 0777) == 0) {
        return;
    }
    const int error = errno;
    ::close(descriptor_);
    descriptor_ = -1;
    ::unlink(temporary_.c_str());
    forget_temporary();
    fail(error);
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    forget_temporary();
}

void OutputFile::text(std::string_view text) {
    while (!text.empty()) {
        const std::size_t n = std::min(text.size(), most_room);
        char* to = room(n);
        std::memcpy(to, text.data(), n);
        advance(to + n);
        text.remove_prefix(n);
    }
}

void OutputFile::flush() {
    const char* from = buffer_.get();
    while (used_ > 0) {
        const ssize_t n = ::write(descriptor_, from, used_);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) fail(n < 0 ? errno : ENOSPC);
        from += n;
        used_ -= static_cast<std::size_t>(n);
    }
}

void OutputFile::commit() {
    flush();
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail(errno);
    if (temporary_.empty()) return;
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    forget_temporary();
}

void OutputFile::fail(int error) const {
    throw Error(ErrorCode::file_not_writable, name_ + ": can not be written: " + std::strerror(error));
}

}  // namespace delmesh::io

void delmesh::remove_unfinished_files() noexcept {
    for (const auto& slot : io::unfinished) {
        if (const char* name = slot.load()) ::unlink(name);
    }
}
