#pragma once
// An axis-parallel box that grows with what is put into it.

#include "delmesh/base/vec3.hpp"

#include <algorithm>
#include <limits>

namespace delmesh {

struct Box {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3 low{infinity, infinity, infinity};
    Vec3 high{-infinity, -infinity, -infinity};

    [[nodiscard]] bool is_empty() const { return low.x > high.x; }
    void add(const Vec3& p) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], p[axis]);
            high[axis] = std::max(high[axis], p[axis]);
        }
    }
    void add(const Box& box) {
        add(box.low);
        add(box.high);
    }
};

}  // namespace delmesh
