#pragma once
// An independent judge of the exact signs: rationals, and formulas other than those of src/exact.
// Slow on purpose: nothing here is shared with the library.

#include "delmesh/base/vec3.hpp"
#include "delmesh/exact/sign.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace delmesh::reference {

using Integer = boost::multiprecision::cpp_int;
using Point = std::array<Integer, 3>;

inline Sign sign_of(const Integer& value) {
    return value < 0 ? Sign::negative : value > 0 ? Sign::positive : Sign::zero;
}

/// All points in units of the finest last place among their coordinates (by frexp and ldexp; the library reads bits).
inline std::vector<Point> to_integers(const std::vector<Vec3>& points) {
    int finest = 2000;
    for (const Vec3& point : points)
        for (int axis = 0; axis < 3; ++axis) {
            int exponent = 0;
            if (std::frexp(point[axis], &exponent) != 0) finest = std::min(finest, exponent - 53);
        }
    std::vector<Point> result;
    for (const Vec3& point : points) {
        Point integers;
        for (int axis = 0; axis < 3; ++axis) {
            int exponent = 0;
            const double fraction = std::frexp(point[axis], &exponent);
            integers[axis] = static_cast<long long>(std::ldexp(fraction, 53));
            if (fraction != 0) integers[axis] *= boost::multiprecision::pow(Integer(2), exponent - 53 - finest);
        }
        result.push_back(integers);
    }
    return result;
}

inline Point minus(const Point& a, const Point& b) {
    return {Integer(a[0] - b[0]), Integer(a[1] - b[1]), Integer(a[2] - b[2])};
}
inline Integer inner(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point outer(const Point& a, const Point& b) {
    return {Integer(a[1] * b[2] - a[2] * b[1]), Integer(a[2] * b[0] - a[0] * b[2]), Integer(a[0] * b[1] - a[1] * b[0])};
}

/// The sign of x sqrt(m) + y sqrt(n) for m, n >= 0.
inline Sign sign_of_root_sum(const Integer& x, const Integer& m, const Integer& y, const Integer& n) {
    const Integer first = x * abs(x) * m, second = y * abs(y) * n;
    return sign_of(Integer(first + second));
}

/// From cot = cosine / sine: sign(D1 |c x d| + D2 |a x b|); where a sine is zero, from the limit angles 0 and pi.
inline Sign delaunay(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v) {
    const auto i = to_integers({p, q, u, v});
    const Point a = minus(i[0], i[2]), b = minus(i[1], i[2]), c = minus(i[0], i[3]), d = minus(i[1], i[3]);
    const Point n1 = outer(a, b), n2 = outer(c, d);
    const Integer area1 = inner(n1, n1), area2 = inner(n2, n2), d1 = inner(a, b), d2 = inner(c, d);
    if (area1 == 0 && area2 == 0)
        return d1 < 0 && d2 < 0 ? Sign::negative : d1 > 0 && d2 > 0 ? Sign::positive : Sign::zero;
    if (area1 == 0) return sign_of(d1);  // 0 or pi against an angle strictly between
    if (area2 == 0) return sign_of(d2);
    return sign_of_root_sum(d1, area2, d2, area1);
}

/// By Pythagoras: |p-u|^2 + |q-u|^2 - |p-q|^2.
inline Sign right_angle(const Vec3& p, const Vec3& q, const Vec3& u) {
    const auto i = to_integers({p, q, u});
    const Point a = minus(i[0], i[2]), b = minus(i[1], i[2]), e = minus(i[0], i[1]);
    return sign_of(Integer(inner(a, a) + inner(b, b) - inner(e, e)));
}

/// The 4 by 4 determinant with a column of ones, by minors along it (no differences).
inline Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto i = to_integers({a, b, c, d});
    const auto triple = [&](int j, int k, int l) { return inner(i[j], outer(i[k], i[l])); };
    return sign_of(Integer(triple(1, 2, 3) - triple(0, 2, 3) + triple(0, 1, 3) - triple(0, 1, 2)));
}

/// Cauchy and Schwarz with equality: (a.b)^2 = |a|^2 |b|^2.
inline bool collinear(const Vec3& p, const Vec3& q, const Vec3& r) {
    const auto i = to_integers({p, q, r});
    const Point a = minus(i[1], i[0]), b = minus(i[2], i[0]);
    return inner(a, b) * inner(a, b) == inner(a, a) * inner(b, b);
}

/// With the two normals themselves: sign(n1.n2 * 1 - cosine sqrt(|n1|^2 |n2|^2)).
inline Sign dihedral(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, double cosine) {
    const auto i = to_integers({p, q, u, v});
    const Point n1 = outer(minus(i[1], i[0]), minus(i[2], i[0])), n2 = outer(minus(i[0], i[1]), minus(i[3], i[1]));
    const Integer area1 = inner(n1, n1), area2 = inner(n2, n2);
    if (area1 == 0 || area2 == 0) return Sign::zero;
    int exponent = 0;
    const auto mantissa = static_cast<long long>(std::ldexp(std::frexp(cosine, &exponent), 53));
    const unsigned shift = mantissa == 0 ? 0 : static_cast<unsigned>(53 - exponent);  // cosine = mantissa / 2^shift
    return sign_of_root_sum(Integer(inner(n1, n2) << shift), 1, Integer(-mantissa), Integer(area1 * area2));
}

inline bool planar_edge(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v) {
    const auto i = to_integers({p, q, u, v});
    const Point n1 = outer(minus(i[1], i[0]), minus(i[2], i[0])), n2 = outer(minus(i[0], i[1]), minus(i[3], i[1]));
    return outer(n1, n2) == Point{0, 0, 0} && inner(n1, n2) > 0 && reference::orientation(p, q, u, v) == Sign::zero;
}

}  // namespace delmesh::reference
