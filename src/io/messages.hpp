#pragma once
// The words of error messages: one line, whatever the bytes of the file are.

#include <cstddef>
#include <string>
#include <string_view>

namespace delmesh::io {

/// The text with everything but printable ASCII and UTF-8 letters written as \xNN.
[[nodiscard]] std::string printable(std::string_view text);
/// The same in quotes, cut after 40 bytes.
[[nodiscard]] std::string quote(std::string_view text);

}  // namespace delmesh::io
