#pragma once
// Families of quadrilaterals p, q, u, v (the edge pq between the apexes u and v), near the places where signs change.

#include "delmesh/base/vec3.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <vector>

namespace delmesh::families {

/// Draws as all tests do, and what only the predicates want.
class Random : public test::Random {
public:
    using test::Random::Random;

    /// Uniform in [-1, 1).
    double symmetric() { return static_cast<double>(static_cast<std::int64_t>(bits())) * 0x1p-63; }
    Vec3 point() {
        const double x = symmetric(), y = symmetric(), z = symmetric();
        return {x, y, z};
    }
    /// Any finite double: random bits.
    double any_double() {
        for (;;)
            if (const double x = std::bit_cast<double>(bits()); std::isfinite(x)) return x;
    }
};

struct Quad {
    Vec3 p, q, u, v;

    /// All bits, for messages.
    friend std::ostream& operator<<(std::ostream& out, const Quad& quad) {
        for (const Vec3& a : {quad.p, quad.q, quad.u, quad.v})
            out << std::hexfloat << "{" << a.x << ", " << a.y << ", " << a.z << "} ";
        return out;
    }
};

/// Moves one coordinate of one point by one unit in the last place or not at all.
inline Quad nudged(Quad quad, Random& random) {
    std::array<Vec3*, 4> points{&quad.p, &quad.q, &quad.u, &quad.v};
    double& x = (*points[static_cast<std::size_t>(random.below(4))])[random.below(3)];
    const int step = random.below(3) - 1;
    if (step != 0) x = std::nextafter(x, step * std::numeric_limits<double>::infinity());
    return quad;
}

template <class Function>
Quad mapped(const Quad& quad, Function f) {
    return {f(quad.p), f(quad.q), f(quad.u), f(quad.v)};
}

inline Quad scaled(const Quad& quad, int exponent) {
    return mapped(quad, [=](const Vec3& a) {
        return Vec3{std::ldexp(a.x, exponent), std::ldexp(a.y, exponent), std::ldexp(a.z, exponent)};
    });
}

inline Quad generic(Random& random) {
    const Vec3 p = random.point(), q = random.point(), u = random.point(), v = random.point();
    return {p, q, u, v};
}

/// Small integer points: zero signs abound.
inline Quad integer_grid(Random& random) {
    const auto point = [&] {
        const int x = random.below(5), y = random.below(5), z = random.below(2);
        return Vec3{1.0 * x, 1.0 * y, 1.0 * z};
    };
    Quad quad{point(), point(), point(), point()};
    while (quad.u == quad.p || quad.u == quad.q) quad.u = point();
    while (quad.v == quad.p || quad.v == quad.q) quad.v = point();
    return quad;
}

/// A rotation about a random axis, rounded; from a random unit quaternion.
class Rotation {
public:
    explicit Rotation(Random& random) {
        double norm = 0;
        for (double& x : quaternion_) {
            x = random.symmetric();
            norm += x * x;
        }
        for (double& x : quaternion_) x /= std::sqrt(norm);
    }
    Vec3 operator()(const Vec3& a) const {
        const Vec3 axis{quaternion_[1], quaternion_[2], quaternion_[3]};
        const Vec3 t = 2.0 * cross(axis, a);
        return a + quaternion_[0] * t + cross(axis, t);
    }

private:
    std::array<double, 4> quaternion_{};
};

/// Four points of the unit circle by rational parameters, u and v on the two arcs between p and q; rotated, rounded.
inline Quad circle(Random& random, double offset = 0) {
    const auto at = [](double t) { return Vec3{(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t), 0}; };
    const Rotation rotation(random);
    const Vec3 centre = offset * random.point();
    const double s = std::fabs(random.symmetric());
    const Quad flat{at(0), at(1 / s), at(s * std::fabs(random.symmetric())),
                    at(-1 - 4 * std::fabs(random.symmetric()))};
    return mapped(flat, [&](const Vec3& a) { return rotation(a) + centre; });
}

/// The two faces of a circle quad folded about pq: the angles, not the plane, are what counts.
inline Quad folded_circle(Random& random) {
    Quad quad = circle(random);
    const Vec3 e = quad.q - quad.p;
    const double t = dot(quad.v - quad.p, e) / dot(e, e);
    const Vec3 foot = quad.p + t * e, arm = quad.v - foot, side = cross(e, arm) * (1 / std::sqrt(dot(e, e)));
    const double s = random.symmetric(), c = std::sqrt(1 - s * s);
    quad.v = foot + c * arm + s * side;
    return quad;
}

/// A cell of a grid of right angles, in a plane that slopes: D1 and D2 nearly zero.
inline Quad sloping_grid_cell(Random& random, bool axis_parallel = false) {
    const double i = random.below(100), j = random.below(100), h = 1 + 0.01 * random.below(20);
    const auto node = [&](double x, double y) { return Vec3{x / 10.0, y / 10.0 * h, 0}; };
    const Quad flat{node(i, j), node(i + 1, j + 1), node(i + 1, j), node(i, j + 1)};
    const Rotation rotation(random);
    return axis_parallel ? flat : mapped(flat, rotation);
}

/// Maps the xy-plane to a plane in general position, exactly: the rows are orthogonal and of length 9.
inline Vec3 tilted(const Vec3& a) {
    return {a.x * 1 + a.y * 2 + a.z * 2, a.x * 2 + a.y * 1 - a.z * 2, a.x * 2 - a.y * 2 + a.z * 1};
}

/// Four integer points of the circle x^2 + y^2 = 1105^2, which has 108 of them, in a tilted plane: exactly co-circular,
/// coplanar, u and v on different sides of pq.
inline Quad integer_circle(Random& random) {
    static const std::vector<Vec3> points = [] {
        std::vector<Vec3> found;
        const auto add_row = [&](int y, int sign) {
            const int x = static_cast<int>(std::lround(std::sqrt(1105.0 * 1105 - 1.0 * y * y)));
            if (x * x + y * y == 1105 * 1105 && (sign > 0 || x != 0)) found.push_back({1.0 * sign * x, 1.0 * y, 0});
        };
        for (int y = 1105; y >= -1105; --y) add_row(y, 1);   // clockwise from the top,
        for (int y = -1105; y <= 1105; ++y) add_row(y, -1);  // and up again on the left
        return found;
    }();
    const int n = static_cast<int>(points.size());
    std::array<int, 4> i{};
    do {
        for (int& k : i) k = random.below(n);
        std::sort(i.begin(), i.end());
    } while (std::adjacent_find(i.begin(), i.end()) != i.end());
    const auto at = [&](int k) { return points[static_cast<std::size_t>(i[static_cast<std::size_t>(k)])]; };
    return mapped(Quad{at(0), at(2), at(1), at(3)}, tilted);
}

/// Chords that cross at the origin with |p||q| = |u||v|: exactly co-circular, then v is turned about pq by the angle of
/// the triangle 3, 4, 5, which keeps the angle at v. Not coplanar.
inline Quad folded_kite(Random& random) {
    const double s = 1 + random.below(5000), t = 1 + random.below(5000);
    const double n = -t * t;
    return mapped(Quad{{-5 * s * t, 0, 0}, {5 * s * t, 0, 0}, {0, 5 * s * s, 0}, {0, 3 * n, 4 * n}}, tilted);
}

/// p and q opposite on a sphere, u and v on it as well: two right angles (Thales), D1 = D2 = 0.
inline Quad thales(Random& random) {
    const auto on_sphere = [&] {  // permutations of (1, 2, 2) and (0, 0, 3) with signs
        const int axis = random.below(3);
        const bool pole = random.below(4) == 0;
        Vec3 a;
        for (int k = 0; k < 3; ++k)
            a[k] = (random.below(2) == 0 ? 1 : -1) * (pole ? (k == axis ? 3 : 0) : k == axis ? 1 : 2);
        return a;
    };
    const Vec3 p = on_sphere();
    Vec3 u = on_sphere(), v = on_sphere();
    while (u == p || u == -p) u = on_sphere();
    while (v == p || v == -p) v = on_sphere();
    const double size = 1 + random.below(1 << 20);
    return mapped(Quad{p, -p, u, v}, [=](const Vec3& a) { return size * tilted(a); });
}

/// Apexes far away or close to the line pq: angles near 0 and near pi.
inline Quad needle(Random& random) {
    Quad quad = circle(random);
    const double thin = std::ldexp(1.0, -random.below(60));
    const auto squash = [&](const Vec3& a) { return Vec3{a.x, a.y * thin, a.z * thin}; };
    return mapped(quad, squash);
}

/// Faces of no area (u or v on the line pq): the angles are 0, 0, pi.
inline Quad cap(Random& random) {
    const auto lattice = [&] {
        const int x = random.below(9) - 4, y = random.below(9) - 4, z = random.below(9) - 4;
        return Vec3{1.0 * x, 1.0 * y, 1.0 * z};
    };
    const Vec3 p = lattice();
    Vec3 step = lattice();
    while (step == Vec3{}) step = lattice();
    const int length = 2 + random.below(5);
    const auto on_line = [&] {
        int k = random.below(12) - 4;
        while (k == 0 || k == length) k = random.below(12) - 4;
        return p + static_cast<double>(k) * step;
    };
    Quad quad{p, p + static_cast<double>(length) * step, on_line(), random.below(2) == 0 ? on_line() : lattice()};
    while (quad.v == quad.p || quad.v == quad.q) quad.v = lattice();
    return quad;
}

/// Any finite doubles at all, from denormals to 1e+308.
inline Quad any_bits(Random& random) {
    const auto point = [&] {
        const double x = random.any_double(), y = random.any_double(), z = random.any_double();
        return Vec3{x, y, z};
    };
    const Vec3 p = point(), q = point(), u = point(), v = point();
    return {p, q, u, v};
}

/// Each coordinate is that of a small grid times one of a few powers of ten that lie far apart.
inline Quad mixed_scales(Random& random) {
    Quad quad = integer_grid(random);
    const std::array<double, 6> scales{1e-300, 5e-320, 1e300, 1e-160, 1, 1e150};
    const double sx = scales[static_cast<std::size_t>(random.below(6))],
                 sy = scales[static_cast<std::size_t>(random.below(6))];
    const double sz = scales[static_cast<std::size_t>(random.below(6))];
    return mapped(quad, [=](const Vec3& a) { return Vec3{a.x * sx, a.y * sy, a.z * sz}; });
}

/// Of all families with moderate exponents, `count` each and nudged.
inline std::vector<Quad> mixed_bag(int count) {
    Random random(30);
    std::vector<Quad> quads;
    for (int i = 0; i < count; ++i)
        for (const Quad& quad : {generic(random), integer_grid(random), circle(random), integer_circle(random),
                                 folded_circle(random), sloping_grid_cell(random), needle(random), cap(random)})
            quads.push_back(nudged(quad, random));
    return quads;
}

}  // namespace delmesh::families
