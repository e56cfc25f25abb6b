#include "simplify/frame.hpp"

#include "mesh/bounding_box.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh {

double local_scale(const Mesh& mesh) {
    const Box box = bounding_box(mesh);
    if (box.is_empty()) return 1;
    const double diagonal = norm(box.high * 0.5 - box.low * 0.5);
    if (!(diagonal > 0)) return 1;
    return std::ldexp(1.0, std::clamp(-std::ilogb(diagonal), -1022, 1022));
}

}  // namespace delmesh
