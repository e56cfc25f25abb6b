#include "io/soup_builder.hpp"

namespace delmesh::io {

void SoupBuilder::add_start() {
    auto& starts = soup.starts;
    if (starts.empty()) {
        const std::size_t triangles = face_begin_ / 3;
        starts.resize(triangles + 1);
        for (std::size_t f = 0; f <= triangles; ++f) starts[f] = 3 * f;
    }
    starts.push_back(soup.corners.size());
}

}  // namespace delmesh::io
