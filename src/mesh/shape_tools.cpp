#include "mesh/shape_tools.hpp"

#include "base/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace delmesh::shapes {

namespace {

/// Taylor series, for |x| <= pi/4: the first term left out is below 2^-56.
double sine(double x) {
    const double y = x * x;
    double sum = 0;
    for (int k = 17; k >= 3; k -= 2) sum = (1 - sum) * (y / (k * (k - 1)));
    return x * (1 - sum);
}

double cosine(double x) {
    const double y = x * x;
    double sum = 0;
    for (int k = 18; k >= 2; k -= 2) sum = (1 - sum) * (y / (k * (k - 1)));
    return 1 - sum;
}

double blend(double a, double b, double t) {
    return a + (b - a) * t;
}

}  // namespace

Noise::Noise(std::uint64_t seed) : seed_(Random(seed).next()) {}

std::uint64_t Noise::bits(std::uint64_t key) const {
    return Random(seed_ ^ Random(key).next()).next();
}

double Noise::value(std::uint64_t key) const {
    return std::ldexp(static_cast<double>(bits(key) >> 11U), -52) - 1;
}

Vec3 Noise::vector(std::uint64_t key) const {
    return {value(3 * key), value(3 * key + 1), value(3 * key + 2)};
}

double Noise::smooth(Vec3 p) const {
    std::array<std::int64_t, 3> cell{};
    std::array<double, 3> t{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = std::floor(p[static_cast<int>(axis)]);
        const double part = p[static_cast<int>(axis)] - low;
        cell[axis] = static_cast<std::int64_t>(low);
        t[axis] = part * part * (3 - 2 * part);
    }
    const auto corner = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        const auto key = [](std::int64_t i) { return static_cast<std::uint64_t>(i) & 0x1fffffU; };
        return value(key(cell[0] + x) | key(cell[1] + y) << 21U | key(cell[2] + z) << 42U);
    };
    const auto row = [&](std::int64_t y, std::int64_t z) { return blend(corner(0, y, z), corner(1, y, z), t[0]); };
    const auto sheet = [&](std::int64_t z) { return blend(row(0, z), row(1, z), t[1]); };
    return blend(sheet(0), sheet(1), t[2]);
}

double Noise::fractal(Vec3 p, int octaves) const {
    double sum = 0;
    double height = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += height * smooth(p);
        height *= 0.5;
        // The shift keeps the lattices of the octaves from lining up.
        p = 2.0 * p + Vec3{0.37, 0.59, 0.71};
    }
    return sum;
}

CosSin turn(std::uint64_t part, std::uint64_t whole) {
    constexpr double eighth = 0.78539816339744830962;
    const std::uint64_t eighths = 8 * (part % whole);
    const std::uint64_t octant = eighths / whole;
    const std::uint64_t rest = eighths % whole;
    // Odd octants are mirrored, so that 1/4, 1/2, ... turns are exact.
    const std::uint64_t from_axis = octant % 2 == 0 ? rest : whole - rest;
    const double angle = eighth * (static_cast<double>(from_axis) / static_cast<double>(whole));
    const double c = cosine(angle);
    const double s = sine(angle);
    switch (octant) {
        case 0:
            return {c, s};
        case 1:
            return {s, c};
        case 2:
            return {-s, c};
        case 3:
            return {-c, s};
        case 4:
            return {-c, -s};
        case 5:
            return {-s, -c};
        case 6:
            return {s, -c};
        default:
            return {c, -s};
    }
}

GridSize grid_size(double cells, double aspect, std::size_t least) {
    const auto at_least = [least](double n) { return std::max(least, static_cast<std::size_t>(std::llround(n))); };
    const std::size_t nx = at_least(std::sqrt(cells * aspect));
    return {nx, at_least(cells / static_cast<double>(nx))};
}

void drop_unused_points(PolygonSoup& soup) {
    constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> moved_to(soup.points.size(), unused);
    for (const std::uint32_t v : soup.corners) moved_to[v] = 0;
    std::size_t kept = 0;
    for (std::size_t v = 0; v < moved_to.size(); ++v) {
        if (moved_to[v] == unused) continue;
        soup.points[kept] = soup.points[v];
        moved_to[v] = as_index(kept++);
    }
    soup.points.resize(kept);
    for (std::uint32_t& v : soup.corners) v = moved_to[v];
}

void append(PolygonSoup& soup, const PolygonSoup& part, Vec3 offset, double scale) {
    const std::uint32_t first = as_index(soup.points.size());
    for (const Vec3& p : part.points) soup.points.push_back(p * scale + offset);
    for (const std::uint32_t v : part.corners) soup.corners.push_back(v + first);
}

namespace {

constexpr double golden = 1.61803398874989484820;
constexpr std::array<Vec3, 12> icosahedron_points{{{-1, golden, 0},
                                                   {1, golden, 0},
                                                   {-1, -golden, 0},
                                                   {1, -golden, 0},
                                                   {0, -1, golden},
                                                   {0, 1, golden},
                                                   {0, -1, -golden},
                                                   {0, 1, -golden},
                                                   {golden, 0, -1},
                                                   {golden, 0, 1},
                                                   {-golden, 0, -1},
                                                   {-golden, 0, 1}}};
constexpr std::array<std::array<std::size_t, 3>, 20> icosahedron_faces{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

/// Numbers the lattice points of all faces: the corners, then the insides of the edges, then those of the faces.
class IcosahedronLattice {
public:
    explicit IcosahedronLattice(std::size_t n) : n_(n) {
        for (auto& row : edge_) row.fill(no_edge);
        for (const auto& face : icosahedron_faces) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t a = std::min(face[k], face[(k + 1) % 3]);
                const std::size_t b = std::max(face[k], face[(k + 1) % 3]);
                if (edge_[a][b] == no_edge) edge_[a][b] = edge_count_++;
            }
        }
    }

