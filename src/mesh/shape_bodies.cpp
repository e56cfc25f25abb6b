#include "mesh/shape_makers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace delmesh::shapes {

namespace {

double real(std::size_t i) {
    return static_cast<double>(i);
}

/// Places of about `count` parts, in rows.
class Places {
public:
    Places(std::size_t count, double spacing) : row_(grid_size(static_cast<double>(count)).nx), spacing_(spacing) {}
    [[nodiscard]] Vec3 operator()(std::size_t i) const { return Vec3{real(i % row_), real(i / row_), 0} * spacing_; }

private:
    std::size_t row_;
    double spacing_;
};

}  // namespace

PolygonSoup make_sheared_box(std::size_t faces, const Noise& /*noise*/) {
    const auto n = std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(std::sqrt(real(faces) / 12))));
    PolygonSoup soup = box_surface(n, n, n);
    // Integers stay integers, so the sides stay exactly planar.
    for (Vec3& p : soup.points) p = {p.x + 6 * p.y + 3 * p.z, p.y + 4 * p.z, p.z};
    return soup;
}

namespace {

constexpr std::size_t plate_tile = 5;

/// Which cells of the plate are solid: in each tile a hole through it at (1,1) and a block on top at (3,3).
struct PlatePlan {
    std::size_t nx;
    std::size_t ny;

    [[nodiscard]] bool solid(std::size_t i, std::size_t j, std::size_t k) const {
        if (i >= nx || j >= ny || k >= 2) return false;  // also below 0, by wrapping around
        const bool hole = i % plate_tile == 1 && j % plate_tile == 1;
        const bool block = i % plate_tile == 3 && j % plate_tile == 3;
        return k == 0 ? !hole : block;
    }
};

/// The outline of cells: uneven widths along an axis, in integers.
std::vector<double> uneven_steps(std::size_t count, const Noise& noise, std::uint64_t key) {
    constexpr std::array<double, 4> widths{1, 2, 6, 20};
    std::vector<double> at(count + 1, 0.0);
    for (std::size_t i = 0; i < count; ++i) at[i + 1] = at[i] + widths[noise.bits(key + i) % widths.size()];
    return at;
}

}  // namespace

