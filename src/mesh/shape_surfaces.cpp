#include "mesh/shape_makers.hpp"

#include <algorithm>
#include <cmath>

namespace delmesh::shapes {

namespace {

double real(std::size_t i) {
    return static_cast<double>(i);
}

/// The mean edge length of `faces` equilateral triangles that cover `area`.
double edge_length(double area, std::size_t faces) {
    return std::sqrt(4 * area / (std::sqrt(3.0) * static_cast<double>(faces)));
}

constexpr double sphere_area = 12.566370614359172954;

std::size_t sphere_frequency(std::size_t faces) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(std::sqrt(real(faces) / 20))));
}

/// Moves every point by up to `amount` mean edge lengths along each axis.
void jitter(PolygonSoup& soup, const Noise& noise, double amount) {
    const double reach = amount * edge_length(sphere_area, soup.face_count());
    for (std::size_t v = 0; v < soup.points.size(); ++v) soup.points[v] = soup.points[v] + noise.vector(v) * reach;
}

/// Turns every point about the z axis, by an angle that grows with z: the triangles of a sphere become unequal, so that
/// modest noise makes many edges that are not Delaunay.
void twist(PolygonSoup& soup, double amount) {
    for (Vec3& p : soup.points) {
        const double half_tangent = amount * p.z;
        const double scale = 1 / (1 + half_tangent * half_tangent);
        const double c = (1 - half_tangent * half_tangent) * scale;
        const double s = 2 * half_tangent * scale;
        p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    }
}

bool always(std::size_t /*i*/, std::size_t /*j*/) {
    return true;
}

/// Cuts the cells of a grid up or down at random.
auto at_random(const Noise& noise, GridSize size) {
    return [&noise, size](std::size_t i, std::size_t j) { return noise.bits(j * size.nx + i) % 2 == 0; };
}

}  // namespace

PolygonSoup make_grid(std::size_t faces, const Noise& noise) {
    const GridSize size = grid_size(real(faces) / 2);
    return make_patch(
        size,
        [](std::size_t i, std::size_t j) {
            return Vec3{real(i), real(j), 0};
        },
        at_random(noise, size));
}

PolygonSoup make_inclined_grid(std::size_t faces, const Noise& noise) {
    const GridSize size = grid_size(real(faces) / 2);
    // Two turns by Pythagorean angles; neither 0.1 nor the results are exact in binary, so every coordinate is rounded.
    const auto point = [](std::size_t i, std::size_t j) {
        const double x = 0.1 * real(i);
        const double y = 0.1 * real(j);
        const double turned_x = (3 * x - 4 * y) / 5;
        const double turned_y = (4 * x + 3 * y) / 5;
        return Vec3{turned_x, 5 * turned_y / 13, 12 * turned_y / 13};
    };
    return make_patch(size, point, at_random(noise, size));
}

PolygonSoup make_jittered_grid(std::size_t faces, const Noise& noise) {
    const GridSize size = grid_size(real(faces) / 2);
    const auto point = [&](std::size_t i, std::size_t j) {
        const bool inside = i > 0 && i < size.nx && j > 0 && j < size.ny;
        const Vec3 shift = noise.vector(j * (size.nx + 1) + i) * (inside ? 0.24 : 0.0);
        return Vec3{real(i) + shift.x, real(j) + shift.y, 0};
    };
    return make_patch(size, point, at_random(noise, size));
}

PolygonSoup make_saddle(std::size_t faces, const Noise& /*noise*/) {
    const GridSize size = grid_size(real(faces) / 2);
    const auto point = [&](std::size_t i, std::size_t j) {
        const double x = 2 * (real(i) / real(size.nx)) - 1;
        const double y = 2 * (real(j) / real(size.ny)) - 1;
        return Vec3{x, y, x * x - y * y};
    };
    return make_patch(size, point, always);
}

