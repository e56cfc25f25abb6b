#pragma once
// What all commands share: where output goes, progress, time, interruption.

#include "delmesh/base/context.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace delmesh::app {

using Json = nlohmann::ordered_json;

/// The switches that every command takes.
struct CommonOptions {
    bool json = false;
    bool quiet = false;
    int threads = 0;
};

/// Seconds of named phases, in the order in which they ran.
class Stopwatch {
public:
    /// Ends the phase that began with the last call (or with the construction).
    void lap(const std::string& phase);
    [[nodiscard]] Json seconds() const;

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_ = Clock::now();
    Clock::time_point last_ = begin_;
    std::vector<std::pair<std::string, double>> laps_;
};

/// A context that draws progress on a terminal and is cancelled by SIGINT and SIGTERM. One at a time.
class Console {
public:
    explicit Console(const CommonOptions& options);
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    [[nodiscard]] const Context* context() const { return &context_; }
    /// The exit code of the signal that came, or 0.
    [[nodiscard]] int interrupted() const;
    [[nodiscard]] bool wants_json() const { return options_.json; }
    [[nodiscard]] bool is_quiet() const { return options_.quiet; }

    /// The one JSON object of the command.
    void print(const Json& json);
    /// A line for people; nothing with --json or --quiet.
    void say(std::string_view text);
    /// A line for people that is the point of the command: shown with --quiet too.
    void tell(std::string_view text);

private:
    void draw(std::string_view phase, double fraction);
    void clear_line();

    CommonOptions options_;
    Context context_;
    std::chrono::steady_clock::time_point drawn_{};
    bool terminal_ = false;
    bool line_open_ = false;
};

/// The most memory that the process has had, in bytes.
[[nodiscard]] std::size_t peak_memory_bytes();

/// Columns padded to their widest cell, the first to the left and the others to the right.
[[nodiscard]] std::string format_table(const std::vector<std::vector<std::string>>& rows);

/// 1234567 -> "1,234,567".
[[nodiscard]] std::string with_commas(std::size_t n);

}  // namespace delmesh::app
