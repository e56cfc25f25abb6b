#pragma once
// One function for each command: it declares arguments and sets what is to be run.

#include "console.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace delmesh::app {

/// What the command line asked for.
struct Action {
    CommonOptions common;
    /// Returns an exit code; may throw `Error`.
    std::function<int(Console&)> run;
};

void add_check_command(CLI::App& app, Action& action);
void add_lod_command(CLI::App& app, Action& action);
void add_remesh_command(CLI::App& app, Action& action);
void add_repair_command(CLI::App& app, Action& action);
void add_distance_command(CLI::App& app, Action& action);
void add_sample_command(CLI::App& app, Action& action);
void add_simplify_command(CLI::App& app, Action& action);
void add_stats_command(CLI::App& app, Action& action);

/// A command with the switches that all share; `example` ends its help.
CLI::App* add_command(CLI::App& app, Action& action, const std::string& name, const std::string& description,
                      const std::string& example);

}  // namespace delmesh::app
