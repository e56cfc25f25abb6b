#include "output_options.hpp"

#include "delmesh/base/error.hpp"

#include <fmt/format.h>

namespace delmesh::app {

void OutputOptions::bind(CLI::App& command) {
    command.add_option("--format", format, "Of the output, whatever its name")
        ->type_name("ply|obj|off|stl")
        ->check(CLI::IsMember({"ply", "obj", "off", "stl"}));
    command.add_option("--precision", precision_name, "Of the coordinates in the output; STL always holds floats")
        ->type_name("double|float")
        ->capture_default_str()
        ->check(CLI::IsMember({"double", "float"}));
    command.add_flag("--ascii", ascii, "Write PLY and STL as text");
}

WriteOptions OutputOptions::write_options() const {
    WriteOptions options;
    options.format = format.empty() ? format_from_path(path) : format_from_name(format);
    if (!options.format)
        throw Error(ErrorCode::bad_argument,
                    is_stdout()
                        ? std::string("standard output has no name that tells a format: give --format")
                        : fmt::format("{}: the name does not tell a format; end it in .ply, .obj, .off or .stl, or "
                                      "give --format",
                                      path));
    if (!can_write(*options.format))
        throw Error(ErrorCode::bad_argument,
                    fmt::format("{}: {} is read but not written; end the name in .ply, .obj, .off or .stl, or give "
                                "--format",
                                path, name(*options.format)));
    options.precision = precision_name == "float" ? Precision::float32 : Precision::float64;
    options.ascii = ascii;
    return options;
}

Precision OutputOptions::precision() const {
    const WriteOptions options = write_options();
    return stored_precision(*options.format, options);
}

}  // namespace delmesh::app
