// Ctrl-C and SIGTERM: 130 and 143, no partial file, a clean terminal.

#include "apps/running.hpp"

#include <fcntl.h>
#include <pty.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

namespace delmesh {
namespace {

using Names = std::vector<std::string>;

class Interruption : public test::Running {
protected:
    /// Starts the program with standard input from a pipe whose other end is `feed_`.
    pid_t start(const Names& arguments) {
        int ends[2];
        EXPECT_EQ(::pipe2(ends, O_CLOEXEC), 0);
        const pid_t child = ::fork();
        if (child == 0) {
            ::dup2(ends[0], STDIN_FILENO);
            ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
            run(arguments);
        }
        ::close(ends[0]);
        feed_ = ends[1];
        return child;
    }

    [[noreturn]] void run(const Names& arguments) const {
        std::vector<char*> words{const_cast<char*>("delmesh")};
        for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
        words.push_back(nullptr);
        if (::chdir(folder().c_str()) == 0) ::execv(DELMESH_PROGRAM, words.data());
        ::_exit(99);
    }

    /// Returns when the program has taken all but the last 64 KiB, so that it is known to be at work.
    void feed(const std::string& bytes) const {
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t n = ::write(feed_, bytes.data() + done, bytes.size() - done);
            ASSERT_GT(n, 0);
            done += static_cast<std::size_t>(n);
        }
    }

    static int exit_code_of(pid_t child) {
        int status = 0;
        EXPECT_EQ(::waitpid(child, &status, 0), child);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

    int feed_ = -1;
};

const std::string million_points = [] {
    std::string text;
    for (int i = 0; i < 100'000; ++i) text += "v 0 0 0\n";
    return text;
}();

TEST_F(Interruption, WhileReadingEndsAtOnce) {
    for (const auto& [signal, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143)}) {
        const pid_t child = start({"remesh", "-", "out.ply"});
        feed(million_points);
        ::kill(child, signal);
        EXPECT_EQ(exit_code_of(child), code);
        ::close(feed_);
    }
    EXPECT_EQ(files(), Names{});
}

TEST_F(Interruption, IsIgnoredWhereTheCallerSaysSo) {
    std::signal(SIGINT, SIG_IGN);
    const pid_t child = start({"check", "-"});
    std::signal(SIGINT, SIG_DFL);
    feed(million_points);
    ::kill(child, SIGINT);
    feed(million_points);
    ::close(feed_);
    EXPECT_EQ(exit_code_of(child), 3);  // read to the end: points only
}

/// An uneven tube, a million times as long as wide: preserve mode would add points for minutes.
std::string needles() {
    constexpr int n = 24;
    constexpr double pi = 3.14159265358979;
    std::string text;
    for (int x = 0; x <= n; ++x) {
        for (int k = 0; k < n; ++k) {
            const double along = pi * (x + 1) / (n + 2) + 0.03 * ((x * 7 + k * 13) % 11) / 11;
            const double around = 2 * pi * (k + 0.5 * (x % 2)) / n + 0.05 * ((x * 5 + k * 3) % 7) / 7;
            text += "v " + std::to_string(1e6 * std::cos(along)) + " " +
                    std::to_string(std::sin(along) * std::cos(around)) + " " +
                    std::to_string(std::sin(along) * std::sin(around)) + "\n";
        }
    }
    const auto vertex = [](int x, int k) { return std::to_string(x * n + k % n + 1) + " "; };
    for (int x = 0; x < n; ++x) {
        for (int k = 0; k < n; ++k) {
            text += "f " + vertex(x, k) + vertex(x + 1, k) + vertex(x + 1, k + 1) + "\n";
            text += "f " + vertex(x, k) + vertex(x + 1, k + 1) + vertex(x, k + 1) + "\n";
        }
    }
    return text;
}

TEST_F(Interruption, WhileRemeshingLeavesNoFileOrThePartAskedFor) {
    const std::string mesh = needles();
    for (const bool keep : {false, true}) {
        Names arguments{"remesh", "-", "out.ply", "--quiet", "--max-vertices", "100000000"};
        if (keep) arguments.push_back("--keep-partial");
        const pid_t child = start(arguments);
        feed(mesh);
        ::close(feed_);
        std::this_thread::sleep_for(std::chrono::milliseconds(700));
        ::kill(child, SIGTERM);
        EXPECT_EQ(exit_code_of(child), 143);
        EXPECT_EQ(files(), keep ? Names{"out.ply"} : Names{});
    }
    EXPECT_EQ(delmesh("check out.ply --quiet").exit_code, 1);
}

/// Progress is drawn on a terminal; Ctrl-C there ends the program and wipes the line.
TEST_F(Interruption, CtrlCLeavesACleanTerminal) {
    write("a.obj", needles());
    int terminal = -1;
    const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child == 0) run({"remesh", "a.obj", "out.ply", "--max-vertices", "100000000"});
    // Else the terminal throws away what is written right after the key.
    termios settings{};
    ASSERT_EQ(::tcgetattr(terminal, &settings), 0);
    settings.c_lflag |= NOFLSH;
    ASSERT_EQ(::tcsetattr(terminal, TCSANOW, &settings), 0);
    std::string seen;
    bool pressed = false;
    char buffer[4096];
    for (;;) {
        const ssize_t n = ::read(terminal, buffer, sizeof buffer);
        if (n <= 0) break;  // Linux says EIO when the other side is gone
        seen.append(buffer, static_cast<std::size_t>(n));
        if (!pressed && seen.find(" %") != std::string::npos) pressed = ::write(terminal, "\x03", 1) == 1;
    }
    ::close(terminal);
    EXPECT_EQ(exit_code_of(child), 130);
    EXPECT_TRUE(pressed);
    // The last that was drawn is wiped; the key may have come when a message had already wiped it.
    EXPECT_NE(seen.find("\r\033[K", seen.rfind(" %")), seen.npos) << testing::PrintToString(seen);
    EXPECT_EQ(files(), Names{"a.obj"});
}

}  // namespace
}  // namespace delmesh
