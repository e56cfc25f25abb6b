#include "simplify/sweep_tools.hpp"

#include "simplify/triangle_point.hpp"

#include <algorithm>
#include <limits>

namespace delmesh::sweeps {

Tuning without_search(Tuning tuning) {
    tuning.bisections = 0;
    tuning.sqp_steps = 0;
    return tuning;
}

float quantile(std::vector<float>& keys, double part) {
    if (keys.empty()) return 0;
    const auto at = keys.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(keys.size()));
    std::nth_element(keys.begin(), at, keys.end());
    return *at;
}

double find_distance2(const Star& star, const Vec3& w, const Vec3& p, double enough) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < star.face_count() && least > enough; ++i)
        least =
            std::min(least, nearest_on_triangle(p, w, star.ring[i].point, star.ring[star.after(i)].point).distance2);
    return least;
}

std::vector<VertexId> merged_into(std::vector<VertexId> parent, const std::vector<VertexId>& ids) {
    for (std::size_t v = 0; v < parent.size(); ++v) {
        // Halves the way for all that come here later.
        VertexId at(v);
        while (parent[at.index()] != at) at = parent[at.index()] = parent[parent[at.index()].index()];
        parent[v] = at;
    }
    for (VertexId& v : parent) v = ids[v.index()];
    return parent;
}

}  // namespace delmesh::sweeps
