#include "delmesh/exact/predicates.hpp"

#include "exact/families.hpp"
#include "exact/reference.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

using namespace families;

std::string text(const Quad& quad) {
    std::string result;
    for (const Vec3& a : {quad.p, quad.q, quad.u, quad.v})
        for (int axis = 0; axis < 3; ++axis) {
            char buffer[40];
            std::snprintf(buffer, sizeof buffer, "%a ", a[axis]);
            result += buffer;
        }
    return result;
}

void expect_all_signs(const Quad& quad) {
    const auto& [p, q, u, v] = quad;
    ASSERT_EQ(delaunay_sign(p, q, u, v), reference::delaunay(p, q, u, v)) << text(quad);
    ASSERT_EQ(right_angle_sign(p, q, u), reference::right_angle(p, q, u)) << text(quad);
    ASSERT_EQ(orientation(p, q, u, v), reference::orientation(p, q, u, v)) << text(quad);
    ASSERT_EQ(are_collinear(p, q, u), reference::collinear(p, q, u)) << text(quad);
    ASSERT_EQ(is_planar_edge(p, q, u, v), reference::planar_edge(p, q, u, v)) << text(quad);
    for (const double cosine : {1.0, 0.0, -1.0, 0.5, 0.98})
        ASSERT_EQ(dihedral_sign(p, q, u, v, cosine), reference::dihedral(p, q, u, v, cosine)) << text(quad) << cosine;
}

template <class Family>
void expect_family(Family family, int count, std::uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        const Quad quad = family(random);
        expect_all_signs(quad);
        if (testing::Test::HasFatalFailure()) return;
        expect_all_signs(nudged(quad, random));
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(Predicates, AgreeWithTheReferenceInEveryFamily) {
    expect_family(generic, 500, 1);
    expect_family(integer_grid, 500, 2);
    expect_family([](Random& r) { return circle(r); }, 500, 3);
    expect_family([](Random& r) { return circle(r, 1e6); }, 500, 4);
    expect_family(folded_circle, 500, 5);
    expect_family([](Random& r) { return sloping_grid_cell(r); }, 500, 6);
    expect_family([](Random& r) { return sloping_grid_cell(r, true); }, 500, 7);
    expect_family(needle, 500, 8);
    expect_family(cap, 500, 9);
    expect_family(any_bits, 100, 10);
    expect_family(mixed_scales, 100, 11);
}

}  // namespace
}  // namespace delmesh
