#pragma once
// Squared distances to planes, summed: the error measure of the simplifier.

#include "delmesh/base/vec3.hpp"

namespace delmesh {

/// q(x) = x'Ax + 2 b'x + c with a symmetric positive semi-definite A. Whoever keeps one says what its origin is; all
/// code here keeps the origin close to where q is evaluated, so that precision does not depend on where a mesh lies.
/// Source: Garland and Heckbert 1997.
struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< A
    Vec3 b;
    double c = 0;

    /// weight * (normal.x - offset)^2. The normal need not have unit length.
    void add_plane(const Vec3& normal, double offset, double weight) {
        add_plane_through_origin(normal, weight);
        b = b - normal * weight * offset;
        c += weight * offset * offset;
    }
    /// weight * (normal.x)^2.
    void add_plane_through_origin(const Vec3& normal, double weight) {
        const Vec3 n = normal * weight;
        xx += n.x * normal.x;
        xy += n.x * normal.y;
        xz += n.x * normal.z;
        yy += n.y * normal.y;
        yz += n.y * normal.z;
        zz += n.z * normal.z;
    }
    /// weight * |x - point|^2.
    void add_point(const Vec3& point, double weight) {
        xx += weight;
        yy += weight;
        zz += weight;
        b = b - point * weight;
        c += weight * squared_norm(point);
    }

    Quadric& operator+=(const Quadric& o) {
        xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
        b = b + o.b;
        c += o.c;
        return *this;
    }
    Quadric& operator*=(double s) {
        xx *= s, xy *= s, xz *= s, yy *= s, yz *= s, zz *= s;
        b = b * s;
        c *= s;
        return *this;
    }

    [[nodiscard]] Vec3 apply(const Vec3& x) const {
        return {xx * x.x + xy * x.y + xz * x.z, xy * x.x + yy * x.y + yz * x.z, xz * x.x + yz * x.y + zz * x.z};
    }
    [[nodiscard]] double trace() const { return xx + yy + zz; }
    /// May come out slightly negative by rounding.
    [[nodiscard]] double operator()(const Vec3& x) const { return dot(x, apply(x) + 2.0 * b) + c; }
    /// The same function with its origin moved to `origin` (given in the old coordinates).
    [[nodiscard]] Quadric moved_to(const Vec3& origin) const {
        Quadric q = *this;
        const Vec3 a = apply(origin);
        q.b = b + a;
        q.c = c + dot(origin, a + 2.0 * b);
        return q;
    }
};

}  // namespace delmesh
