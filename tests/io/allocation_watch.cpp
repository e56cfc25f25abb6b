#include "io/allocation_watch.hpp"

#include <cstdlib>
#include <new>

namespace delmesh::test {

std::atomic<std::size_t> largest_allocation{0};

}  // namespace delmesh::test

using delmesh::test::largest_allocation;

void* operator new(std::size_t size) {
    std::size_t largest = largest_allocation.load();
    while (largest < size && !largest_allocation.compare_exchange_weak(largest, size)) {
    }
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
// (std::stable_sort asks in this way.)
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return operator new(size);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
    std::free(memory);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
