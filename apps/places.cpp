#include "places.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/mesh/coincident.hpp"

#include <fmt/format.h>

#include <utility>

namespace delmesh::app {

PlacesReport tell_places_apart(PolygonSoup& soup) {
    if (find_coincident(soup).empty()) return {};
    PolygonSoup welded = soup;
    const std::size_t joined = weld_coincident(welded);
    try {
        (void)Mesh(welded);
    } catch (const Error&) {
        std::vector<Vec3> before = soup.points;
        return {0, part_coincident(soup), std::move(before)};
    }
    soup = std::move(welded);
    return {joined, 0, {}};
}

void check_places(const std::string& path, const Mesh& mesh) {
    const auto pairs = find_coincident(to_soup(mesh));
    if (pairs.empty()) return;
    throw Error(ErrorCode::unsupported_format,
                fmt::format("{}: STL has no indices and would join vertices {} and {}, which lie at the same place; "
                            "write PLY, OBJ or OFF instead",
                            path, pairs[0][0], pairs[0][1]),
                {pairs[0][0], pairs[0][1]}, pairs.size());
}

}  // namespace delmesh::app
