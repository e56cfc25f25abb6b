#pragma once
// The exact formulas, each written once for every kind of integer: the words of tier 2 (wide.hpp) and the big integers
// of tier 3. A product has the type that holds it, so a formula's type says how wide it gets.

#include "delmesh/exact/sign.hpp"

namespace delmesh::exact {

template <class Integer>
Sign sign_of(const Integer& value) {
    return static_cast<Sign>(value.sign());
}

template <class Integer>
auto square(const Integer& value) {
    return value * value;
}

/// A difference of two points, in integers.
template <class Integer>
struct Difference {
    Integer x, y, z;

    friend Difference operator-(const Difference& a, const Difference& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
};

template <class Integer>
auto dot(const Difference<Integer>& a, const Difference<Integer>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Integer>
auto squared_length(const Difference<Integer>& a) {
    return square(a.x) + square(a.y) + square(a.z);
}

/// See filter.hpp for the formula; needs degree 8 only where D1 and D2 have opposite signs.
template <class Integer>
Sign delaunay_polynomial(const Difference<Integer>& a, const Difference<Integer>& b, const Difference<Integer>& c,
                         const Difference<Integer>& d) {
    const auto d1 = dot(a, b), d2 = dot(c, d);
    const Sign s1 = sign_of(d1), s2 = sign_of(d2);
    if (s1 == s2 || s2 == Sign::zero) return s1;
    if (s1 == Sign::zero) return s2;
    return s1 * sign_of(square(d1) * (squared_length(c) * squared_length(d)) -
                        square(d2) * (squared_length(a) * squared_length(b)));
}

template <class Integer>
Sign orientation_polynomial(const Difference<Integer>& a, const Difference<Integer>& b, const Difference<Integer>& c) {
    return sign_of((b.y * c.z - b.z * c.y) * a.x + (b.z * c.x - b.x * c.z) * a.y + (b.x * c.y - b.y * c.x) * a.z);
}

template <class Integer>
bool are_parallel(const Difference<Integer>& a, const Difference<Integer>& b) {
    const auto same = [](const auto& s, const auto& t) { return sign_of(s - t) == Sign::zero; };
    return same(a.x * b.y, a.y * b.x) && same(a.y * b.z, a.z * b.y) && same(a.z * b.x, a.x * b.z);
}

/// n1.n2 with n1 = e x a, n2 = c x e: dot products only, by the identity of Binet and Cauchy.
template <class Integer>
auto dot_of_normals(const Difference<Integer>& e, const Difference<Integer>& a, const Difference<Integer>& c) {
    return dot(e, c) * dot(e, a) - squared_length(e) * dot(a, c);
}

/// |e x a|^2, by the identity of Lagrange.
template <class Integer>
auto squared_normal(const Difference<Integer>& e, const Difference<Integer>& a) {
    return squared_length(e) * squared_length(a) - square(dot(e, a));
}

/// The sign of n1.n2 - cosine |n1||n2| for such normals, where cosine^2 = numerator / denominator (neither negative)
/// and `s` is the sign of the cosine; zero where a normal vanishes.
template <class Integer, class Ratio>
Sign dihedral_polynomial(const Difference<Integer>& e, const Difference<Integer>& a, const Difference<Integer>& c,
                         Sign s, const Ratio& numerator, const Ratio& denominator) {
    const auto g = dot_of_normals(e, a, c);
    if (s == Sign::zero) return sign_of(g);
    const auto n1 = squared_normal(e, a), n2 = squared_normal(e, c);
    if (sign_of(n1) == Sign::zero || sign_of(n2) == Sign::zero) return Sign::zero;
    if (sign_of(g) != s) return sign_of(g) == Sign::zero ? -s : sign_of(g);
    return s * sign_of(square(g) * denominator - (n1 * n2) * numerator);
}

template <class Integer>
bool is_planar_edge_polynomial(const Difference<Integer>& e, const Difference<Integer>& a,
                               const Difference<Integer>& c) {
    return orientation_polynomial(e, a, c) == Sign::zero && sign_of(dot_of_normals(e, a, c)) == Sign::positive;
}

}  // namespace delmesh::exact
