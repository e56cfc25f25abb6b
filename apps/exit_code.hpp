#pragma once

#include "delmesh/base/error.hpp"

namespace delmesh::app {

/// The exit codes that scripts rely on (docs/cli.md).
enum ExitCode : int {
    exit_done = 0,
    exit_does_not_hold = 1,  ///< the property asked about does not hold
    exit_usage = 2,
    exit_input = 3,    ///< the input can not be read or is not what the command needs
    exit_output = 4,   ///< the output can not be written
    exit_stopped = 5,  ///< stopped short; valid output is written with --keep-partial
    exit_interrupted = 130,
    exit_terminated = 143,
};

[[nodiscard]] inline ExitCode exit_code_of(ErrorCode code) {
    switch (code) {
        case ErrorCode::bad_argument:
            return exit_usage;
        case ErrorCode::file_not_writable:
            return exit_output;
        default:
            return exit_input;
    }
}

}  // namespace delmesh::app
