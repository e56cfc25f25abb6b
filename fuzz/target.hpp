#pragma once
// What a fuzz target consists of.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

/// Runs one input; aborts where a law is broken.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace delmesh::fuzz {

/// Inputs from which a search starts, made by code.
std::vector<std::string> seeds();

/// Ends the program where a law does not hold.
inline void require(bool holds, const char* law, const std::string& found = {}) {
    if (holds) return;
    std::fprintf(stderr, "broken law: %s\n%s\n", law, found.c_str());
    std::abort();
}

}  // namespace delmesh::fuzz
