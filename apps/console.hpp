#pragma once
// What all commands share: where output goes, progress, time, interruption.

#include "delmesh/base/context.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <stdexcept>
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
    /// The mesh goes to standard output, so that all words go to standard error.
    bool mesh_on_stdout = false;
};

/// "-" as a path.
[[nodiscard]] std::string input_path(const std::string& path);
[[nodiscard]] std::string output_path(const std::string& path);

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

/// Standard output could not be written.
class OutputLost : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A context that draws progress on a terminal, and what SIGINT and SIGTERM do: the process ends at once with 130 or
/// 143, with nothing half-written left behind. Only where the user wants what there is so far (`finish_early`), the
/// first signal cancels the context instead. One console at a time.
class Console {
public:
    explicit Console(const CommonOptions& options);
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    [[nodiscard]] const Context* context() const { return &context_; }
    /// From here on, the first signal cancels the context.
    void finish_early();
    /// The exit code of the signal that came, or 0.
    [[nodiscard]] int interrupted() const;
    [[nodiscard]] bool wants_json() const { return options_.json; }
    [[nodiscard]] bool is_quiet() const { return options_.quiet; }

    /// Throws `OutputLost` if what was printed did not arrive.
    void flush();
    /// The one JSON object of the command.
    void print(const Json& json);
    /// A line for people; nothing with --json or --quiet.
    void say(std::string_view text);
    /// A line for who waits at a terminal, before the command is done; nothing elsewhere and with --quiet.
    void note(std::string_view text);
    /// A line for people that is the point of the command: shown with --quiet too.
    void tell(std::string_view text);

private:
    void put(std::string_view text);
    void draw(std::string_view phase, double fraction);
    void clear_line();

    CommonOptions options_;
    Context context_;
    std::chrono::steady_clock::time_point drawn_{};
    bool terminal_ = false;
};

/// The most memory that the process has had, in bytes.
[[nodiscard]] std::size_t peak_memory_bytes();

/// Columns padded to their widest cell, the first to the left and the others to the right.
[[nodiscard]] std::string format_table(const std::vector<std::vector<std::string>>& rows);

/// 1234567 -> "1,234,567".
[[nodiscard]] std::string with_commas(std::size_t n);

}  // namespace delmesh::app
