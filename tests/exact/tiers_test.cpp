// Which tier decides what: hand-made cases that name it, and counts over families.

#include "exact/tiers.hpp"

#include "delmesh/exact/predicates.hpp"

#include "exact/families.hpp"
#include "exact/inline.hpp"

#include <gtest/gtest.h>

#include <tuple>

namespace delmesh {
namespace {

using namespace families;

TEST(Tiers, InlineVersionsAreTheSame) {
    for (const auto& quad : mixed_bag(200)) {
        const auto& [p, q, u, v] = quad;
        Tier a{}, b{};
        ASSERT_EQ(exact::delaunay_sign_inline(p, q, u, v, &a), delaunay_sign(p, q, u, v, &b));
        ASSERT_EQ(a, b);
        ASSERT_EQ(exact::right_angle_sign_inline(p, q, u), right_angle_sign(p, q, u));
        ASSERT_EQ(exact::orientation_inline(p, q, u, v), orientation(p, q, u, v));
        ASSERT_EQ(exact::are_collinear_inline(p, q, u), are_collinear(p, q, u));
        ASSERT_EQ(exact::is_planar_edge_inline(p, q, u, v), is_planar_edge(p, q, u, v));
    }
}

struct Decision {
    Sign sign;
    Tier tier;
    bool operator==(const Decision&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Decision& decision) {
    return out << "sign " << static_cast<int>(decision.sign) << " by tier " << static_cast<int>(decision.tier);
}

Decision delaunay_decision(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v) {
    Tier tier{};
    const Sign sign = delaunay_sign(p, q, u, v, &tier);
    return {sign, tier};
}

TEST(Tiers, DelaunaySignCoverage) {
    const Vec3 p{0, 0, 0}, q{1, 1, 0};
    const auto by = [](Sign sign, Tier tier) { return Decision{sign, tier}; };
    using enum Sign;
    // Clear cases, and the diagonal of a rectangle parallel to the axes.
    EXPECT_EQ(delaunay_decision(p, q, {2, 0, 0}, {0, 2, 1}), by(positive, Tier::filter));
    EXPECT_EQ(delaunay_decision(p, q, {0.6, 0.5, 0}, {0, 1, 0}), by(negative, Tier::filter));
    EXPECT_EQ(delaunay_decision(p, q, {1, 0, 0}, {0, 1, 0}), by(zero, Tier::filter));
    EXPECT_EQ(delaunay_decision({0.1, 0.3, 0.7}, {0.2, 0.9, 0.7}, {0.1, 0.9, 0.7}, {0.2, 0.3, 0.7}),
              by(zero, Tier::filter));
    // A unit of length in which the products of degree 8 underflow or overflow.
    EXPECT_EQ(delaunay_decision(p, 1e-300 * q, {2e-300, 0, 0}, {0, 2e-300, 1e-300}), by(positive, Tier::filter));
    EXPECT_EQ(delaunay_decision(p, 1e300 * q, {6e299, 5e299, 0}, {0, 1e300, 0}), by(negative, Tier::filter));
    EXPECT_EQ(delaunay_decision(p, 5e-320 * q, {1e-319, 0, 0}, {0, 1e-319, 5e-320}), by(positive, Tier::filter));
    // A square that stands on a corner; then one corner is moved by an ulp.
    EXPECT_EQ(delaunay_decision({0, 0, 0}, {-1, 7, 0}, {3, 4, 0}, {-4, 3, 0}), by(zero, Tier::fixed));
    EXPECT_EQ(delaunay_decision({0, 0, 0}, {-1, 7, 0}, {3, std::nextafter(4.0, 5.0), 0}, {-4, 3, 0}),
              by(positive, Tier::fixed));
    EXPECT_EQ(delaunay_decision({0, 0, 0}, {-1, 7, 0}, {3, std::nextafter(4.0, 3.0), 0}, {-4, 3, 0}),
              by(negative, Tier::fixed));
    // The same where doubles begin and end.
    EXPECT_EQ(delaunay_decision({0, 0, 0}, {-5e-324, 35e-324, 0}, {15e-324, 20e-324, 0}, {-20e-324, 15e-324, 0}),
              by(zero, Tier::fixed));
    EXPECT_EQ(
        delaunay_decision({0, 0, 0}, {-0x1p1020, 0x1.cp1022, 0}, {0x1.8p1021, 0x1p1022, 0}, {-0x1p1022, 0x1.8p1021, 0}),
        by(zero, Tier::fixed));
    // Right angles but for 2^-80: more than a word of difference, two are enough.
    EXPECT_EQ(delaunay_decision(p, q, {1, 0x1p-80, 0}, {0, 1, 0}), by(negative, Tier::fixed));
    EXPECT_EQ(delaunay_decision(p, q, {1, -0x1p-80, 0}, {0, 1, 0}), by(positive, Tier::fixed));
    // But for 2^-200, 1e-300, and the smallest double: no fixed number of words.
    for (const double tiny : {0x1p-200, 1e-300, 5e-324}) {
        EXPECT_EQ(delaunay_decision(p, q, {1, tiny, 0}, {0, 1, 0}), by(negative, Tier::big));
        EXPECT_EQ(delaunay_decision(p, q, {1, -tiny, 0}, {0, 1, 0}), by(positive, Tier::big));
        EXPECT_EQ(delaunay_decision(p, q, {1, tiny, 0}, {0, 1 - tiny, 0}), by(negative, Tier::big));
    }
    // Differences that overflow.
    EXPECT_EQ(delaunay_decision({-1.7e308, 0, 0}, {1.7e308, 0, 0}, {0, 1.7e308, 0}, {0, -1.7e308, 0}),
              by(zero, Tier::fixed));
}

Decision right_angle_decision(const Vec3& p, const Vec3& q, const Vec3& u) {
    Tier tier{};
    const Sign sign = right_angle_sign(p, q, u, &tier);
    return {sign, tier};
}

TEST(Tiers, RightAngleSignCoverage) {
    const auto by = [](Sign sign, Tier tier) { return Decision{sign, tier}; };
    using enum Sign;
    EXPECT_EQ(right_angle_decision({0, 0, 0}, {1, 1, 0}, {2, 0, 0}), by(positive, Tier::filter));
    EXPECT_EQ(right_angle_decision({0, 0, 0}, {1, 1, 0}, {1, 0, 0}), by(zero, Tier::filter));
    EXPECT_EQ(right_angle_decision({1e-200, 0, 0}, {0, 1e-200, 0}, {-1e-200, 0, 0}), by(positive, Tier::filter));
    EXPECT_EQ(right_angle_decision({0, 0, 0}, {-1, 7, 0}, {3, 4, 0}), by(zero, Tier::fixed));
    EXPECT_EQ(right_angle_decision({3, 4, 0x1p-80}, {-4, 3, -0x1p-80}, {0, 0, 0}), by(negative, Tier::fixed));
    EXPECT_EQ(right_angle_decision({0, 0, 0}, {1, 1, 0}, {1, 0x1p-80, 0}), by(negative, Tier::filter));
    EXPECT_EQ(right_angle_decision({0, 0, 0}, {1, 1, 0}, {1, 1e-300, 0}), by(negative, Tier::filter));
    EXPECT_EQ(right_angle_decision({3, 4, 1e-300}, {-4, 3, 1e300}, {0, 0, 0}), by(positive, Tier::filter));
    EXPECT_EQ(right_angle_decision({3, 4, 1e-300}, {-4, 3, 1e-300}, {0, 0, 0}), by(positive, Tier::big));
    EXPECT_EQ(right_angle_decision({3, 4, 5e-324}, {-4, 3, -5e-324}, {0, 0, 0}), by(negative, Tier::big));
}

Decision orientation_decision(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    Tier tier{};
    const Sign sign = orientation(a, b, c, d, &tier);
    return {sign, tier};
}

TEST(Tiers, OrientationCoverage) {
    const auto by = [](Sign sign, Tier tier) { return Decision{sign, tier}; };
    using enum Sign;
    const Vec3 o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0};
    EXPECT_EQ(orientation_decision(o, x, y, {0, 0, 1}), by(positive, Tier::filter));
    EXPECT_EQ(orientation_decision(o, x, y, {0, 0, -5e-324}), by(negative, Tier::big));
    EXPECT_EQ(orientation_decision({0.1, 0.2, 0.3}, {0.7, 0.2, 0.3}, {0.5, 0.9, 0.3}, {0.1, 0.8, 0.3}),
              by(zero, Tier::filter));
    EXPECT_EQ(orientation_decision(1e-200 * o, 1e-200 * x, 1e-200 * y, {0, 0, 1e-200}), by(positive, Tier::filter));
    EXPECT_EQ(orientation_decision(o, {1, 2, 3}, {4, 5, 6}, {5, 7, 9}), by(zero, Tier::fixed));
    EXPECT_EQ(orientation_decision(o, {1, 2, 3}, {4, 5, 6}, {5, 7, std::nextafter(9.0, 10.0)}),
              by(negative, Tier::fixed));
    EXPECT_EQ(orientation_decision(o, {1, 2, 3}, {4, 5, 6}, {5, 7 + 0x1p-80, 9}), by(zero, Tier::fixed));
    EXPECT_EQ(orientation_decision({0, 0, 0x1p-80}, {1, 2, 3}, {4, 5, 6}, {5, 7, 9}), by(negative, Tier::fixed));
    EXPECT_EQ(orientation_decision({0, 0, 1e-300}, {1, 2, 3}, {4, 5, 6}, {5, 7, 9}), by(negative, Tier::big));
}

TEST(Tiers, CollinearAndPlanarCoverage) {
    Tier tier{};
    EXPECT_FALSE(are_collinear({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, &tier));
    EXPECT_EQ(tier, Tier::filter);
    EXPECT_TRUE(are_collinear({0, 0, 0}, {1, 2, 3}, {3, 6, 9}, &tier));
    EXPECT_EQ(tier, Tier::fixed);
    EXPECT_FALSE(are_collinear({0, 0, 0x1p-80}, {1, 2, 3}, {3, 6, 9}, &tier));
    EXPECT_EQ(tier, Tier::fixed);
    EXPECT_FALSE(are_collinear({0, 0, 1e-300}, {1, 2, 3}, {3, 6, 9}, &tier));
    EXPECT_EQ(tier, Tier::big);
    EXPECT_TRUE(are_collinear({2, 2, 2}, {2, 2, 2}, {3, 6, 9}));

    EXPECT_FALSE(is_planar_edge({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, &tier));
    EXPECT_EQ(tier, Tier::filter);
    EXPECT_TRUE(is_planar_edge({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, &tier));
    EXPECT_EQ(tier, Tier::filter);
    EXPECT_FALSE(is_planar_edge({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 2, 0}, &tier));
    EXPECT_EQ(tier, Tier::filter);
    EXPECT_TRUE(is_planar_edge({0, 0, 0}, {1, 2, 3}, {4, 5, 6}, {-3, -3, -3}, &tier));
    EXPECT_EQ(tier, Tier::fixed);
    EXPECT_FALSE(is_planar_edge({0, 0, 1e-300}, {1, 2, 3}, {4, 5, 6}, {-3, -3, -3}, &tier));
    EXPECT_EQ(tier, Tier::big);
}

TEST(Tiers, DihedralCoverage) {
    const Vec3 p{0, 0, 0}, q{1, 0, 0}, u{0, 1, 0};
    Tier tier{};
    EXPECT_EQ(dihedral_sign(p, q, u, {0, -1, 1}, 0.5, &tier), Sign::positive);
    EXPECT_EQ(tier, Tier::filter);
    EXPECT_EQ(dihedral_sign(p, q, u, {0, -1, 1}, 1, &tier), Sign::negative);
    EXPECT_EQ(tier, Tier::filter);
    EXPECT_EQ(dihedral_sign(p, q, u, {0, -1, 1e-40}, 1, &tier), Sign::negative);
    EXPECT_EQ(tier, Tier::filter);
    EXPECT_EQ(dihedral_sign(p, q, u, {0, -1, 0}, 1, &tier), Sign::zero);
    EXPECT_EQ(tier, Tier::fixed);
    EXPECT_EQ(dihedral_sign(p, q, u, {0, 0x1p-60, 1}, 0, &tier), Sign::negative);
    EXPECT_EQ(tier, Tier::fixed);
    EXPECT_EQ(dihedral_sign(p, q, u, {0, -1e-300, 1}, 0, &tier), Sign::positive);
    EXPECT_EQ(tier, Tier::big);
    EXPECT_EQ(dihedral_sign(p, q, u, {0, -5e-324, 1}, 5e-324, &tier), Sign::negative);
    EXPECT_EQ(tier, Tier::big);
}

/// Counts the tiers of a predicate over a family.
template <class Family, class Predicate>
std::array<int, 3> tier_counts(Family family, Predicate predicate, int count = 20000) {
    Random random(40);
    std::array<int, 3> counts{};
    for (int i = 0; i < count; ++i) {
        Tier tier{};
        predicate(family(random), &tier);
        ++counts[static_cast<std::size_t>(tier)];
    }
    return counts;
}

void delaunay(const Quad& quad, Tier* tier) {
    std::ignore = delaunay_sign(quad.p, quad.q, quad.u, quad.v, tier);
}

TEST(Tiers, GenericInputNeedsOnlyTheFilter) {
    using Counts = std::array<int, 3>;
    const Counts all{20000, 0, 0};
    EXPECT_EQ(tier_counts(generic, delaunay), all);
    EXPECT_EQ(tier_counts(generic, [](const Quad& s, Tier* t) { return right_angle_sign(s.p, s.q, s.u, t); }), all);
    EXPECT_EQ(tier_counts(generic, [](const Quad& s, Tier* t) { return orientation(s.p, s.q, s.u, s.v, t); }), all);
    EXPECT_EQ(tier_counts(generic, [](const Quad& s, Tier* t) { return are_collinear(s.p, s.q, s.u, t); }), all);
    EXPECT_EQ(tier_counts(generic, [](const Quad& s, Tier* t) { return is_planar_edge(s.p, s.q, s.u, s.v, t); }), all);
    for (const double cosine : {1.0, 0.98, 0.0})
        EXPECT_EQ(
            tier_counts(generic, [=](const Quad& s, Tier* t) { return dihedral_sign(s.p, s.q, s.u, s.v, cosine, t); }),
            all);
    // In any unit of length, too.
    for (const int exponent : {-1000, -300, 300, 1000})
        EXPECT_EQ(tier_counts([=](Random& r) { return scaled(generic(r), exponent); }, delaunay), all) << exponent;
}

TEST(Tiers, GridsNeedNoBigIntegers) {
    EXPECT_EQ(tier_counts([](Random& r) { return sloping_grid_cell(r, true); }, delaunay)[0], 20000);
    EXPECT_EQ(tier_counts([](Random& r) { return sloping_grid_cell(r); }, delaunay)[2], 0);
    EXPECT_EQ(tier_counts(integer_circle, delaunay), (std::array<int, 3>{0, 20000, 0}));
    EXPECT_EQ(tier_counts([](Random& r) { return circle(r); }, delaunay)[2], 0);
}

}  // namespace
}  // namespace delmesh
