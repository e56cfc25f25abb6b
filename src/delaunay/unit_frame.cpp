#include "delaunay/unit_frame.hpp"

#include "mesh/bounding_box.hpp"

#include <algorithm>

namespace delmesh {

UnitFrame unit_frame(const Mesh& mesh) {
    const Box box = bounding_box(mesh);
    UnitFrame frame;
    if (box.is_empty()) return frame;
    double largest = 0;
    for (const int axis : {0, 1, 2}) largest = std::max({largest, std::fabs(box.low[axis]), std::fabs(box.high[axis])});
    if (largest == 0) return frame;
    frame.exponent = -std::ilogb(largest) - 1;
    frame.largest = std::scalbn(largest, frame.exponent);
    frame.diagonal = norm(frame(box.high) - frame(box.low));
    return frame;
}

}  // namespace delmesh
