#pragma once
// Soups, files and errors for the tests of readers and writers.

#include "delmesh/base/error.hpp"
#include "delmesh/io/read.hpp"
#include "delmesh/io/write.hpp"
#include "io/readers.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace delmesh::test {

/// A folder of its own for each test, gone at the end.
class TestFolder {
public:
    TestFolder() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string(test->test_suite_name()) + "." + test->name() + "." + std::to_string(::getpid());
        for (char& c : name) c = c == '/' ? '-' : c;
        path_ = std::filesystem::temp_directory_path() / ("delmesh-" + name);
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;
    ~TestFolder() {
        std::error_code ignored;  // a folder that is left behind does not make a test wrong
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

inline std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
}

inline void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// Six times the enclosed volume of triangles, which tells of places, sizes and orientation.
inline double volume6(const PolygonSoup& soup) {
    double sum = 0;
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        const auto face = soup.face(f);
        sum += dot(soup.points[face[0]], cross(soup.points[face[1]], soup.points[face[2]]));
    }
    return sum;
}

inline PolygonSoup parse(std::string_view bytes, std::string_view name, const ReadOptions& options = {}) {
    return parse_soup(std::as_bytes(std::span(bytes)), name, options);
}

/// Gives a few bytes at a time and does not say how many there are, like a slow pipe.
class DripSource final : public io::ByteSource {
public:
    DripSource(std::string_view bytes, std::size_t step, bool says_size = false)
        : bytes_(bytes),
          step_(step),
          size_(bytes.size()),
          says_size_(says_size) {}
    std::size_t read(char* to, std::size_t capacity) override {
        const std::size_t n = std::min({step_, capacity, bytes_.size()});
        bytes_.copy(to, n);
        bytes_.remove_prefix(n);
        return n;
    }
    [[nodiscard]] std::optional<std::uint64_t> size() const override {
        return says_size_ ? std::optional<std::uint64_t>(size_) : std::nullopt;
    }

private:
    std::string_view bytes_;
    std::size_t step_;
    std::size_t size_;
    bool says_size_;
};

inline PolygonSoup parse_dripping(std::string_view bytes, std::string_view name, std::size_t step, std::size_t window,
                                  bool says_size = false) {
    DripSource source(bytes, step, says_size);
    io::Input input(source, name, window);
    return io::read_input(input, format_from_path(std::string(name)), {});
}

/// Coordinates, corners, faces and lines are equal, bit for bit.
inline testing::AssertionResult same_soup(const PolygonSoup& a, const PolygonSoup& b) {
    if (a.points.size() != b.points.size()) {
        return testing::AssertionFailure() << a.points.size() << " and " << b.points.size() << " points";
    }
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        for (const int axis : {0, 1, 2}) {
            if (std::bit_cast<std::uint64_t>(a.points[i][axis]) != std::bit_cast<std::uint64_t>(b.points[i][axis])) {
                return testing::AssertionFailure() << "coordinate " << axis << " of point " << i << " is "
                                                   << a.points[i][axis] << " and " << b.points[i][axis];
            }
        }
    }
    if (a.corners != b.corners) return testing::AssertionFailure() << "the corners differ";
    if (a.starts != b.starts) return testing::AssertionFailure() << "the faces differ";
    if (a.lines != b.lines) return testing::AssertionFailure() << "the lines differ";
    return testing::AssertionSuccess();
}

/// The error that a call throws; a test failure if it throws none.
template <class Call>
std::optional<Error> error_of(Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "no error was thrown";
    return std::nullopt;
}

/// The call must throw an `Error` of this code whose message holds the text, on one line.
template <class Call>
void expect_error(Call&& call, ErrorCode code, const std::string& text) {
    const std::optional<Error> error = error_of(call);
    if (!error) return;
    EXPECT_EQ(error->code(), code) << error->what();
    EXPECT_NE(std::string(error->what()).find(text), std::string::npos) << error->what();
    EXPECT_EQ(std::string(error->what()).find('\n'), std::string::npos) << error->what();
}

inline void expect_parse_error(std::string_view bytes, std::string_view name, const std::string& text,
                               ErrorCode code = ErrorCode::file_format) {
    expect_error([&] { (void)parse(bytes, name); }, code, text);
}

}  // namespace delmesh::test
