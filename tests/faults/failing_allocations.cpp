#include "faults/failing_allocations.hpp"

#include <cerrno>
#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DELMESH_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define DELMESH_SANITIZER 1
#endif
#endif
#if defined(__GLIBC__) && !defined(DELMESH_SANITIZER)
#define DELMESH_REPLACES_MALLOC 1
#endif

namespace delmesh::test {

std::atomic<std::size_t> allocations_left{no_limit};
std::atomic<bool> some_allocation_failed{false};
std::atomic<bool> only_one_fails{false};
std::atomic<bool> libraries_count{false};
#ifdef DELMESH_REPLACES_MALLOC
const bool libraries_can_count = true;
#else
const bool libraries_can_count = false;
#endif

namespace {

bool may_allocate() noexcept {
    std::size_t here = allocations_left.load();
    while (here != no_limit && here > 0 && !allocations_left.compare_exchange_weak(here, here - 1)) {
    }
    if (here > 0) return true;
    some_allocation_failed = true;
    if (only_one_fails) allocations_left = no_limit;
    errno = ENOMEM;
    return false;
}

}  // namespace
}  // namespace delmesh::test

#ifdef DELMESH_REPLACES_MALLOC
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): the names that glibc keeps for this
extern "C" {
void* __libc_malloc(std::size_t size) noexcept;
void* __libc_calloc(std::size_t count, std::size_t size) noexcept;
void* __libc_realloc(void* memory, std::size_t size) noexcept;

void* malloc(std::size_t size) noexcept {
    using namespace delmesh::test;
    return !libraries_count || may_allocate() ? __libc_malloc(size) : nullptr;
}
void* calloc(std::size_t count, std::size_t size) noexcept {
    using namespace delmesh::test;
    return !libraries_count || may_allocate() ? __libc_calloc(count, size) : nullptr;
}
void* realloc(void* memory, std::size_t size) noexcept {
    using namespace delmesh::test;
    return !libraries_count || may_allocate() ? __libc_realloc(memory, size) : nullptr;
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
#endif

namespace {

void* allocate(std::size_t size) noexcept {
    const std::size_t wanted = size > 0 ? size : 1;
#ifdef DELMESH_REPLACES_MALLOC
    return delmesh::test::may_allocate() ? __libc_malloc(wanted) : nullptr;
#else
    return delmesh::test::may_allocate() ? std::malloc(wanted) : nullptr;
#endif
}

}  // namespace

void* operator new(std::size_t size) {
    if (void* const memory = allocate(size)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size);
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
