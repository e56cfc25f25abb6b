#pragma once
// What the samples are made with: noise and circles whose bits are the same everywhere, and triangle grids.
// (The standard library's sine, cosine and random distributions differ between systems.)

#include "delmesh/mesh/polygon_soup.hpp"

#include <cstddef>
#include <cstdint>

namespace delmesh::shapes {

/// Noise by hashing: the value at a key depends on the seed and the key alone.
class Noise {
public:
    explicit Noise(std::uint64_t seed);

    [[nodiscard]] std::uint64_t bits(std::uint64_t key) const;
    /// Uniform in [-1, 1).
    [[nodiscard]] double value(std::uint64_t key) const;
    /// Three independent values, each uniform in [-1, 1).
    [[nodiscard]] Vec3 vector(std::uint64_t key) const;
    /// Smooth in p, in [-1, 1], with features of size 1.
    [[nodiscard]] double smooth(Vec3 p) const;
    /// Sum of `octaves` smooth noises, each with half the size and half the height of the one before; in (-2, 2).
    [[nodiscard]] double fractal(Vec3 p, int octaves) const;

private:
    std::uint64_t seed_;
};

struct CosSin {
    double cos;
    double sin;
};

/// Cosine and sine of `part` / `whole` turns, to about one ulp of 1; whole < 2^60.
[[nodiscard]] CosSin turn(std::uint64_t part, std::uint64_t whole);

struct GridSize {
    std::size_t nx;
    std::size_t ny;
};

/// A grid of about `cells` cells, `aspect` times as many along x as along y, at least `least` each way.
[[nodiscard]] GridSize grid_size(double cells, double aspect = 1, std::size_t least = 1);

[[nodiscard]] constexpr std::uint32_t as_index(std::size_t i) {
    return static_cast<std::uint32_t>(i);
}

inline void add_triangle(PolygonSoup& soup, std::size_t a, std::size_t b, std::size_t c) {
    soup.corners.insert(soup.corners.end(), {as_index(a), as_index(b), as_index(c)});
}

/// The quad a, b, c, d (counter-clockwise) as two triangles, cut from a to c or else from b to d.
inline void add_quad(PolygonSoup& soup, std::size_t a, std::size_t b, std::size_t c, std::size_t d, bool cut_ac) {
    if (cut_ac) {
        add_triangle(soup, a, b, c);
        add_triangle(soup, a, c, d);
    } else {
        add_triangle(soup, a, b, d);
        add_triangle(soup, b, c, d);
    }
}

/// All quads of a grid: index(i, j) names the vertex at i in [0, nx], j in [0, ny]; cut_up(i, j) says whether the cell
/// is cut from (i, j) to (i+1, j+1).
template <class Index, class CutUp>
void add_grid(PolygonSoup& soup, GridSize size, const Index& index, const CutUp& cut_up) {
    soup.corners.reserve(soup.corners.size() + 6 * size.nx * size.ny);
    for (std::size_t j = 0; j < size.ny; ++j) {
        for (std::size_t i = 0; i < size.nx; ++i) {
            add_quad(soup, index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1), cut_up(i, j));
        }
    }
}

/// An open grid patch whose vertices are point(i, j), row by row.
template <class Point, class CutUp>
PolygonSoup make_patch(GridSize size, const Point& point, const CutUp& cut_up) {
    PolygonSoup soup;
    const std::size_t row = size.nx + 1;
    soup.points.reserve(row * (size.ny + 1));
    for (std::size_t j = 0; j <= size.ny; ++j) {
        for (std::size_t i = 0; i <= size.nx; ++i) soup.points.push_back(point(i, j));
    }
    add_grid(
        soup, size, [row](std::size_t i, std::size_t j) { return j * row + i; }, cut_up);
    return soup;
}

/// Drops the points that no face uses; the others keep their order.
void drop_unused_points(PolygonSoup& soup);

/// Adds a copy of `part`, scaled and then moved.
void append(PolygonSoup& soup, const PolygonSoup& part, Vec3 offset, double scale = 1);

/// A unit sphere: an icosahedron with every face cut into n^2 triangles, 20 n^2 in all. Delaunay as it is.
[[nodiscard]] PolygonSoup geodesic_sphere(std::size_t n);

/// The surface of a box of nx * ny * nz cells with integer coordinates, cut along the +,+ diagonals.
[[nodiscard]] PolygonSoup box_surface(std::size_t nx, std::size_t ny, std::size_t nz);

}  // namespace delmesh::shapes
