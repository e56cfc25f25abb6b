#pragma once
// Memory that runs out when it is told to: operator new everywhere, malloc as well (what C libraries ask) where it can
// be replaced.

#include <atomic>
#include <cstddef>
#include <limits>

namespace delmesh::test {

inline constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

/// How many allocations still succeed; several threads may ask.
extern std::atomic<std::size_t> allocations_left;
/// Set when one does not; never reset here.
extern std::atomic<bool> some_allocation_failed;
/// Whether the next one succeeds again.
extern std::atomic<bool> only_one_fails;
/// Whether malloc, calloc and realloc count as well.
extern std::atomic<bool> libraries_count;
/// False with sanitizers, which bring their own malloc, and without glibc.
extern const bool libraries_can_count;

}  // namespace delmesh::test
