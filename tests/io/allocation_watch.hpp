#pragma once
// The largest piece of memory that the program asked for since this was last set: what is reserved counts, not only
// what is used.

#include <atomic>
#include <cstddef>

namespace delmesh::test {

extern std::atomic<std::size_t> largest_allocation;

}  // namespace delmesh::test
