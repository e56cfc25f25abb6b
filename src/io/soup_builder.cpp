#include "io/soup_builder.hpp"

#include <algorithm>
#include <limits>
#include <utility>

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

void SoupBuilder::add_missing_point() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    soup.points.push_back({nan, nan, nan});
}

void SoupBuilder::leave_out_dangling() {
    const auto is_missing = [this](std::uint32_t vertex) { return vertex >= soup.points.size(); };
    std::erase_if(soup.lines, [&](const auto& line) { return is_missing(line[0]) || is_missing(line[1]); });
    if (std::ranges::none_of(soup.corners, is_missing)) return;
    PolygonSoup whole;
    for (std::size_t f = 0; f < soup.face_count(); ++f)
        if (std::ranges::none_of(soup.face(f), is_missing)) whole.add_face(soup.face(f));
    soup.corners = std::move(whole.corners);
    soup.starts = std::move(whole.starts);
}

}  // namespace delmesh::io
