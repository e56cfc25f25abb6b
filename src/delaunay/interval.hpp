#pragma once
// Interval arithmetic with outward rounding, for proofs. Widens each result by more than its rounding error, so that
// the rounding mode stays as it is and all systems agree.

#include <algorithm>
#include <cmath>
#include <limits>

namespace delmesh {

/// Holds the exact value, whatever that is. Operands must be finite; the caller sees to that by the range of what it
/// computes with.
struct Interval {
    double low = 0;
    double high = 0;

    [[nodiscard]] bool is_negative() const { return high < 0; }
    [[nodiscard]] bool is_positive() const { return low > 0; }
    [[nodiscard]] double middle() const { return 0.5 * (low + high); }
};

/// Not above any real number that rounds to x. The allowance for underflow is itself a normal number.
[[nodiscard]] inline double round_down(double x) {
    return x - (std::fabs(x) * 0x1p-52 + 0x1p-1000);
}
[[nodiscard]] inline double round_up(double x) {
    return x + (std::fabs(x) * 0x1p-52 + 0x1p-1000);
}
[[nodiscard]] inline Interval outward(double low, double high) {
    return {round_down(low), round_up(high)};
}
[[nodiscard]] inline Interval exactly(double x) {
    return {x, x};
}
[[nodiscard]] inline Interval widened(Interval a, double by) {
    return outward(a.low - by, a.high + by);
}

[[nodiscard]] inline Interval operator+(Interval a, Interval b) {
    return outward(a.low + b.low, a.high + b.high);
}
[[nodiscard]] inline Interval operator-(Interval a, Interval b) {
    return outward(a.low - b.high, a.high - b.low);
}
[[nodiscard]] inline Interval operator-(Interval a) {
    return {-a.high, -a.low};
}
[[nodiscard]] inline Interval operator*(Interval a, Interval b) {
    const double products[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    return outward(*std::min_element(products, products + 4), *std::max_element(products, products + 4));
}
[[nodiscard]] inline Interval square(Interval a) {
    const double largest = std::max(std::fabs(a.low), std::fabs(a.high));
    const double least = a.low > 0 || a.high < 0 ? std::min(std::fabs(a.low), std::fabs(a.high)) : 0;
    return {std::max(round_down(least * least), 0.0), round_up(largest * largest)};
}
/// Requires b.is_positive().
[[nodiscard]] inline Interval operator/(Interval a, Interval b) {
    return outward(std::min(a.low / b.low, a.low / b.high), std::max(a.high / b.low, a.high / b.high));
}
[[nodiscard]] inline Interval square_root(Interval a) {
    return {std::max(round_down(std::sqrt(std::max(a.low, 0.0))), 0.0), round_up(std::sqrt(std::max(a.high, 0.0)))};
}

}  // namespace delmesh
