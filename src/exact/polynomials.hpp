#pragma once
// The exact formulas, each written once for every kind of integer: the words of tier 2 (wide.hpp) and the big integers
// of tier 3. A product has the type that holds it, so a formula's type says how wide it gets.

#include "delmesh/exact/sign.hpp"

namespace delmesh::exact {

template <class Integer>
Sign sign_of(const Integer& value) {
    return static_cast<Sign>(value.sign());
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

/// See filter.hpp for the formula; needs degree 8 only where D1 and D2 have opposite signs.
template <class Integer>
Sign delaunay_polynomial(const Difference<Integer>& a, const Difference<Integer>& b, const Difference<Integer>& c,
                         const Difference<Integer>& d) {
    const auto d1 = dot(a, b), d2 = dot(c, d);
    const Sign s1 = sign_of(d1), s2 = sign_of(d2);
    if (s1 == s2 || s2 == Sign::zero) return s1;
    if (s1 == Sign::zero) return s2;
    return s1 * sign_of((d1 * d1) * (dot(c, c) * dot(d, d)) - (d2 * d2) * (dot(a, a) * dot(b, b)));
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

/// The sign of n1.n2 - cosine |n1||n2| with n1 = e x a, n2 = c x e, where cosine^2 = numerator / denominator (both not
/// negative) and `s` is the sign of the cosine. Dot products only, by the identity of Binet and Cauchy.
template <class Integer, class Ratio>
Sign dihedral_polynomial(const Difference<Integer>& e, const Difference<Integer>& a, const Difference<Integer>& c,
                         Sign s, const Ratio& numerator, const Ratio& denominator) {
    const auto ee = dot(e, e), ea = dot(e, a), ec = dot(e, c);
    const auto normals_dot = ec * ea - ee * dot(a, c);
    const Sign g = sign_of(normals_dot);
    if (s == Sign::zero) return g;
    const auto area1 = ee * dot(a, a) - ea * ea, area2 = ee * dot(c, c) - ec * ec;
    if (sign_of(area1) == Sign::zero || sign_of(area2) == Sign::zero) return Sign::zero;
    if (g != s) return g == Sign::zero ? -s : g;
    return s * sign_of((normals_dot * normals_dot) * denominator - (area1 * area2) * numerator);
}

}  // namespace delmesh::exact