PolygonSoup make_terrain(std::size_t faces, const Noise& noise) {
    constexpr std::size_t tile = 16;
    const GridSize size = grid_size(real(faces) / 2 / (1 - 20.0 / (tile * tile)));
    const double unit = 8 / real(size.nx);
    const auto point = [&](std::size_t i, std::size_t j) {
        const Vec3 shift = noise.vector(j * (size.nx + 1) + i) * 0.24;
        const Vec3 p{(real(i) + shift.x) * unit, (real(j) + shift.y) * unit, 0};
        return Vec3{p.x, p.y, 0.5 * noise.fractal(p, 4)};
    };
    // One hole of 5 x 4 cells in each whole tile, never at its rim: holes of neighbours do not touch.
    const auto in_hole = [&](std::size_t i, std::size_t j) {
        const std::size_t tile_i = i / tile;
        const std::size_t tile_j = j / tile;
        if ((tile_i + 1) * tile > size.nx || (tile_j + 1) * tile > size.ny) return false;
        const std::uint64_t place = noise.bits(~(tile_j * size.nx + tile_i));
        const std::size_t first_i = tile_i * tile + 1 + place % 10;
        const std::size_t first_j = tile_j * tile + 1 + (place >> 32U) % 11;
        return i >= first_i && i < first_i + 5 && j >= first_j && j < first_j + 4;
    };
    PolygonSoup soup = make_patch({size.nx, size.ny}, point, always);
    std::size_t kept = 0;
    for (std::size_t cell = 0; cell < size.nx * size.ny; ++cell) {
        if (in_hole(cell % size.nx, cell / size.nx)) continue;
        std::copy_n(soup.corners.begin() + static_cast<std::ptrdiff_t>(6 * cell), 6,
                    soup.corners.begin() + static_cast<std::ptrdiff_t>(6 * kept++));
    }
    soup.corners.resize(6 * kept);
    drop_unused_points(soup);
    return soup;
}

PolygonSoup make_icosphere(std::size_t faces, const Noise& /*noise*/) {
    return geodesic_sphere(sphere_frequency(faces));
}

PolygonSoup make_stretched_sphere(std::size_t faces, const Noise& /*noise*/) {
    PolygonSoup soup = geodesic_sphere(sphere_frequency(faces));
    for (Vec3& p : soup.points) p.z *= 8;
    return soup;
}

PolygonSoup make_noisy_sphere(std::size_t faces, const Noise& noise) {
    PolygonSoup soup = geodesic_sphere(sphere_frequency(faces));
    twist(soup, 0.42);
    jitter(soup, noise, 0.25);
    return soup;
}

PolygonSoup make_noisy_surface(std::size_t faces, const Noise& noise) {
    PolygonSoup soup = geodesic_sphere(sphere_frequency(faces));
    twist(soup, 0.46);
    for (Vec3& p : soup.points) p = p * (1 + 0.2 * noise.fractal(p * 2.0, 3));
    jitter(soup, noise, 0.25);
    return soup;
}

PolygonSoup make_torus(std::size_t faces, const Noise& /*noise*/) {
    constexpr double tube = 0.4;
    // Rhombic cells: each row is shifted by half a cell, and the rows close up after a whole number of cells.
    GridSize size = grid_size(real(faces) / 2, 2.5, 8);
    size.ny += size.ny % 2;
    size.nx = std::max<std::size_t>(8, static_cast<std::size_t>(std::llround(real(faces) / 2 / real(size.ny))));
    PolygonSoup soup;
    soup.points.reserve(size.nx * size.ny);
    for (std::size_t j = 0; j < size.ny; ++j) {
        const CosSin around_tube = turn(j, size.ny);
        for (std::size_t i = 0; i < size.nx; ++i) {
            const CosSin around_axis = turn(2 * i + j, 2 * size.nx);
            const double radius = 1 + tube * around_tube.cos;
            soup.points.push_back({radius * around_axis.cos, radius * around_axis.sin, tube * around_tube.sin});
        }
    }
    const auto index = [size](std::size_t i, std::size_t j) {
        return j < size.ny ? j * size.nx + i % size.nx : (i + size.ny / 2) % size.nx;
    };
    add_grid(soup, size, index, always);
    return soup;
}

}  // namespace delmesh::shapes