    [[nodiscard]] std::size_t edge_point(std::size_t a, std::size_t b, std::size_t k) const {
        if (k == 0) return a;
        if (k == n_) return b;
        return a < b ? 12 + edge_[a][b] * (n_ - 1) + k - 1 : 12 + edge_[b][a] * (n_ - 1) + n_ - k - 1;
    }

    /// The point with the weights n-i-j, i, j at the corners of face f.
    [[nodiscard]] std::size_t face_point(std::size_t f, std::size_t i, std::size_t j) const {
        const auto& [a, b, c] = icosahedron_faces[f];
        if (j == 0) return edge_point(a, b, i);
        if (i == 0) return edge_point(a, c, j);
        if (i + j == n_) return edge_point(b, c, j);
        // Row j of the inside holds n-1-j points.
        const std::size_t before = (j - 1) * (n_ - 1) - (j - 1) * j / 2;
        return 12 + edge_count_ * (n_ - 1) + f * ((n_ - 1) * (n_ - 2) / 2) + before + i - 1;
    }

    [[nodiscard]] std::size_t size() const { return 10 * n_ * n_ + 2; }

private:
    static constexpr std::size_t no_edge = 99;
    std::size_t n_;
    std::size_t edge_count_ = 0;
    std::array<std::array<std::size_t, 12>, 12> edge_{};
};

}  // namespace

PolygonSoup geodesic_sphere(std::size_t n) {
    const IcosahedronLattice lattice(n);
    PolygonSoup soup;
    soup.points.resize(lattice.size());
    soup.corners.reserve(60 * n * n);
    for (std::size_t f = 0; f < icosahedron_faces.size(); ++f) {
        const auto& [a, b, c] = icosahedron_faces[f];
        for (std::size_t j = 0; j <= n; ++j) {
            for (std::size_t i = 0; i + j <= n; ++i) {
                const Vec3 p = static_cast<double>(n - i - j) * icosahedron_points[a] +
                               static_cast<double>(i) * icosahedron_points[b] +
                               static_cast<double>(j) * icosahedron_points[c];
                soup.points[lattice.face_point(f, i, j)] = p * (1 / norm(p));
                if (i + j == n) continue;
                const std::size_t right = lattice.face_point(f, i + 1, j);
                const std::size_t up = lattice.face_point(f, i, j + 1);
                add_triangle(soup, lattice.face_point(f, i, j), right, up);
                if (i + j + 1 < n) add_triangle(soup, right, lattice.face_point(f, i + 1, j + 1), up);
            }
        }
    }
    return soup;
}

PolygonSoup box_surface(std::size_t nx, std::size_t ny, std::size_t nz) {
    const std::size_t layer = (nx + 1) * (ny + 1);
    const std::size_t ring = 2 * (nx + ny);
    // The full bottom and top layers, and between them a ring of points for each height.
    const auto index = [=](std::size_t i, std::size_t j, std::size_t k) {
        if (k == 0) return j * (nx + 1) + i;
        if (k == nz) return layer + (nz - 1) * ring + j * (nx + 1) + i;
        const std::size_t start = layer + (k - 1) * ring;
        if (j == 0) return start + i;
        if (i == nx) return start + nx + j;
        if (j == ny) return start + nx + ny + (nx - i);
        return start + nx + ny + nx + (ny - j);
    };
    PolygonSoup soup;
    soup.points.resize(2 * layer + (nz - 1) * ring);
    for (std::size_t k = 0; k <= nz; ++k) {
        for (std::size_t j = 0; j <= ny; ++j) {
            const bool full_row = k == 0 || k == nz || j == 0 || j == ny;
            for (std::size_t i = 0; i <= nx; i += full_row ? 1 : nx) {
                soup.points[index(i, j, k)] = {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
            }
        }
    }
    const auto up = [](std::size_t, std::size_t) { return true; };
    add_grid(
        soup, {ny, nx}, [&](std::size_t a, std::size_t b) { return index(b, a, 0); }, up);
    add_grid(
        soup, {nx, ny}, [&](std::size_t a, std::size_t b) { return index(a, b, nz); }, up);
    add_grid(
        soup, {nx, nz}, [&](std::size_t a, std::size_t b) { return index(a, 0, b); }, up);
    add_grid(
        soup, {nz, nx}, [&](std::size_t a, std::size_t b) { return index(b, ny, a); }, up);
    add_grid(
        soup, {nz, ny}, [&](std::size_t a, std::size_t b) { return index(0, b, a); }, up);
    add_grid(
        soup, {ny, nz}, [&](std::size_t a, std::size_t b) { return index(nx, a, b); }, up);
    return soup;
}

}  // namespace delmesh::shapes
