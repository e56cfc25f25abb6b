#include "support/families.hpp"

#include "delmesh/mesh/shapes.hpp"
#include "support/random.hpp"

#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <utility>

namespace delmesh::test {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

PolygonSoup make(std::vector<Vec3> points, std::initializer_list<Triangle> faces) {
    PolygonSoup soup;
    soup.points = std::move(points);
    for (const Triangle& f : faces) soup.corners.insert(soup.corners.end(), f.begin(), f.end());
    return soup;
}

void add(PolygonSoup& soup, std::size_t a, std::size_t b, std::size_t c) {
    for (const std::size_t v : {a, b, c}) soup.corners.push_back(static_cast<std::uint32_t>(v));
}

double real(std::size_t i) {
    return static_cast<double>(i);
}

/// Heights 0 ... levels-1 on the integer grid, cells cut at random: many coplanar and co-circular edges.
PolygonSoup integer_height_field(std::size_t n, std::size_t levels, std::uint64_t seed) {
    Random random(seed);
    PolygonSoup soup;
    for (std::size_t j = 0; j <= n; ++j) {
        for (std::size_t i = 0; i <= n; ++i) soup.points.push_back({real(i), real(j), real(random.below(levels))});
    }
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t a = j * (n + 1) + i;
            const std::size_t d = a + n + 1;
            if (random.below(2) == 0) {
                add(soup, a, a + 1, d);
                add(soup, a + 1, d + 1, d);
            } else {
                add(soup, a, a + 1, d + 1);
                add(soup, a, d + 1, d);
            }
        }
    }
    return soup;
}

/// A chain of caps between a triangle above and a fan below; `sag` is the height of the caps (0: no area).
PolygonSoup cap_chain(std::size_t n, double sag) {
    PolygonSoup soup;
    for (std::size_t i = 0; i <= n; ++i) {
        const double t = real(i) / real(n);
        soup.points.push_back({real(i), -4 * sag * t * (1 - t), 0});
    }
    const std::size_t top = n + 1;
    const std::size_t bottom = n + 2;
    soup.points.push_back({0.5 * real(n), 4, 0});
    soup.points.push_back({0.5 * real(n), -4, 1});
    add(soup, 0, n, top);
    for (std::size_t i = 0; i + 1 < n; ++i) add(soup, i, i + 1, n);
    for (std::size_t i = 0; i < n; ++i) add(soup, i, bottom, i + 1);
    return soup;
}

/// Rim points on an integer "circle" (a convex octagon walked in steps), so that bits do not depend on libm.
Vec3 rim_point(std::size_t i, std::size_t n, double z) {
    const double t = 4 * real(i) / real(n);
    const double s = t - std::floor(t);
    const double c = (1 - s * s) / (1 + s * s);
    const double d = 2 * s / (1 + s * s);
    switch (static_cast<int>(t)) {
        case 0:
            return {c, d, z};
        case 1:
            return {-d, c, z};
        case 2:
            return {-c, -d, z};
        default:
            return {d, -c, z};
    }
}

/// An open cone, or with two tips a closed double cone.
PolygonSoup cone(std::size_t n, double height, bool closed) {
    PolygonSoup soup;
    for (std::size_t i = 0; i < n; ++i) soup.points.push_back(rim_point(i, n, 0));
    soup.points.push_back({0.125, 0.25, height});
    if (closed) soup.points.push_back({0, 0, -height});
    for (std::size_t i = 0; i < n; ++i) {
        add(soup, i, (i + 1) % n, n);
        if (closed) add(soup, (i + 1) % n, i, n + 1);
    }
    return soup;
}

/// Two sheets over a hexagon, cut along different diagonals and joined at the rim: coplanar faces that fold over.
PolygonSoup pillow(double thickness) {
    std::vector<Vec3> points{{2, 0, 0}, {1, 2, 0}, {-1, 2, thickness}, {-2, 0, 0}, {-1, -2, 0}, {1, -2, thickness}};
    return make(std::move(points),
                {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {1, 0, 5}, {3, 2, 1}, {5, 4, 3}, {1, 5, 3}});
}

/// A strip of triangles whose smallest angles fall down to about `angle`.
PolygonSoup needle_strip(std::size_t n, double angle) {
    PolygonSoup soup;
    double y = 0;
    for (std::size_t i = 0; i <= n; ++i) {
        soup.points.push_back({0, y, 0});
        soup.points.push_back({1, y + 0.3 * angle, i % 3 == 0 ? 0.01 : 0.0});
        y += i % 2 == 0 ? angle : 100 * angle;
    }
    for (std::size_t i = 0; i < n; ++i) {
        add(soup, 2 * i, 2 * i + 1, 2 * i + 2);
        add(soup, 2 * i + 1, 2 * i + 3, 2 * i + 2);
    }
    return soup;
}

PolygonSoup moved(PolygonSoup soup, double scale, Vec3 offset) {
    for (Vec3& p : soup.points) p = p * scale + offset;
    return soup;
}

PolygonSoup shaken(std::size_t faces, std::uint64_t seed) {
    PolygonSoup soup = make_sample("icosphere", faces);
    flip_at_random(soup, soup.face_count(), seed);
    return soup;
}

/// Unit cube, each side cut in two: co-circular diagonals, right angles everywhere.
PolygonSoup cube() {
    return make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, {{0, 2, 1},
                                                                                                           {0, 3, 2},
                                                                                                           {4, 5, 6},
                                                                                                           {4, 6, 7},
                                                                                                           {0, 1, 5},
                                                                                                           {0, 5, 4},
                                                                                                           {2, 3, 7},
                                                                                                           {2, 7, 6},
                                                                                                           {1, 2, 6},
                                                                                                           {1, 6, 5},
                                                                                                           {3, 0, 4},
                                                                                                           {3, 4, 7}});
}

