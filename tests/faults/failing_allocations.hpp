#pragma once
// An operator new that fails when it is told to.

#include <atomic>
#include <cstddef>
#include <limits>

namespace delmesh::test {

inline constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

/// How many allocations still succeed; several threads may ask.
extern std::atomic<std::size_t> allocations_left;
/// Set when one does not; never reset here.
extern std::atomic<bool> some_allocation_failed;

}  // namespace delmesh::test
