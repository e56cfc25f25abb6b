#pragma once
// Runs the delmesh program in a folder of its own.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace delmesh::test {

struct Ran {
    int exit_code = -1;  ///< -1: ended by a signal
    std::string out;
    std::string err;

    /// Standard output as one JSON object; a failure if it is anything else.
    [[nodiscard]] nlohmann::json json() const;
    /// One line on standard error that begins with the program's name.
    [[nodiscard]] testing::AssertionResult tells_one_sentence() const;
};

class Running : public testing::Test {
protected:
    Running();
    ~Running() override;

    /// Runs a line of the shell in the folder, where `delmesh` is the program. What follows it (a pipe, say) decides
    /// the exit code as in any shell.
    Ran shell(const std::string& line) const;
    Ran delmesh(const std::string& arguments) const { return shell("delmesh " + arguments); }

    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    /// The names in the folder, sorted.
    [[nodiscard]] std::vector<std::string> files() const;
    [[nodiscard]] std::string bytes(const std::string& name) const;
    void write(const std::string& name, const std::string& bytes) const;

private:
    std::filesystem::path folder_;
    std::filesystem::path logs_;
};

}  // namespace delmesh::test
