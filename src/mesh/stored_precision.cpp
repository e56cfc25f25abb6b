#include "delmesh/mesh/stored_precision.hpp"

#include "delmesh/mesh/rounding.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace delmesh {
namespace {

constexpr int fewest_digits = 6;
constexpr int most_digits = 8;

/// All powers of ten that are doubles, exactly.
constexpr std::array<double, 23> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                               1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// n * 10^exponent, rounded once as a reader of text does.
double decimal(double n, int exponent) {
    const double power = powers_of_ten[static_cast<std::size_t>(std::abs(exponent))];
    return exponent < 0 ? n / power : n * power;
}

/// The k with 10^k <= x < 10^(k+1), for x between 1e-14 and 1e22.
int decade(double x) {
    int k = 0;
    while (k < 21 && decimal(1, k + 1) <= x) ++k;
    while (k > -14 && decimal(1, k) > x) --k;
    return k;
}

/// The fewest decimal digits, at least `least`, that the number (or the float nearest to it) can be written with; one
/// more than `most_digits` if it needs more.
int count_digits(double x, int k, int least) {
    for (int digits = least; digits <= most_digits; ++digits) {
        const int last = k + 1 - digits;
        const double n = std::nearbyint(decimal(x, -last));
        const double written = decimal(n, last);
        if (written == x || round_to_float(written) == x) return digits;
    }
    return most_digits + 1;
}

/// The largest error of numbers that were rounded to `digits` decimal digits.
struct DecimalRounding {
    int digits = fewest_digits - 1;
    double error = 0;

    /// False if the number has too many digits.
    bool add(double x) {
        x = std::fabs(x);
        // What is tiny beside other numbers says nothing; what is huge, nothing that is to be found in decimals.
        if (x < 1e-13) return true;
        if (x >= 1e21) return false;
        const int k = decade(x);
        const int needed = count_digits(x, k, std::max(digits, fewest_digits - 1));
        if (needed > most_digits) return false;
        if (needed > digits) error = 0;
        digits = needed;
        // How many digits this number has by itself matters only at the finest level.
        if (count_digits(x, k, fewest_digits - 1) == digits) error = std::max(error, 0.5 * decimal(1, k + 1 - digits));
        return true;
    }
};

/// True for floats, and for what becomes of them when a power of two scales a mesh.
bool has_float_mantissa(double x) {
    return (std::bit_cast<std::uint64_t>(x) & 0x1fffffff) == 0;
}

}  // namespace

double stored_rounding(std::span<const Vec3> points) {
    double largest = 0;
    bool floats = true;
    bool decimals = true;
    DecimalRounding decimal_rounding;
    for (const Vec3& p : points) {
        for (const int axis : {0, 1, 2}) {
            const double x = p[axis];
            largest = std::max(largest, std::fabs(x));
            floats = floats && has_float_mantissa(x);
            decimals = decimals && decimal_rounding.add(x);
        }
    }
    const double binary = largest * (floats ? 0x1p-24 : 0x1p-53);
    return decimals && decimal_rounding.digits >= fewest_digits ? std::max(binary, decimal_rounding.error) : binary;
}

}  // namespace delmesh
