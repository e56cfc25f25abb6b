#include "apps/running.hpp"

#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace delmesh::test {

namespace {

std::string read_all(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

std::filesystem::path new_folder(const std::string& what) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() /
        ("delmesh-" + what + "-" + test->test_suite_name() + "." + test->name() + "." + std::to_string(::getpid()));
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
    return path;
}

}  // namespace

nlohmann::json Ran::json() const {
    nlohmann::json value = nlohmann::json::parse(out, nullptr, false);
    EXPECT_TRUE(value.is_object()) << out << err;
    return value.is_object() ? value : nlohmann::json::object();
}

testing::AssertionResult Ran::tells_one_sentence() const {
    const bool one_line = std::ranges::count(err, '\n') == 1 && err.ends_with('\n');
    if (one_line && err.starts_with("delmesh: ")) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "standard error is:\n" << err;
}

Running::Running() : folder_(new_folder("run")), logs_(new_folder("log")) {}

Running::~Running() {
    std::error_code ignored;  // a folder that is left behind does not make a test wrong
    std::filesystem::remove_all(folder_, ignored);
    std::filesystem::remove_all(logs_, ignored);
}

Ran Running::shell(const std::string& line) const {
    const std::string out = (logs_ / "out").string();
    const std::string err = (logs_ / "err").string();
    const std::string script = "cd '" + folder_.string() + "'\ndelmesh() { '" DELMESH_PROGRAM "' \"$@\"; }\n{ " + line +
                               "\n} >'" + out + "' 2>'" + err + "'\n";
    const int status = std::system(script.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_all(out), read_all(err)};
}

std::vector<std::string> Running::files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
}

std::string Running::bytes(const std::string& name) const {
    return read_all(folder_ / name);
}

void Running::write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
}

}  // namespace delmesh::test
