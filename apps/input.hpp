#pragma once
// How every command gets its mesh: read, mended where that is asked for, built.

#include "console.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/mesh/mesh.hpp"
#include "delmesh/repair/repair.hpp"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace delmesh::app {

/// True for codes that say what is wrong with a mesh, whatever file it is from.
[[nodiscard]] bool is_about_mesh(ErrorCode code);

struct InputOptions {
    bool repair = false;
    RepairOptions repair_options;

    /// Adds --repair and what belongs to it.
    void bind(CLI::App& command);
};

/// Reads a file. With --repair it becomes a manifold, and what was wrong is told on standard error.
[[nodiscard]] PolygonSoup load_soup(const std::string& path, const InputOptions& options, const Console& console,
                                    std::optional<RepairReport>* report = nullptr);

/// Calls, and puts the file's name in front of what an error says about the mesh.
template <class Call>
auto naming(const std::string& path, Call&& call) {
    try {
        return call();
    } catch (const Error& error) {
        if (!is_about_mesh(error.code())) throw;
        throw Error(error.code(), path + ": " + error.what(), error.elements(), error.count());
    }
}

/// Builds the mesh; errors name the file.
[[nodiscard]] Mesh build_mesh(const std::string& path, PolygonSoup soup);

[[nodiscard]] Json to_json(const RepairReport& report);

/// A line for each kind of defect.
[[nodiscard]] std::string findings_text(const RepairReport& report);

}  // namespace delmesh::app
