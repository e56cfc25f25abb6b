// Tier 3 on its own: any spread of exponents, and the same answers as tier 2 where both can tell.

#include "exact/families.hpp"
#include "exact/reference.hpp"
#include "exact/tiers.hpp"

#include <gtest/gtest.h>

namespace delmesh::exact {
namespace {

using namespace families;

TEST(Big, AgreesWithTheReference) {
    Random random(1);
    for (int i = 0; i < 300; ++i) {
        const Quad quad = i % 3 == 0   ? nudged(mixed_scales(random), random)
                          : i % 3 == 1 ? any_bits(random)
                                       : cap(random);
        const auto& [p, q, u, v] = quad;
        ASSERT_EQ(delaunay_big(p, q, u, v), reference::delaunay(p, q, u, v));
        ASSERT_EQ(right_angle_big(p, q, u), reference::right_angle(p, q, u));
        ASSERT_EQ(orientation_big(p, q, u, v), reference::orientation(p, q, u, v));
        ASSERT_EQ(are_collinear_big(p, q, u), reference::collinear(p, q, u));
        ASSERT_EQ(is_planar_edge_big(p, q, u, v), reference::planar_edge(p, q, u, v));
        for (const double cosine : {0.98, -1e-300, 5e-320, 0.0, 1.0})
            ASSERT_EQ(dihedral_big(p, q, u, v, cosine), reference::dihedral(p, q, u, v, cosine)) << cosine;
    }
}

TEST(Big, AgreesWithTheFixedTier) {
    Random random(2);
    for (int i = 0; i < 3000; ++i) {
        const Quad quad = nudged(i % 2 == 0 ? integer_circle(random) : folded_circle(random), random);
        const auto& [p, q, u, v] = quad;
        ASSERT_EQ(delaunay_fixed(p, q, u, v), delaunay_big(p, q, u, v));
        ASSERT_EQ(orientation_fixed(p, q, u, v), orientation_big(p, q, u, v));
        ASSERT_EQ(dihedral_fixed(p, q, u, v, 0.1), dihedral_big(p, q, u, v, 0.1));
    }
}

}  // namespace
}  // namespace delmesh::exact
