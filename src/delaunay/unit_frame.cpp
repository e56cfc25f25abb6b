#include "delaunay/unit_frame.hpp"

#include <algorithm>
#include <limits>

namespace delmesh {

UnitFrame unit_frame(const Mesh& mesh) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3 low{infinity, infinity, infinity};
    Vec3 high = -low;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.halfedge(VertexId(v)).valid()) continue;
        const Vec3& p = mesh.point(VertexId(v));
        for (const int axis : {0, 1, 2}) {
            low[axis] = std::min(low[axis], p[axis]);
            high[axis] = std::max(high[axis], p[axis]);
        }
    }
    UnitFrame frame;
    if (low.x > high.x) return frame;
    double largest = 0;
    for (const int axis : {0, 1, 2}) largest = std::max({largest, std::fabs(low[axis]), std::fabs(high[axis])});
    if (largest == 0) return frame;
    frame.exponent = -std::ilogb(largest) - 1;
    frame.largest = std::scalbn(largest, frame.exponent);
    frame.diagonal = norm(frame(high) - frame(low));
    return frame;
}

}  // namespace delmesh
