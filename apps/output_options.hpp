#pragma once
// What the commands that write a mesh ask about the file.

#include "delmesh/io/write.hpp"

#include <CLI/CLI.hpp>

#include <string>

namespace delmesh::app {

struct OutputOptions {
    std::string path;
    std::string format;
    std::string precision_name = "double";
    bool ascii = false;

    /// Adds --format, --precision and --ascii.
    void bind(CLI::App& command);
    [[nodiscard]] bool is_stdout() const { return path == "-"; }
    /// Throws `Error` (unsupported_format, bad_argument) if the file can not be written like that.
    [[nodiscard]] WriteOptions write_options() const;
    /// Of the coordinates in the file.
    [[nodiscard]] Precision precision() const;
};

}  // namespace delmesh::app
