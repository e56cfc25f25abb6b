// The filter must never be wrong: its error bounds are checked against the true errors, and it must decide what is not
// hard.

#include "exact/filter.hpp"

#include "delmesh/exact/predicates.hpp"

#include "exact/families.hpp"
#include "exact/reference.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>

namespace delmesh::exact {
namespace {

using namespace families;
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<700, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

struct RealVec {
    Real x, y, z;
};

/// 700 bits hold these differences exactly, and the truth to far more digits than an error bound has.
RealVec difference(const Vec3& a, const Vec3& b) {
    return {Real(a.x) - Real(b.x), Real(a.y) - Real(b.y), Real(a.z) - Real(b.z)};
}
Real dot(const RealVec& a, const RealVec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
RealVec cross(const RealVec& a, const RealVec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Holds each estimate against the true value and keeps the largest part of the bound that was used.
class Audit {
public:
    void check(const Estimate& estimate, const Real& truth) {
        if (!std::isfinite(estimate.value) || !(estimate.error < std::numeric_limits<double>::infinity())) return;
        const Real error = abs(Real(estimate.value) - truth);
        if (error > Real(estimate.error)) ++violations;
        if (estimate.error > 0) used = std::max(used, static_cast<double>(Real(error / Real(estimate.error))));
        ++checks;
    }

    int checks = 0;
    int violations = 0;
    double used = 0;
};

Real delaunay_truth(const Quad& quad) {
    const RealVec a = difference(quad.p, quad.u), b = difference(quad.q, quad.u);
    const RealVec c = difference(quad.p, quad.v), d = difference(quad.q, quad.v);
    const Real d1 = dot(a, b), d2 = dot(c, d);
    return d1 * abs(d1) * dot(c, c) * dot(d, d) + d2 * abs(d2) * dot(a, a) * dot(b, b);
}

Real dihedral_truth(const Quad& quad, double cosine) {
    const RealVec e = difference(quad.q, quad.p);
    const RealVec n1 = cross(e, difference(quad.u, quad.p)), n2 = cross(difference(quad.v, quad.p), e);
    return dot(n1, n2) - Real(cosine) * sqrt(Real(dot(n1, n1) * dot(n2, n2)));
}

struct Audits {
    Audit delaunay, dot, orientation, cross, dihedral;

    void check(const Quad& quad) {
        const auto& [p, q, u, v] = quad;
        delaunay.check(delaunay_estimate(p - u, q - u, p - v, q - v), delaunay_truth(quad));
        dot.check(dot_estimate(p - u, q - u), exact::dot(difference(p, u), difference(q, u)));
        const RealVec e = difference(q, p), a = difference(u, p), c = difference(v, p);
        orientation.check(orientation_estimate(q - p, u - p, v - p), exact::dot(e, exact::cross(a, c)));
        const Vec3 s = q - p, t = u - p;
        cross.check(cross_estimate(s.x, s.y, t.x, t.y), exact::cross(e, a).z);
        const double cosine = std::array{0.98, 0.0, -0.3, 1.0}[static_cast<std::size_t>(delaunay.checks % 4)];
        dihedral.check(dihedral_estimate(s, t, v - p, cosine), dihedral_truth(quad, cosine));
    }
    void expect_sound() const {
        for (const Audit* audit : {&delaunay, &dot, &orientation, &cross, &dihedral}) {
            EXPECT_EQ(audit->violations, 0);
            EXPECT_LE(audit->used, 1);
        }
    }
};

TEST(Filter, BoundsHoldInEveryFamily) {
    Random random(1);
    Audits audits;
    for (int i = 0; i < 150; ++i) {
        for (const Quad& quad : {generic(random), integer_grid(random), circle(random), circle(random, 1e3),
                                 folded_circle(random), sloping_grid_cell(random), needle(random), cap(random),
                                 integer_circle(random), scaled(generic(random), 90), scaled(circle(random), -90)})
            audits.check(quad);
    }
    audits.expect_sound();
    EXPECT_GT(audits.delaunay.checks, 1500);
    EXPECT_GT(audits.dihedral.checks, 1500);
    // Sharp enough to be a bound and not a guess: the worst case seen is within a factor 20.
    EXPECT_GT(audits.delaunay.used, 0.05);
    EXPECT_GT(audits.dot.used, 0.05);
    EXPECT_GT(audits.orientation.used, 0.05);
    EXPECT_GT(audits.cross.used, 0.05);
    EXPECT_GT(audits.dihedral.used, 0.05);
    RecordProperty("delaunay_used", std::to_string(audits.delaunay.used));
    RecordProperty("dot_used", std::to_string(audits.dot.used));
    RecordProperty("orientation_used", std::to_string(audits.orientation.used));
    RecordProperty("cross_used", std::to_string(audits.cross.used));
    RecordProperty("dihedral_used", std::to_string(audits.dihedral.used));
}

/// Hill climbing: mutates a quad as long as the error grows against its bound.
TEST(Filter, BoundsHoldAgainstAnAdversary) {
    Random random(2);
    Audit all;
    for (int start = 0; start < 10; ++start) {
        Quad quad = start % 2 == 0 ? generic(random) : circle(random);
        double worst = 0;
        for (int step = 0; step < 200; ++step) {
            Quad next = quad;
            std::array<Vec3*, 4> points{&next.p, &next.q, &next.u, &next.v};
            double& x = (*points[static_cast<std::size_t>(random.below(4))])[random.below(3)];
            x = random.below(3) == 0 ? random.symmetric() : x * (1 + random.symmetric() * 0x1p-20);
            Audit audit;
            audit.check(delaunay_estimate(next.p - next.u, next.q - next.u, next.p - next.v, next.q - next.v),
                        delaunay_truth(next));
            all.violations += audit.violations;
            if (audit.used < worst) continue;
            worst = audit.used;
            quad = next;
        }
        all.used = std::max(all.used, worst);
    }
    EXPECT_EQ(all.violations, 0);
    EXPECT_GT(all.used, 0.1);
    RecordProperty("delaunay_used", std::to_string(all.used));
}

/// Whatever underflows or overflows on the way, a sign that is claimed is right.
TEST(Filter, ClaimsNothingFalseWhereDoublesEnd) {
    Random random(3);
    int claimed = 0;
    for (int i = 0; i < 3000; ++i) {
        const int exponent = random.below(2000) - 1000;
        Quad quad = i % 3 == 0   ? any_bits(random)
                    : i % 3 == 1 ? scaled(generic(random), exponent)
                                 : mixed_scales(random);
        if (!is_finite(quad.p) || !is_finite(quad.q) || !is_finite(quad.u) || !is_finite(quad.v)) continue;
        const Vec3 p = quad.p, q = quad.q, u = quad.u, v = quad.v;
        const auto expect = [&](std::optional<Sign> claim, auto truth) {
            if (!claim) return;
            ++claimed;
            ASSERT_EQ(*claim, truth()) << quad;
        };
        expect(dot_estimate(p - u, q - u).sign(), [&] { return reference::right_angle(p, q, u); });
        expect(orientation_estimate(q - p, u - p, v - p).sign(), [&] { return reference::orientation(p, q, u, v); });
        expect(delaunay_estimate(p - u, q - u, p - v, q - v).sign(), [&] { return reference::delaunay(p, q, u, v); });
        expect(dihedral_estimate(q - p, u - p, v - p, 0.7).sign(),
               [&] { return reference::dihedral(p, q, u, v, 0.7); });
        ASSERT_FALSE(are_clearly_independent(q - p, u - p) && reference::collinear(p, q, u)) << quad;
        ASSERT_FALSE(HasFatalFailure());
    }
    EXPECT_GT(claimed, 1000);
}

/// Where products underflow or overflow, a bound is either infinite or still true.
TEST(Filter, BoundsHoldWhereDoublesEnd) {
    Random random(4);
    Audits audits;
    for (int i = 0; i < 2000; ++i) {
        const int exponent = random.below(1200) - 600;
        audits.check(scaled(i % 2 == 0 ? generic(random) : circle(random), exponent));
        audits.check(scaled(generic(random), random.below(40) - 150));  // here degree 8 ends
    }
    audits.expect_sound();
    EXPECT_GT(audits.dot.checks, 2000);
}

/// In units of the smallest double the products are -0.4, -0.4 and 0.6: their sum is negative, as rounded it is 1.
TEST(Filter, DotEstimateKnowsWhereItUnderflows) {
    const Vec3 a{-0.4, -0.4, 0.6}, b{5e-324, 5e-324, 5e-324};
    ASSERT_GT(dot(a, b), 0);
    EXPECT_FALSE(dot_estimate(a, b).sign());
}

TEST(Filter, DoesNotDecideWhatIsNotFinite) {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    const Vec3 a{1, 2, 3}, b{3, 1, 2}, c{-1, 1, 0}, d{0, 0, 1};
    for (const double bad : {inf, -inf, nan})
        for (const Vec3& x : {Vec3{bad, 0, 0}, Vec3{bad, 1, 1}, Vec3{bad, bad, 1}, Vec3{1, bad, -bad}}) {
            EXPECT_FALSE(delaunay_estimate(x, b, c, d).sign());
            EXPECT_FALSE(delaunay_estimate(a, b, c, x).sign());
            EXPECT_FALSE(dot_estimate(x, a).sign());
            EXPECT_FALSE(orientation_estimate(x, b, c).sign());
            EXPECT_FALSE(orientation_estimate(a, b, x).sign());
            EXPECT_FALSE(dihedral_estimate(a, x, b, 0.5).sign());
        }
}

}  // namespace
}  // namespace delmesh::exact
