#pragma once
// The version of the library. This is the one place where it stands: the build reads it from here.

#include <string_view>

namespace delmesh {

/// Semantic version, "major.minor.patch".
inline constexpr std::string_view version = "0.1.0";

}  // namespace delmesh
