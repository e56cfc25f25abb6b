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
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
