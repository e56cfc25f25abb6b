#pragma once
// Loops over blocks of fixed size on as many threads as the context allows. The blocks do not depend on the number of
// threads, so neither does what is computed from them.

#include "delmesh/base/context.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <typeinfo>

namespace delmesh {

/// Calls body() so that what it runs in parallel uses as many threads as the context allows.
template <class Body>
void run_in_arena(const Context* context, Body&& body) {
    // Without it TBB complains on stderr about more threads than cores.
    const auto wanted = static_cast<std::size_t>(std::max(thread_count(context), tbb::info::default_concurrency()));
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, wanted);
    tbb::task_arena arena(thread_count(context) > 0 ? thread_count(context) : tbb::task_arena::automatic);
    try {
        arena.execute(body);
    } catch (const std::runtime_error& error) {
        // So TBB says that a thread has no memory for its stack.
        if (typeid(error) == typeid(std::runtime_error)) throw std::bad_alloc();
        throw;
    }
}

/// Calls body(begin, end) for consecutive blocks of [0, count), each `block` long but the last.
template <class Body>
void parallel_blocks(std::size_t count, const Context* context, Body&& body, std::size_t block = 16384) {
    const std::size_t blocks = (count + block - 1) / block;
    const auto run = [&](std::size_t i) { body(i * block, std::min(count, (i + 1) * block)); };
    if (blocks <= 1 || thread_count(context) == 1) {
        for (std::size_t i = 0; i < blocks; ++i) run(i);
        return;
    }
    run_in_arena(context, [&] { tbb::parallel_for(std::size_t{0}, blocks, run); });
}

}  // namespace delmesh
