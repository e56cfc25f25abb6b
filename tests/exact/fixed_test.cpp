// Tier 2 on its own, above all at the limits of its words.

#include "exact/tiers.hpp"

#include "exact/families.hpp"
#include "exact/reference.hpp"

#include <gtest/gtest.h>

namespace delmesh::exact {
namespace {

using namespace families;

/// Coordinates as large as `bits`-bit differences allow, next to the smallest that are not zero.
Quad extreme(Random& random, int bits) {
    const double half = std::ldexp(1 - 0x1p-53, bits - 1);
    const auto coordinate = [&] {
        const double sign = random.below(2) == 0 ? 1 : -1;
        switch (random.below(8)) {
            case 0:
                return sign;
            case 1:
                return 0.0;
            case 2:
                return sign * std::ldexp(1 + 0x1p-52, bits - 2);
            default:
                return sign * half;
        }
    };
    const auto point = [&] {
        const double x = coordinate(), y = coordinate(), z = coordinate();
        return Vec3{x, y, z};
    };
    const Vec3 p = point(), q = point();
    Vec3 u = point(), v = point();
    while (u == p || u == q) u = point();
    while (v == p || v == q) v = point();
    return {p, q, u, v};
}

void expect_fixed(const Quad& quad) {
    const auto& [p, q, u, v] = quad;
    ASSERT_EQ(delaunay_fixed(p, q, u, v), reference::delaunay(p, q, u, v));
    ASSERT_EQ(right_angle_fixed(p, q, u), reference::right_angle(p, q, u));
    ASSERT_EQ(orientation_fixed(p, q, u, v), reference::orientation(p, q, u, v));
    ASSERT_EQ(are_collinear_fixed(p, q, u), reference::collinear(p, q, u));
    ASSERT_EQ(is_planar_edge_fixed(p, q, u, v), reference::planar_edge(p, q, u, v));
    for (const double cosine : {0.98, -0.3, 0.0, 1.0, -1.0, 0.5, 0x1.fffffffffffffp-11})
        ASSERT_EQ(dihedral_fixed(p, q, u, v, cosine), reference::dihedral(p, q, u, v, cosine)) << cosine;
}

TEST(Fixed, IsRightUpToTheLimitsOfItsWords) {
    for (const int bits : {20, 61, 62, 63, 64, 65, 125, 126}) {
        Random random(static_cast<std::uint64_t>(bits));
        for (int i = 0; i < 150; ++i) {
            expect_fixed(extreme(random, bits));
            if (HasFatalFailure()) FAIL() << bits << " bits, case " << i;
        }
    }
}

TEST(Fixed, DeclinesWhatDoesNotFit) {
    const double wide = 0x1p126;  // against 1: 127 bits
    const Vec3 p{0, 0, 0}, q{wide, 0, 0}, u{1, 1, 0}, v{1, -1, 1};
    EXPECT_FALSE(delaunay_fixed(p, q, u, v));
    EXPECT_FALSE(right_angle_fixed(p, q, u));
    EXPECT_FALSE(orientation_fixed(p, q, u, v));
    EXPECT_FALSE(are_collinear_fixed(p, q, u));
    EXPECT_FALSE(dihedral_fixed(p, q, u, v, 0.5));
    EXPECT_FALSE(is_planar_edge_fixed(p, q, u, v));
    const Vec3 narrower{0x1.8p125, 0, 0};
    EXPECT_TRUE(delaunay_fixed(p, narrower, u, v));
    EXPECT_TRUE(dihedral_fixed(p, narrower, u, v, 0.5));
    EXPECT_FALSE(dihedral_fixed(p, narrower, u, v, 1e-5));    // too fine
    EXPECT_TRUE(dihedral_fixed(p, narrower, u, v, 0x1p-63));  // a power of two is not
}

TEST(Fixed, CountsDifferencesAndNotPositions) {
    const Vec3 far{0x1p100, -0x1p100, 0x1p100};  // the finest bit here is worth 2^48
    const double unit = 0x1p48;
    const auto at = [&](double x, double y, double z) { return far + unit * Vec3{x, y, z}; };
    // A square on the sphere of p and q.
    EXPECT_EQ(delaunay_fixed(at(0, 0, 0), at(3, 4, 0), at(3, 0, 0), at(0, 4, 0)), Sign::zero);
    EXPECT_EQ(delaunay_fixed(at(0, 0, 0), at(3, 4, 0), at(2, 0, 0), at(0, 4, 0)), Sign::negative);
    EXPECT_EQ(orientation_fixed(at(0, 0, 0), at(3, 4, 0), at(2, 0, 0), at(0, 4, 1)),
              orientation_fixed({0, 0, 0}, {3, 4, 0}, {2, 0, 0}, {0, 4, 1}));
}

}  // namespace
}  // namespace delmesh::exact
