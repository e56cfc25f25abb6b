#include "delmesh/base/context.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace delmesh {
namespace {

TEST(Context, NoContextMeansNoLimits) {
    EXPECT_FALSE(is_cancelled(nullptr));
    EXPECT_EQ(thread_count(nullptr), 0);
    report_progress(nullptr, "phase", 0.5);
}

TEST(Context, CancellingSticksAndIsSeenByOtherThreads) {
    Context context;
    EXPECT_FALSE(is_cancelled(&context));
    std::thread([&context] { context.cancel(); }).join();
    EXPECT_TRUE(is_cancelled(&context));
    EXPECT_TRUE(context.cancelled());
}

TEST(Context, ProgressReachesTheCaller) {
    std::vector<std::string> seen;
    const Context context(
        [&seen](std::string_view phase, double fraction) {
            seen.push_back(std::string(phase) + " " + std::to_string(static_cast<int>(100 * fraction)));
        },
        3);
    report_progress(&context, "split", 0.25);
    report_progress(&context, "split", 1);
    EXPECT_EQ(seen, (std::vector<std::string>{"split 25", "split 100"}));
    EXPECT_EQ(thread_count(&context), 3);
}

}  // namespace
}  // namespace delmesh
