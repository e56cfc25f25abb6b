#include "simplify/frame.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {

double local_scale(const Mesh& mesh) {
    Vec3 low, high;
    bool any = false;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.halfedge(VertexId(v)).valid()) continue;
        const Vec3& p = mesh.points()[v];
        if (!any) low = high = p;
        any = true;
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], p[axis]);
            high[axis] = std::max(high[axis], p[axis]);
        }
    }
    const double diagonal = norm(high * 0.5 - low * 0.5);
    if (!(diagonal > 0)) return 1;
    return std::ldexp(1.0, std::clamp(-std::ilogb(diagonal), -1022, 1022));
}

}  // namespace delmesh
