#include "console.hpp"

#include "delmesh/io/write.hpp"
#include "exit_code.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

namespace delmesh::app {
namespace {

// What the signal handler knows.
std::atomic<Context*> to_cancel{nullptr};
std::atomic<int> signal_seen{0};
std::atomic<bool> line_open{false};

constexpr std::string_view erase_line = "\r\033[K";

int exit_code_of_signal(int signal) {
    return signal == SIGTERM ? exit_terminated : exit_interrupted;
}

[[noreturn]] void fail_stdout() {
    throw OutputLost(std::string("standard output: can not be written: ") + std::strerror(errno));
}

extern "C" void on_signal(int signal) {
    Context* const context = to_cancel.load();
    if (context != nullptr && signal_seen.exchange(signal) == 0) {
        context->cancel();
        return;
    }
    remove_unfinished_files();
    if (line_open.load()) {
        [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, erase_line.data(), erase_line.size());
    }
    ::_exit(exit_code_of_signal(signal));
}

void catch_signal(int signal) {
    struct sigaction action {};
    // Who starts a process in the background may have told it to ignore the keyboard.
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) return;
    action = {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    sigaddset(&action.sa_mask, SIGINT);
    sigaddset(&action.sa_mask, SIGTERM);
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
}

}  // namespace

std::string input_path(const std::string& path) {
    return path == "-" ? "/dev/stdin" : path;
}

std::string output_path(const std::string& path) {
    return path == "-" ? "/dev/stdout" : path;
}

void Stopwatch::lap(const std::string& phase) {
    const Clock::time_point now = Clock::now();
    laps_.emplace_back(phase, std::chrono::duration<double>(now - last_).count());
    last_ = now;
}

Json Stopwatch::seconds() const {
    Json json;
    for (const auto& [phase, seconds] : laps_) json[phase] = seconds;
    json["total"] = std::chrono::duration<double>(last_ - begin_).count();
    return json;
}

Console::Console(const CommonOptions& options)
    : options_(options),
      context_([this](std::string_view phase, double fraction) { draw(phase, fraction); }, options.threads),
      terminal_(isatty(STDERR_FILENO) == 1 && !options.quiet) {
    catch_signal(SIGINT);
    catch_signal(SIGTERM);
    // A reader that goes away and a limit on the size of files are errors of writing.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

Console::~Console() {
    to_cancel.store(nullptr);
    clear_line();
}

void Console::finish_early() {
    to_cancel.store(&context_);
}

int Console::interrupted() const {
    const int signal = signal_seen.load();
    return signal == 0 ? 0 : exit_code_of_signal(signal);
}

void Console::draw(std::string_view phase, double fraction) {
    if (!terminal_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    line_open.store(true);
    fmt::print(stderr, "{}{} {:3.0f} %", erase_line, phase, 100 * std::clamp(fraction, 0.0, 1.0));
    std::fflush(stderr);
}

void Console::clear_line() {
    if (!line_open.exchange(false)) return;
    fmt::print(stderr, "{}", erase_line);
    std::fflush(stderr);
}

void Console::put(std::string_view text) {
    clear_line();
    FILE* const to = options_.mesh_on_stdout ? stderr : stdout;
    const bool done = std::fwrite(text.data(), 1, text.size(), to) == text.size() && std::fputc('\n', to) != EOF;
    if (!done && to == stdout) fail_stdout();
}

void Console::flush() {
    if (std::fflush(stdout) != 0) fail_stdout();
}

void Console::print(const Json& json) {
    put(json.dump(2, ' ', false, Json::error_handler_t::replace));
}

void Console::note(std::string_view text) {
    if (!terminal_) return;
    clear_line();
    fmt::print(stderr, "delmesh: {}\n", text);
}

void Console::say(std::string_view text) {
    if (!options_.quiet) tell(text);
}

void Console::tell(std::string_view text) {
    if (!options_.json) put(text);
}

std::size_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    return static_cast<std::size_t>(usage.ru_maxrss);
#else
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
#endif
}

std::string format_table(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths;
    for (const auto& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const auto& row : rows) {
        if (!text.empty()) text += '\n';
        for (std::size_t i = 0; i < row.size(); ++i)
            text += i == 0 ? fmt::format("{:<{}}", row[i], widths[i]) : fmt::format("  {:>{}}", row[i], widths[i]);
    }
    return text;
}

std::string with_commas(std::size_t n) {
    const std::string digits = std::to_string(n);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
        text += digits[i];
    }
    return text;
}

}  // namespace delmesh::app
