#include "console.hpp"

#include "exit_code.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>

namespace delmesh::app {
namespace {

std::atomic<Context*> running{nullptr};
std::atomic<int> signal_seen{0};

extern "C" void on_signal(int signal) {
    signal_seen.store(signal, std::memory_order_relaxed);
    if (Context* context = running.load(std::memory_order_relaxed)) context->cancel();
}

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    // A second signal ends the process at once.
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

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
    running.store(&context_);
    catch_signals();
}

Console::~Console() {
    running.store(nullptr);
    clear_line();
}

int Console::interrupted() const {
    switch (signal_seen.load()) {
        case SIGINT:
            return exit_interrupted;
        case SIGTERM:
            return exit_terminated;
        default:
            return 0;
    }
}

void Console::draw(std::string_view phase, double fraction) {
    if (!terminal_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    line_open_ = true;
    fmt::print(stderr, "\r\033[K{} {:3.0f} %", phase, 100 * std::clamp(fraction, 0.0, 1.0));
    std::fflush(stderr);
}

void Console::clear_line() {
    if (!line_open_) return;
    line_open_ = false;
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
}

void Console::print(const Json& json) {
    clear_line();
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

void Console::say(std::string_view text) {
    if (!options_.quiet) tell(text);
}

void Console::tell(std::string_view text) {
    if (options_.json) return;
    clear_line();
    fmt::print("{}\n", text);
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
