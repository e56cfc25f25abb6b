#pragma once
// Eight boxes of floats, tested against a point at once.

#include <array>
#include <cmath>
#include <cstddef>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace delmesh::measure {

/// Stored by axis and side, so that one instruction works on several boxes. An absent box is [inf, -inf].
struct EightBoxes {
    static constexpr std::size_t count = 8;
    alignas(16) float low[3][count];
    alignas(16) float high[3][count];
};

/// The squared distances of eight boxes, and a bit for each that is not beyond the limit.
struct BoxDistances {
    alignas(16) std::array<float, EightBoxes::count> squared;
    unsigned near = 0;
};

namespace portable {

/// The distances of all boxes to the cube of half-size `slack` about p.
inline void find_near(const EightBoxes& boxes, const std::array<float, 3>& p, float slack, float limit,
                      BoxDistances& result) {
    result.squared.fill(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float above = p[axis] + slack, below = p[axis] - slack;
        for (std::size_t i = 0; i < EightBoxes::count; ++i) {
            const float under = boxes.low[axis][i] - above, over = below - boxes.high[axis][i];
            const float gap = std::fmax(std::fmax(under, over), 0.0F);
            result.squared[i] += gap * gap;
        }
    }
    result.near = 0;
    for (unsigned i = 0; i < EightBoxes::count; ++i)
        if (result.squared[i] <= limit) result.near |= 1U << i;
}

}  // namespace portable

#if defined(__SSE2__)

/// The same bits as the portable one: compilers do not vectorise maxima that have to care for signed zeros.
inline void find_near(const EightBoxes& boxes, const std::array<float, 3>& p, float slack, float limit,
                      BoxDistances& result) {
    __m128 above[3], below[3];
    for (int axis = 0; axis < 3; ++axis) {
        above[axis] = _mm_set1_ps(p[axis] + slack);
        below[axis] = _mm_set1_ps(p[axis] - slack);
    }
    const __m128 limits = _mm_set1_ps(limit);
    unsigned near = 0;
    for (unsigned half = 0; half < EightBoxes::count; half += 4) {
        __m128 sum = _mm_setzero_ps();
        for (int axis = 0; axis < 3; ++axis) {
            const __m128 under = _mm_sub_ps(_mm_load_ps(boxes.low[axis] + half), above[axis]);
            const __m128 over = _mm_sub_ps(below[axis], _mm_load_ps(boxes.high[axis] + half));
            const __m128 gap = _mm_max_ps(_mm_max_ps(under, over), _mm_setzero_ps());
            sum = _mm_add_ps(sum, _mm_mul_ps(gap, gap));
        }
        _mm_store_ps(result.squared.data() + half, sum);
        near |= static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(sum, limits))) << half;
    }
    result.near = near;
}

#else

using portable::find_near;

#endif

}  // namespace delmesh::measure