PolygonSoup tetrahedron() {
    return make({{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

PolygonSoup with_isolated_points() {
    PolygonSoup soup = integer_height_field(3, 3, 5);
    for (std::uint32_t& v : soup.corners) v += 2;
    soup.points.insert(soup.points.begin(), 2, Vec3{1e6, -1e6, 3});
    soup.points.push_back({-7, 8, 9});
    return soup;
}

void add_samples(std::vector<NamedSoup>& all, std::size_t faces) {
    for (const SampleInfo& sample : samples()) {
        all.push_back({std::string(sample.name), make_sample(sample.name, faces)});
    }
    for (const std::string_view name : {"noisy-surface", "plate", "jittered-grid", "spikes"}) {
        all.push_back({std::string(name) + "-small", make_sample(name, faces / 8, 7)});
    }
}

void add_extreme_scales(std::vector<NamedSoup>& all) {
    const PolygonSoup base = make_sample("noisy-surface", 80, 3);
    for (const int exponent : {-1000, -500, 500, 1000}) {
        all.push_back(
            {"scaled-by-2^" + std::to_string(exponent), moved(base, std::ldexp(1.0, exponent), {}), false, true});
    }
    // Denormal coordinates: multiples of 2^-1074.
    all.push_back({"denormal-cube", moved(cube(), 0x1p-1070, {}), false, true});
    all.push_back({"far-away", moved(make_sample("noisy-surface", 80, 4), 1, {0x1p30, -0x1p31, 0x1p29})});
}

}  // namespace

void flip_at_random(PolygonSoup& soup, std::size_t count, std::uint64_t seed) {
    // From each directed edge to its corner; corners are rewritten in place.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> corner_of;
    const auto next = [](std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
    const auto record = [&](std::size_t face) {
        for (std::size_t c = 3 * face; c < 3 * face + 3; ++c) {
            corner_of[{soup.corners[c], soup.corners[next(c)]}] = c;
        }
    };
    for (std::size_t f = 0; f < soup.face_count(); ++f) record(f);
    Random random(seed);
    for (std::size_t done = 0; done < count; ++done) {
        const std::size_t corner = random.below(soup.corners.size());
        const std::uint32_t a = soup.corners[corner];
        const std::uint32_t b = soup.corners[next(corner)];
        const auto twin = corner_of.find({b, a});
        if (twin == corner_of.end()) continue;
        const std::size_t other = twin->second;
        const std::uint32_t u = soup.corners[next(next(corner))];
        const std::uint32_t v = soup.corners[next(next(other))];
        if (u == v || corner_of.contains({u, v}) || corner_of.contains({v, u})) continue;
        corner_of.erase({a, b});
        corner_of.erase({b, a});
        const Triangle first{u, a, v};
        const Triangle second{v, b, u};
        for (std::size_t k = 0; k < 3; ++k) {
            soup.corners[corner / 3 * 3 + k] = first[k];
            soup.corners[other / 3 * 3 + k] = second[k];
        }
        record(corner / 3);
        record(other / 3);
    }
}

std::vector<NamedSoup> families(std::size_t faces) {
    std::vector<NamedSoup> all;
    add_samples(all, faces);
    all.push_back({"acute-triangle", make({{0, 0, 0}, {4, 0, 0}, {2, 3, 1}}, {{0, 1, 2}})});
    all.push_back({"right-triangle", make({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, {{0, 1, 2}})});
    all.push_back({"obtuse-triangle", make({{0, 0, 0}, {9, 0, 0}, {4, 1, 0}}, {{0, 1, 2}})});
    all.push_back({"double-covered-acute-triangle", make({{0, 0, 0}, {4, 0, 0}, {2, 3, 0}}, {{0, 1, 2}, {0, 2, 1}})});
    all.push_back({"double-covered-obtuse-triangle", make({{0, 0, 0}, {9, 0, 0}, {4, 1, 0}}, {{0, 1, 2}, {0, 2, 1}})});
    all.push_back({"tetrahedron", tetrahedron()});
    all.push_back({"cube", cube()});
    all.push_back({"pillow", pillow(0)});
    all.push_back({"thin-pillow", pillow(1e-6)});
    all.push_back({"integer-height-field-2", integer_height_field(9, 2, 1)});
    all.push_back({"integer-height-field-4", integer_height_field(9, 4, 2)});
    all.push_back({"integer-height-field-flat", integer_height_field(9, 1, 3)});
    all.push_back({"isolated-points", with_isolated_points()});
    all.push_back({"shaken-sphere", shaken(180, 11)});
    all.push_back({"shaken-sphere-large", shaken(500, 12)});
    all.push_back({"cap-chain", cap_chain(8, 1e-3)});
    all.push_back({"cap-chain-thin", cap_chain(8, 1e-9)});
    all.push_back({"cap-chain-zero-area", cap_chain(8, 0), true});
    all.push_back({"cone", cone(50, 0.5, false)});
    all.push_back({"cone-tall", cone(60, 20, false)});
    all.push_back({"double-cone", cone(40, 1, true)});
    all.push_back({"double-cone-flat", cone(40, 1e-3, true)});
    all.push_back({"needle-strip-1e-3", needle_strip(12, 1e-3)});
    all.push_back({"needle-strip-1e-6", needle_strip(8, 1e-6)});
    all.push_back({"needle-strip-1e-9", needle_strip(6, 1e-9)});
    add_extreme_scales(all);
    return all;
}

}  // namespace delmesh::test
