// The delmesh command: reads arguments, runs one command, turns errors into a sentence and an exit code.

#include "commands.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/io/write.hpp"
#include "exit_code.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <stdexcept>
#include <typeinfo>

namespace delmesh::app {

CLI::App* add_command(CLI::App& app, Action& action, const std::string& name, const std::string& description,
                      const std::string& example) {
    CLI::App* command = app.add_subcommand(name, description);
    command->footer("Example:\n  " + example);
    command->add_flag("--json", action.common.json, "Print one JSON object on standard output, and nothing else there");
    command->add_flag("--quiet", action.common.quiet, "Print nothing but errors and what was asked for");
    command->add_option("--threads", action.common.threads, "Threads to use; 0: all. Results never depend on it")
        ->type_name("N")
        ->check(CLI::Range(0, 1024));
    return command;
}

namespace {

int fail(const CommonOptions& common, std::string_view code, const std::string& message, int exit_code) {
    // Where these can not be written either, the exit code is left to tell.
    std::fputs(("delmesh: " + message + "\n").c_str(), stderr);
    if (common.json) {
        const Json json{{"error", {{"code", code}, {"message", message}}}};
        const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
        std::fputs(text.c_str(), common.mesh_on_stdout ? stderr : stdout);
    }
    return exit_code;
}

/// What is opened later must not become the standard output that a caller has closed: words would go into a mesh.
void occupy_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) >= 0) continue;
        // The lowest free number is taken, and the other way round: to use it stays an error.
        if (::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) != stream) return;
    }
}

/// Large blocks go back to the system when they are freed. By itself the allocator would keep them, in pieces, once the
/// first large one has been freed.
void give_back_memory() {
#ifdef M_MMAP_THRESHOLD
    ::mallopt(M_MMAP_THRESHOLD, 256 * 1024);
#endif
}

constexpr const char* out_of_memory = "there is not enough memory for this mesh";

/// Memory may lack on several threads at once: one of them says so and ends the process, the others wait for that.
void be_the_one_that_says_so() {
    static std::atomic_flag said = ATOMIC_FLAG_INIT;
    if (!said.test_and_set()) return;
    ::sleep(5);
    ::_exit(exit_input);
}

/// Where memory for a thread is lacking, TBB throws on another thread, and nobody can catch it.
[[noreturn]] void end_for_want_of_memory() {
    try {
        if (const std::exception_ptr what = std::current_exception()) std::rethrow_exception(what);
    } catch (const std::exception& error) {
        const bool lacks_memory =
            typeid(error) == typeid(std::runtime_error) || dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
        if (lacks_memory) {
            be_the_one_that_says_so();
            remove_unfinished_files();
            std::fprintf(stderr, "delmesh: %s\n", out_of_memory);
            ::_exit(exit_input);
        }
    }
    std::abort();
}

int run(const Action& action) {
    try {
        Console console(action.common);
        const int exit_code = action.run(console);
        console.flush();
        const int interrupted = console.interrupted();
        return interrupted != 0 ? interrupted : exit_code;
    } catch (const Error& error) {
        return fail(action.common, name(error.code()), error.what(), exit_code_of(error.code()));
    } catch (const OutputLost& error) {
        return fail(action.common, "file_not_writable", error.what(), exit_output);
    } catch (const std::bad_alloc&) {
        be_the_one_that_says_so();
        return fail(action.common, "out_of_memory", out_of_memory, exit_input);
    } catch (const std::length_error&) {  // a container that no memory could hold
        be_the_one_that_says_so();
        return fail(action.common, "out_of_memory", out_of_memory, exit_input);
    }
}

}  // namespace
}  // namespace delmesh::app

int main(int argc, char** argv) {
    using namespace delmesh::app;
    occupy_closed_streams();
    give_back_memory();
    std::set_terminate(end_for_want_of_memory);
    CLI::App app("Turns any triangle mesh into a Delaunay mesh, and proves that it is one.", "delmesh");
    app.require_subcommand(1);
    app.set_version_flag("--version", DELMESH_VERSION);
    app.footer("`delmesh COMMAND --help` tells more about a command.");
    Action action;
    add_remesh_command(app, action);
    add_simplify_command(app, action);
    add_check_command(app, action);
    add_stats_command(app, action);
    add_lod_command(app, action);
    add_distance_command(app, action);
    add_repair_command(app, action);
    add_sample_command(app, action);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_done : exit_usage;
    }
    return run(action);
}
