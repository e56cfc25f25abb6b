#pragma once
// How every command gets its mesh: read, mended where that is asked for, built.

#include "console.hpp"
#include "delmesh/base/error.hpp"
#include "delmesh/io/read.hpp"
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

/// What was wrong with a file, and with the mesh in it.
struct Mended {
    FileDamage damage;
    RepairReport report;

    [[nodiscard]] bool changed() const { return damage.count > 0 || report.changed; }
};

/// Reads a file as far as it can be read and makes a manifold of it. Throws `Error` (no_surface) if it has no faces
/// then, and says what became of them.
[[nodiscard]] PolygonSoup load_and_mend(const std::string& path, const RepairOptions& options,
                                        std::optional<Precision> rounding, const Console& console, Mended& mended);

/// Reads a file, which must hold faces. With --repair it becomes a manifold, and what was wrong is told on standard
/// error.
[[nodiscard]] PolygonSoup load_soup(const std::string& path, const InputOptions& options, const Console& console,
                                    std::optional<Mended>* mended = nullptr);

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

[[nodiscard]] Json to_json(const Mended& mended);

/// A line for each place that could not be read and for each kind of defect.
[[nodiscard]] std::string findings_text(const std::string& path, const Mended& mended);

}  // namespace delmesh::app
