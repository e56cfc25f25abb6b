#include "faults/failing_allocations.hpp"

#include <cstdlib>
#include <new>

namespace delmesh::test {

std::atomic<std::size_t> allocations_left{no_limit};
std::atomic<bool> some_allocation_failed{false};

namespace {

void* allocate(std::size_t size) noexcept {
    std::size_t here = allocations_left.load();
    while (here != no_limit && here > 0 && !allocations_left.compare_exchange_weak(here, here - 1)) {
    }
    if (here > 0) return std::malloc(size > 0 ? size : 1);
    some_allocation_failed = true;
    return nullptr;
}

}  // namespace
}  // namespace delmesh::test

void* operator new(std::size_t size) {
    if (void* const memory = delmesh::test::allocate(size)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return delmesh::test::allocate(size);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
    std::free(memory);
}
