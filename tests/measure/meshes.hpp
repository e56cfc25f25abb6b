#pragma once
// Meshes for the tests of this layer, made by code.

#include "delmesh/mesh/mesh.hpp"
#include "support/random.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace delmesh::testing {

inline PolygonSoup soup_of(std::vector<Vec3> points, std::vector<std::uint32_t> corners) {
    PolygonSoup soup;
    soup.points = std::move(points);
    soup.corners = std::move(corners);
    return soup;
}

inline Mesh mesh_of(std::vector<Vec3> points, std::vector<std::uint32_t> corners) {
    return Mesh(soup_of(std::move(points), std::move(corners)));
}

/// n by n squares of side `step`, each cut in two, in the plane z = height. Each diagonal is exactly co-circular.
inline PolygonSoup grid_soup(std::uint32_t n, double step = 1, double height = 0) {
    PolygonSoup soup;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) soup.points.push_back({i * step, j * step, height});
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            for (const std::uint32_t v : {a, a + 1, a + n + 2, a, a + n + 2, a + n + 1}) soup.corners.push_back(v);
        }
    }
    return soup;
}

/// A torus of n by m quads, each cut in two, with radii 1 and 0.4; points moved by up to `noise` in each coordinate.
inline PolygonSoup torus_soup(std::uint32_t n, std::uint32_t m, double noise, std::uint64_t seed = 1) {
    constexpr double tau = 6.283185307179586;
    test::Random random(seed);
    PolygonSoup soup;
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < m; ++j) {
            const double s = tau * i / n, t = tau * j / m, r = 1 + 0.4 * std::cos(t);
            const double dx = noise * random.real(-1, 1), dy = noise * random.real(-1, 1),
                         dz = noise * random.real(-1, 1);
            soup.points.push_back({r * std::cos(s) + dx, r * std::sin(s) + dy, 0.4 * std::sin(t) + dz});
        }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < m; ++j) {
            const std::uint32_t i1 = (i + 1) % n, j1 = (j + 1) % m;
            const std::uint32_t a = i * m + j, b = i1 * m + j, c = i1 * m + j1, d = i * m + j1;
            for (const std::uint32_t v : {a, b, c, a, c, d}) soup.corners.push_back(v);
        }
    }
    return soup;
}

/// The points turned about the z axis by the angle of (3, 4), and five times as long: exact for small integers.
inline PolygonSoup turned(PolygonSoup soup) {
    for (Vec3& p : soup.points) p = {3 * p.x - 4 * p.y, 4 * p.x + 3 * p.y, 5 * p.z};
    return soup;
}

inline PolygonSoup scaled(PolygonSoup soup, int exponent) {
    for (Vec3& p : soup.points)
        p = {std::scalbn(p.x, exponent), std::scalbn(p.y, exponent), std::scalbn(p.z, exponent)};
    return soup;
}

}  // namespace delmesh::testing
