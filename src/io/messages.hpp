#pragma once
// The words of error messages: one line, whatever the bytes of the file are.

#include "delmesh/base/error.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace delmesh::io {

/// The text with everything but printable ASCII and UTF-8 letters written as \xNN.
[[nodiscard]] std::string printable(std::string_view text);
/// The same in quotes, cut after 40 bytes.
[[nodiscard]] std::string quote(std::string_view text);

/// The sentence, and where it tells of damage that nobody mends by hand, what to do.
[[nodiscard]] std::string with_advice(std::string sentence, ErrorCode code);

}  // namespace delmesh::io