PolygonSoup make_plate(std::size_t faces, const Noise& noise) {
    // A tile has 24 + 24 quads below and above, 4 in the hole's walls, 4 in the block's.
    const double tiles = std::max(1.0, (real(faces) / 2 - 4) / 56);
    const GridSize in_tiles = grid_size(tiles);
    const PlatePlan plan{in_tiles.nx * plate_tile, in_tiles.ny * plate_tile};
    const std::vector<double> xs = uneven_steps(plan.nx, noise, 0);
    const std::vector<double> ys = uneven_steps(plan.ny, noise, std::uint64_t{1} << 40U);
    const auto index = [&](std::size_t i, std::size_t j, std::size_t k) {
        return (k * (plan.ny + 1) + j) * (plan.nx + 1) + i;
    };
    PolygonSoup soup;
    soup.points.reserve(3 * (plan.nx + 1) * (plan.ny + 1));
    for (const double z : {0.0, 2.0, 5.0}) {
        for (std::size_t j = 0; j <= plan.ny; ++j) {
            // Sheared in integers: level sides stay exactly planar and their cells are slivers.
            for (std::size_t i = 0; i <= plan.nx; ++i) soup.points.push_back({xs[i] + 3 * ys[j], ys[j], z});
        }
    }
    for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t j = 0; j < plan.ny; ++j) {
            for (std::size_t i = 0; i < plan.nx; ++i) {
                if (!plan.solid(i, j, k)) continue;
                const auto at = [&](std::size_t x, std::size_t y, std::size_t z) { return index(i + x, j + y, k + z); };
                const auto side = [&](bool open, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
                    if (open) add_quad(soup, a, b, c, d, true);
                };
                side(!plan.solid(i, j, k - 1), at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
                side(!plan.solid(i, j, k + 1), at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
                side(!plan.solid(i, j - 1, k), at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
                side(!plan.solid(i, j + 1, k), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
                side(!plan.solid(i - 1, j, k), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
                side(!plan.solid(i + 1, j, k), at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
            }
        }
    }
    drop_unused_points(soup);
    return soup;
}

PolygonSoup make_washer(std::size_t faces, const Noise& /*noise*/) {
    // 4 inner sectors to 16 outer ones; each sector has one wall quad and a face in each of the two rings.
    const std::size_t inner = std::max<std::size_t>(4, faces / 20);
    const std::size_t outer = 4 * inner;
    PolygonSoup soup;
    soup.points.reserve(2 * (inner + outer));
    for (const double z : {0.0, 1.0}) {
        for (std::size_t i = 0; i < outer; ++i) {
            const CosSin t = turn(i, outer);
            soup.points.push_back({t.cos, t.sin, z});
        }
        for (std::size_t i = 0; i < inner; ++i) {
            const CosSin t = turn(i, inner);
            soup.points.push_back({0.5 * t.cos, 0.5 * t.sin, z});
        }
    }
    const std::size_t layer = inner + outer;
    const auto rim = [=](std::size_t i, std::size_t top) { return top * layer + i % outer; };
    const auto hole = [=](std::size_t i, std::size_t top) { return top * layer + outer + i % inner; };
    for (std::size_t i = 0; i < outer; ++i) add_quad(soup, rim(i, 0), rim(i + 1, 0), rim(i + 1, 1), rim(i, 1), true);
    for (std::size_t i = 0; i < inner; ++i) {
        add_quad(soup, hole(i, 0), hole(i, 1), hole(i + 1, 1), hole(i + 1, 0), true);
    }
    // The rings' triangles lean by about an eighth of a turn, as careless triangulators leave them.
    const std::size_t lean = outer / 8;
    for (std::size_t i = 0; i < inner; ++i) {
        for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) {
            add_triangle(soup, hole(i, 0), rim(k + lean + 1, 0), rim(k + lean, 0));
            add_triangle(soup, hole(i, 1), rim(k + lean, 1), rim(k + lean + 1, 1));
        }
        add_triangle(soup, hole(i, 0), hole(i + 1, 0), rim(4 * i + 4 + lean, 0));
        add_triangle(soup, hole(i, 1), rim(4 * i + 4 + lean, 1), hole(i + 1, 1));
    }
    return soup;
}

PolygonSoup make_spikes(std::size_t faces, const Noise& /*noise*/) {
    const GridSize size = grid_size(real(faces) / 4);
    const auto point = [](std::size_t i, std::size_t j) { return Vec3{real(i), real(j), 0}; };
    PolygonSoup soup = make_patch(size, point, [](std::size_t, std::size_t) { return false; });
    // The first triangle of each cell becomes a tall spike that leans away from its right angle. The edge from there
    // to the tip sees two angles just over pi/2, and its flip would join two vertices that are joined already.
    std::vector<std::uint32_t> corners;
    corners.reserve(2 * soup.corners.size());
    corners.swap(soup.corners);
    for (std::size_t cell = 0; cell < size.nx * size.ny; ++cell) {
        const std::uint32_t* c = corners.data() + 6 * cell;
        const std::size_t tip = soup.points.size();
        soup.points.push_back(soup.points[c[0]] + Vec3{1.25, 1.25, 6});
        for (std::size_t k = 0; k < 3; ++k) add_triangle(soup, c[k], c[(k + 1) % 3], tip);
        add_triangle(soup, c[3], c[4], c[5]);
    }
    return soup;
}

PolygonSoup make_thin_helix(std::size_t faces, const Noise& /*noise*/) {
    // A chain of tetrahedra (Boerdijk, Coxeter), stretched: vertex i is joined to i+1, i+2, i+3. Each edge (i, i+3)
    // sees two angles near pi, and its flip would join i+1 and i+2, which are joined already.
    const std::size_t tets = std::max<std::size_t>(1, faces / 2);
    constexpr double radius = 0.52;
    constexpr double step = 4;
    PolygonSoup soup;
    soup.points.reserve(tets + 3);
    for (std::size_t i = 0; i < tets + 3; ++i) {
        const CosSin t = turn(4 * i, 11);
        soup.points.push_back({step * real(i), radius * t.cos, radius * t.sin});
    }
    soup.corners.reserve(6 * tets + 6);
    add_triangle(soup, 0, 2, 1);
    for (std::size_t i = 0; i < tets; ++i) {
        add_triangle(soup, i, i + 1, i + 3);
        add_triangle(soup, i, i + 3, i + 2);
    }
    add_triangle(soup, tets, tets + 1, tets + 2);
    return soup;
}

PolygonSoup make_flat_tets(std::size_t faces, const Noise& noise) {
    const std::size_t count = std::max<std::size_t>(1, faces / 4);
    const Places place(count, 4);
    PolygonSoup soup;
    soup.points.reserve(4 * count);
    soup.corners.reserve(12 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const double thickness = std::ldexp(1.0, -static_cast<int>(noise.bits(i) % 30));
        // A kite with a lifted diagonal, or a triangle with a lifted point inside: one or two edges that see more than
        // pi, and no edge of a tetrahedron can be flipped.
        const bool kite = i % 2 == 0;
        const std::array<Vec3, 4> corners =
            kite ? std::array<Vec3, 4>{{{0, 0, 0}, {2, 0, 0}, {1, 0.75, thickness}, {1, -0.5, thickness}}}
                 : std::array<Vec3, 4>{{{0, 0, 0}, {2, 0, 0}, {1, 1.5, 0}, {1, 0.25, -thickness}}};
        for (const Vec3& p : corners) soup.points.push_back(p + place(i));
        const std::size_t v = 4 * i;
        for (const auto& [a, b, c] :
             std::array<std::array<std::size_t, 3>, 4>{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}) {
            add_triangle(soup, v + a, v + (kite ? b : c), v + (kite ? c : b));
        }
    }
    return soup;
}

PolygonSoup make_needle_fans(std::size_t faces, const Noise& noise) {
    // Rays at 1/4, 1/8, ... 2^-32 turns from the first one: the last angle is about 1e-9.
    constexpr std::size_t rays = 32;
    const std::size_t count = std::max<std::size_t>(1, (faces + rays / 2) / (rays - 1));
    const Places place(count, 4);
    PolygonSoup soup;
    soup.points.reserve((rays + 1) * count);
    soup.corners.reserve(3 * (rays - 1) * count);
    for (std::size_t i = 0; i < count; ++i) {
        const bool folded = i % 2 == 1;
        const std::size_t hub = soup.points.size();
        soup.points.push_back(place(i));
        for (std::size_t ray = 0; ray < rays; ++ray) {
            const CosSin t = turn(std::uint64_t{1} << ray, std::uint64_t{1} << 33U);
            const double length = 1 + 0.25 * static_cast<double>(ray % 2);
            const double height = folded ? 0.1 * noise.value(i * rays + ray) : 0.0;
            soup.points.push_back(place(i) + Vec3{length * t.cos, length * t.sin, height});
            if (ray > 0) add_triangle(soup, hub, hub + ray, hub + ray + 1);
        }
    }
    return soup;
}

PolygonSoup make_many_parts(std::size_t faces, const Noise& noise) {
    const std::array<PolygonSoup, 5> parts{make_noisy_sphere(180, noise), make_torus(200, noise),
                                           make_sheared_box(108, noise), make_terrain(128, noise),
                                           make_flat_tets(4, noise)};
    constexpr std::size_t mean_size = 120;
    const Places place(faces / mean_size + 1, 4);
    PolygonSoup soup;
    for (std::size_t i = 0; i == 0 || soup.face_count() + mean_size / 2 < faces; ++i) {
        const bool box = i % parts.size() == 2;
        // Large and small parts lie 2^10 apart; powers of two keep every shape exactly.
        const double scale = std::ldexp(1.0, -static_cast<int>(noise.bits(i) % 11) - (box ? 5 : 0));
        append(soup, parts[i % parts.size()], place(i), scale);
    }
    return soup;
}

}  // namespace delmesh::shapes
