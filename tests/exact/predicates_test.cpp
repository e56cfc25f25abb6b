#include "delmesh/exact/predicates.hpp"

#include "exact/families.hpp"
#include "exact/reference.hpp"

#include <gtest/gtest.h>

#include <map>

namespace delmesh {
namespace {

using namespace families;

// ---------------------------------------------------------------------------------------------- against the reference

void expect_all_signs(const Quad& quad) {
    const auto& [p, q, u, v] = quad;
    ASSERT_EQ(delaunay_sign(p, q, u, v), reference::delaunay(p, q, u, v)) << quad;
    ASSERT_EQ(right_angle_sign(p, q, u), reference::right_angle(p, q, u)) << quad;
    ASSERT_EQ(orientation(p, q, u, v), reference::orientation(p, q, u, v)) << quad;
    ASSERT_EQ(are_collinear(p, q, u), reference::collinear(p, q, u)) << quad;
    ASSERT_EQ(is_planar_edge(p, q, u, v), reference::planar_edge(p, q, u, v)) << quad;
    for (const double cosine : {1.0, 0.0, -1.0, 0.5, 0.98})
        ASSERT_EQ(dihedral_sign(p, q, u, v, cosine), reference::dihedral(p, q, u, v, cosine)) << quad << cosine;
}

template <class Family>
void expect_family(const char* name, Family family, int count) {
    SCOPED_TRACE(name);
    Random random(2007);
    for (int i = 0; i < count && !testing::Test::HasFatalFailure(); ++i) {
        const Quad quad = family(random);
        expect_all_signs(quad);
        expect_all_signs(nudged(quad, random));
    }
}

TEST(Predicates, AgreeWithTheReferenceInEveryFamily) {
    expect_family("generic", generic, 100);
    expect_family("integer grid", integer_grid, 300);
    expect_family(
        "circle", [](Random& r) { return circle(r); }, 200);
    expect_family(
        "far circle", [](Random& r) { return circle(r, 1e6); }, 100);
    expect_family("integer circle", integer_circle, 200);
    expect_family("folded circle", folded_circle, 100);
    expect_family("folded kite", folded_kite, 200);
    expect_family("thales", thales, 200);
    expect_family(
        "grid cell", [](Random& r) { return sloping_grid_cell(r, true); }, 100);
    expect_family(
        "sloping grid cell", [](Random& r) { return sloping_grid_cell(r); }, 200);
    expect_family("needle", needle, 300);
    expect_family("cap", cap, 300);
    expect_family("any bits", any_bits, 30);
    expect_family("mixed scales", mixed_scales, 50);
    expect_family(
        "denormal", [](Random& r) { return scaled(integer_circle(r), -1074); }, 100);
    expect_family(
        "huge", [](Random& r) { return scaled(circle(r), 1022); }, 100);
    expect_family(
        "tiny", [](Random& r) { return scaled(folded_circle(r), -900); }, 100);
}

/// The predicate that everything rests on, on 10^5 cases within an ulp of its zeros.
TEST(Predicates, DelaunaySignIsRightAnUlpFromCocircular) {
    Random random(10);
    std::map<Sign, int> seen;
    for (int i = 0; i < 20000; ++i)
        for (const Quad& exact : {circle(random), integer_circle(random), folded_kite(random),
                                  sloping_grid_cell(random), folded_circle(random)}) {
            const Quad quad = nudged(exact, random);
            const Sign sign = delaunay_sign(quad.p, quad.q, quad.u, quad.v);
            ASSERT_EQ(sign, reference::delaunay(quad.p, quad.q, quad.u, quad.v)) << quad;
            ++seen[sign];
        }
    EXPECT_GT(seen[Sign::negative], 20000);
    EXPECT_GT(seen[Sign::positive], 20000);
    EXPECT_GT(seen[Sign::zero], 10000);
}

TEST(Predicates, OtherSignsAreRightAnUlpFromZero) {
    Random random(11);
    for (int i = 0; i < 10000; ++i) {
        const Quad flat = nudged(integer_circle(random), random), right = nudged(thales(random), random);
        const auto& [p, q, u, v] = flat;
        ASSERT_EQ(orientation(p, q, u, v), reference::orientation(p, q, u, v)) << flat;
        ASSERT_EQ(is_planar_edge(p, q, u, v), reference::planar_edge(p, q, u, v)) << flat;
        ASSERT_EQ(right_angle_sign(right.p, right.q, right.u), reference::right_angle(right.p, right.q, right.u))
            << right;
        const Quad line = nudged(cap(random), random);
        ASSERT_EQ(are_collinear(line.p, line.q, line.u), reference::collinear(line.p, line.q, line.u)) << line;
    }
}

/// Exactly the threshold: the angle between the planes of a 3-4-5 fold has the cosine 3/5, which is no double.
TEST(Predicates, DihedralSignIsRightAroundItsThreshold) {
    Random random(12);
    for (int i = 0; i < 2000; ++i) {
        const Quad quad = folded_kite(random);
        const auto& [p, q, u, v] = quad;
        const double nearest = 0.6, next = std::nextafter(nearest, 1.0);
        for (const double cosine : {nearest, next, std::nextafter(nearest, 0.0)})
            ASSERT_EQ(dihedral_sign(p, q, u, v, cosine), reference::dihedral(p, q, u, v, cosine)) << quad;
        ASSERT_EQ(dihedral_sign(p, q, u, v, nearest), Sign::positive);  // the double 0.6 is a little below 3/5
        ASSERT_EQ(dihedral_sign(p, q, u, v, next), Sign::negative);
    }
}

// ---------------------------------------------------------------------------------------- known without any reference

TEST(Predicates, ExactlyCocircularIsZero) {
    Random random(20);
    for (int i = 0; i < 3000; ++i)
        for (const Quad& quad : {integer_circle(random), folded_kite(random), thales(random)}) {
            ASSERT_EQ(delaunay_sign(quad.p, quad.q, quad.u, quad.v), Sign::zero) << quad;
        }
}

TEST(Predicates, ExactlyCoplanarIsZero) {
    Random random(21);
    for (int i = 0; i < 3000; ++i) {
        const auto [p, q, u, v] = integer_circle(random);
        ASSERT_EQ(orientation(p, q, u, v), Sign::zero);
        ASSERT_TRUE(is_planar_edge(p, q, u, v));
        ASSERT_FALSE(is_planar_edge(p, u, q, v) && is_planar_edge(p, v, q, u)) << "both cannot be diagonals";
        ASSERT_EQ(dihedral_sign(p, q, u, v, 1), Sign::zero);
        ASSERT_EQ(dihedral_sign(p, q, u, v, std::nextafter(1.0, 0.0)), Sign::positive);
    }
}

TEST(Predicates, ZeroAreaFacesHaveTheAnglesOfTheirLimit) {
    const Vec3 p{0, 0, 0}, q{3, 0, 0};
    const Vec3 between{1, 0, 0}, beyond{7, 0, 0}, acute{1, 5, 0}, obtuse{1, 0.5, 0};
    EXPECT_EQ(delaunay_sign(p, q, between, acute), Sign::negative);    // pi + something
    EXPECT_EQ(delaunay_sign(p, q, between, beyond), Sign::zero);       // pi + 0
    EXPECT_EQ(delaunay_sign(p, q, between, between), Sign::negative);  // pi + pi
    EXPECT_EQ(delaunay_sign(p, q, beyond, obtuse), Sign::positive);    // 0 + less than pi
    EXPECT_EQ(delaunay_sign(p, q, beyond, beyond), Sign::positive);    // 0 + 0
    EXPECT_EQ(right_angle_sign(p, q, between), Sign::negative);
    EXPECT_EQ(right_angle_sign(p, q, beyond), Sign::positive);
    EXPECT_FALSE(is_planar_edge(p, q, between, acute));
    for (const double cosine : {-1.0, -0.5, 0.0, 0.5, 1.0})
        EXPECT_EQ(dihedral_sign(p, q, beyond, acute, cosine), Sign::zero) << cosine;
}

TEST(Predicates, DihedralSignOfKnownFolds) {
    const Vec3 p{0, 0, 0}, q{1, 0, 0}, u{0, 1, 0}, flat{1, -1, 0}, upright{0, 0, 1}, folded{0.3, 0.7, 0};
    const Vec3 slight{0, -1, 0.125};
    EXPECT_EQ(dihedral_sign(p, q, u, flat, 1), Sign::zero);
    EXPECT_EQ(dihedral_sign(p, q, u, slight, 1), Sign::negative);
    EXPECT_EQ(dihedral_sign(p, q, u, folded, 1), Sign::negative);
    EXPECT_EQ(dihedral_sign(p, q, u, flat, 0), Sign::positive);
    EXPECT_EQ(dihedral_sign(p, q, u, upright, 0), Sign::zero);
    EXPECT_EQ(dihedral_sign(p, q, u, folded, 0), Sign::negative);
    EXPECT_EQ(dihedral_sign(p, q, u, flat, -1), Sign::positive);
    EXPECT_EQ(dihedral_sign(p, q, u, upright, -1), Sign::positive);
    EXPECT_EQ(dihedral_sign(p, q, u, folded, -1), Sign::zero);
    EXPECT_EQ(dihedral_sign(p, q, u, slight, 0.98), Sign::positive);  // 7 degrees against 11
    EXPECT_EQ(dihedral_sign(p, q, u, slight, 0.999), Sign::negative);
    EXPECT_TRUE(is_planar_edge(p, q, u, flat));
    EXPECT_FALSE(is_planar_edge(p, q, u, slight));
    EXPECT_FALSE(is_planar_edge(p, q, u, folded));
}

// ------------------------------------------------------------------------------------------------------ algebraic laws

/// Every sign of a quad that does not depend on orientation.
std::array<int, 7> unoriented_signs(const Quad& quad) {
    const auto& [p, q, u, v] = quad;
    return {static_cast<int>(delaunay_sign(p, q, u, v)),       static_cast<int>(is_planar_edge(p, q, u, v)),
            static_cast<int>(dihedral_sign(p, q, u, v, 0.5)),  static_cast<int>(dihedral_sign(p, q, u, v, 1)),
            static_cast<int>(dihedral_sign(p, q, u, v, -0.9)), static_cast<int>(right_angle_sign(p, q, u)),
            static_cast<int>(are_collinear(p, q, u))};
}

TEST(PredicateLaws, ExchangeOfEnds) {
    for (const auto& quad : mixed_bag(400)) {
        const auto& [p, q, u, v] = quad;
        ASSERT_EQ(unoriented_signs({q, p, u, v}), unoriented_signs(quad)) << quad;
    }
}

TEST(PredicateLaws, ExchangeOfApexes) {
    for (const auto& quad : mixed_bag(400)) {
        const auto& [p, q, u, v] = quad;
        ASSERT_EQ(delaunay_sign(p, q, v, u), delaunay_sign(p, q, u, v)) << quad;
        ASSERT_EQ(is_planar_edge(p, q, v, u), is_planar_edge(p, q, u, v)) << quad;
        ASSERT_EQ(dihedral_sign(p, q, v, u, 0.5), dihedral_sign(p, q, u, v, 0.5)) << quad;
    }
}

TEST(PredicateLaws, OrientationAlternatesAndCollinearityDoesNotCareForOrder) {
    for (const auto& quad : mixed_bag(400)) {
        const auto& [a, b, c, d] = quad;
        const Sign sign = orientation(a, b, c, d);
        ASSERT_EQ(orientation(b, a, c, d), -sign) << quad;
        ASSERT_EQ(orientation(a, c, b, d), -sign) << quad;
        ASSERT_EQ(orientation(a, b, d, c), -sign) << quad;
        ASSERT_EQ(are_collinear(b, c, a), are_collinear(a, b, c)) << quad;
        ASSERT_EQ(are_collinear(b, a, c), are_collinear(a, b, c)) << quad;
    }
}

TEST(PredicateLaws, MirrorsAndAxes) {
    const auto mirror = [](const Vec3& a) { return Vec3{-a.x, a.y, a.z}; };
    const auto turn = [](const Vec3& a) { return Vec3{a.y, a.z, a.x}; };
    const auto swap = [](const Vec3& a) { return Vec3{a.y, a.x, a.z}; };
    for (const auto& quad : mixed_bag(300)) {
        const auto oriented = [](const Quad& s) { return orientation(s.p, s.q, s.u, s.v); };
        ASSERT_EQ(unoriented_signs(mapped(quad, mirror)), unoriented_signs(quad)) << quad;
        ASSERT_EQ(unoriented_signs(mapped(quad, turn)), unoriented_signs(quad)) << quad;
        ASSERT_EQ(unoriented_signs(mapped(quad, swap)), unoriented_signs(quad)) << quad;
        ASSERT_EQ(oriented(mapped(quad, mirror)), -oriented(quad)) << quad;
        ASSERT_EQ(oriented(mapped(quad, turn)), oriented(quad)) << quad;
        ASSERT_EQ(oriented(mapped(quad, swap)), -oriented(quad)) << quad;
    }
}

TEST(PredicateLaws, PowersOfTwo) {
    int compared = 0;
    for (const auto& quad : mixed_bag(150))
        for (const int exponent : {-1060, -900, -400, -110, -65, -1, 1, 64, 130, 511, 1000}) {
            const Quad other = scaled(quad, exponent);
            const Quad back = scaled(other, -exponent);
            if (!(back.p == quad.p && back.q == quad.q && back.u == quad.u && back.v == quad.v)) continue;
            ASSERT_EQ(unoriented_signs(other), unoriented_signs(quad)) << quad << exponent;
            ASSERT_EQ(orientation(other.p, other.q, other.u, other.v), orientation(quad.p, quad.q, quad.u, quad.v))
                << quad << exponent;
            ++compared;
        }
    EXPECT_GT(compared, 10000);
}

TEST(PredicateLaws, ExactTranslation) {
    Random random(31);
    for (int i = 0; i < 2000; ++i) {
        const Quad quad = i % 2 == 0 ? integer_circle(random) : folded_kite(random);
        const Vec3 shift{0x1p40, -0x1p41, 1e12};  // sums of integers below 2^53
        const Quad moved = mapped(quad, [&](const Vec3& a) { return a + shift; });
        ASSERT_EQ(unoriented_signs(moved), unoriented_signs(quad)) << quad;
        const Quad off = nudged(moved, random);
        ASSERT_EQ(delaunay_sign(off.p, off.q, off.u, off.v), reference::delaunay(off.p, off.q, off.u, off.v)) << off;
    }
}

}  // namespace
}  // namespace delmesh
