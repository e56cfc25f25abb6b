#include "io/output_file.hpp"

#include "io/io_support.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <thread>

namespace delmesh::io {
namespace {

std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    return names;
}

mode_t mode_of(const std::filesystem::path& path) {
    struct stat status {};
    ::stat(path.c_str(), &status);
    return status.st_mode & 0777;
}

void write_text(const std::filesystem::path& path, std::string_view text) {
    OutputFile file(path);
    file.text(text);
    file.commit();
}

TEST(OutputFile, AppearsWhole) {
    const test::TestFolder folder;
    const std::string text(1'000'000, 'x');
    {
        OutputFile file(folder / "a");
        file.text(text);
        EXPECT_FALSE(std::filesystem::exists(folder / "a"));
        file.commit();
    }
    EXPECT_EQ(test::read_bytes(folder / "a"), text);
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a"});
}

TEST(OutputFile, OrNotAtAll) {
    const test::TestFolder folder;
    test::write_bytes(folder / "a", "old");
    {
        OutputFile file(folder / "a");
        file.text(std::string(1'000'000, 'x'));
    }
    EXPECT_EQ(test::read_bytes(folder / "a"), "old");
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a"});
}

TEST(OutputFile, PermissionsStay) {
    const test::TestFolder folder;
    const mode_t mask = ::umask(027);
    write_text(folder / "new", "x");
    ::umask(mask);
    EXPECT_EQ(mode_of(folder / "new"), 0640u);
    ::chmod((folder / "new").c_str(), 0604);
    write_text(folder / "new", "y");
    EXPECT_EQ(mode_of(folder / "new"), 0604u);
    EXPECT_EQ(test::read_bytes(folder / "new"), "y");
}

TEST(OutputFile, SymbolicLinksStay) {
    const test::TestFolder folder;
    std::filesystem::create_directory(folder / "sub");
    test::write_bytes(folder / "sub/real", "old");
    std::filesystem::create_symlink("sub/real", folder / "link");
    std::filesystem::create_symlink("link", folder / "second");
    std::filesystem::create_symlink("sub/none", folder / "dangling");
    std::filesystem::create_symlink("loop", folder / "loop");
    write_text(folder / "second", "new");
    write_text(folder / "dangling", "made");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "second"));
    EXPECT_EQ(test::read_bytes(folder / "sub/real"), "new");
    EXPECT_EQ(test::read_bytes(folder / "sub/none"), "made");
    test::expect_error([&] { write_text(folder / "loop", "x"); }, ErrorCode::file_not_writable, "symbolic links");
}

TEST(OutputFile, WhatIsNoRegularFileIsWrittenDirectly) {
    const test::TestFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::string received;
    std::thread reader([&] { received = test::read_bytes(folder / "pipe"); });
    write_text(folder / "pipe", "through");
    reader.join();
    EXPECT_EQ(received, "through");
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"pipe"});
    write_text("/dev/null", "gone");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(OutputFile, DescriptorsByNameGoOnWhereTheyAre) {
    const test::TestFolder folder;
    test::write_bytes(folder / "log", "before ");
    const int descriptor = ::open((folder / "log").c_str(), O_WRONLY | O_APPEND);
    ASSERT_GE(descriptor, 0);
    write_text("/dev/fd/" + std::to_string(descriptor), "behind");
    ::close(descriptor);
    EXPECT_EQ(test::read_bytes(folder / "log"), "before behind");
}

TEST(OutputFile, FailuresSayWhy) {
    const test::TestFolder folder;
    constexpr ErrorCode code = ErrorCode::file_not_writable;
    test::expect_error([&] { write_text(folder / "none/a", "x"); }, code,
                       "none/a: can not be written: No such file or directory");
    test::expect_error([&] { write_text(folder.path(), "x"); }, code, "Is a directory");
    test::expect_error([&] { write_text("/dev/fd/987654", "x"); }, code, "Bad file descriptor");
    test::expect_error([&] { write_text("", "x"); }, code, "No such file or directory");
    if (std::filesystem::exists("/dev/full")) {
        test::expect_error([&] { write_text("/dev/full", "x"); }, code,
                           "/dev/full: can not be written: No space left on device");
    }
    EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(OutputFile, ReadOnlyFilesAreNotReplaced) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
    const test::TestFolder folder;
    test::write_bytes(folder / "a", "old");
    ::chmod((folder / "a").c_str(), 0444);
    test::expect_error([&] { write_text(folder / "a", "x"); }, ErrorCode::file_not_writable, "Permission denied");
    EXPECT_EQ(test::read_bytes(folder / "a"), "old");
    EXPECT_EQ(names_in(folder.path()).size(), 1u);
}

TEST(OutputFile, ADiskThatFillsUpLeavesTheOldFile) {
    // A limit on the size of files makes write(2) fail in the middle, as a full disk does.
    const test::TestFolder folder;
    test::write_bytes(folder / "a", "old");
    rlimit old{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{300'000, old.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto error = test::error_of([&] { write_text(folder / "a", std::string(1'000'000, 'x')); });
    ::setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, handler);
    ASSERT_TRUE(error);
    EXPECT_NE(std::string(error->what()).find("File too large"), std::string::npos) << error->what();
    EXPECT_EQ(test::read_bytes(folder / "a"), "old");
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a"});
}

TEST(OutputFile, UnfinishedFilesAreKnownToSignalHandlers) {
    const test::TestFolder folder;
    test::write_bytes(folder / "a", "old");
    write_text(folder / "b", "whole");
    {
        OutputFile first(folder / "a");
        OutputFile second(folder / "c");
        EXPECT_EQ(names_in(folder.path()).size(), 4u);
        remove_unfinished_files();
        std::vector<std::string> names = names_in(folder.path());
        std::ranges::sort(names);
        EXPECT_EQ(names, (std::vector<std::string>{"a", "b"}));
        EXPECT_THROW(second.commit(), Error);
    }
    EXPECT_EQ(test::read_bytes(folder / "a"), "old");
}

TEST(OutputFile, TwoWritersLeaveOneWholeFile) {
    const test::TestFolder folder;
    OutputFile first(folder / "a");
    OutputFile second(folder / "a");
    first.text(std::string(500'000, '1'));
    second.text(std::string(500'000, '2'));
    second.commit();
    first.commit();
    EXPECT_EQ(test::read_bytes(folder / "a"), std::string(500'000, '1'));
    EXPECT_EQ(names_in(folder.path()).size(), 1u);
}

}  // namespace
}  // namespace delmesh::io
