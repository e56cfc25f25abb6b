#pragma once

// For functions that only prefetch: GCC 12 takes a call of one that is not inlined for a call without effect, and
// leaves it out.
#if defined(__GNUC__) || defined(__clang__)
#define DELMESH_ALWAYS_INLINE [[gnu::always_inline]] inline
#else
#define DELMESH_ALWAYS_INLINE inline
#endif

namespace delmesh {

/// Asks for the cache line at `address`, where the compiler offers that. Never needed, never wrong.
DELMESH_ALWAYS_INLINE void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
    __builtin_prefetch(address);
#endif
}

}  // namespace delmesh
