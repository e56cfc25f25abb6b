#pragma once
// Progress, cancellation and the thread count of a call. A `Context*` is always the last argument and may be null.

#include <atomic>
#include <functional>
#include <string_view>

namespace delmesh {

/// One context serves one call at a time; `cancel()` may be called from any thread or signal handler.
/// Cancelling is sticky: make a new context for the next call.
class Context {
public:
    /// Called on the thread that runs the algorithm, now and then, with fraction in [0,1] (never falling within a
    /// phase).
    using Progress = std::function<void(std::string_view phase, double fraction)>;

    Context() = default;
    explicit Context(Progress progress, int threads = 0) : progress_(std::move(progress)), threads_(threads) {}

    void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }

    void report(std::string_view phase, double fraction) const {
        if (progress_) progress_(phase, fraction);
    }

    /// 0: as many as the machine has. Results never depend on it.
    [[nodiscard]] int threads() const { return threads_; }
    void set_threads(int threads) { threads_ = threads; }

private:
    Progress progress_;
    std::atomic<bool> cancelled_{false};
    int threads_ = 0;
};

inline bool is_cancelled(const Context* context) {
    return context != nullptr && context->cancelled();
}
inline int thread_count(const Context* context) {
    return context == nullptr ? 0 : context->threads();
}
inline void report_progress(const Context* context, std::string_view phase, double fraction) {
    if (context != nullptr) context->report(phase, fraction);
}

}  // namespace delmesh
