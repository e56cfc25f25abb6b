#include "delmesh/simplify/quadric.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

/// A quadric and, beside it, the sum that it stands for.
struct Sum {
    struct Term {
        Vec3 normal_or_point;
        double offset = 0;
        double weight = 0;
        bool is_plane = true;
    };

    void add(test::Random& random) {
        Term term{random.vec(2), random.real(-2, 2), random.real(0, 3), random.below(2) == 0};
        if (!term.is_plane) {
            quadric.add_point(term.normal_or_point, term.weight);
        } else if (random.below(4) == 0) {
            term.offset = 0;
            quadric.add_plane_through_origin(term.normal_or_point, term.weight);
        } else {
            quadric.add_plane(term.normal_or_point, term.offset, term.weight);
        }
        terms.push_back(term);
    }

    [[nodiscard]] double at(const Vec3& x) const {
        double sum = 0;
        for (const Term& t : terms) {
            const double distance = dot(t.normal_or_point, x) - t.offset;
            sum += t.weight * (t.is_plane ? distance * distance : squared_norm(x - t.normal_or_point));
        }
        return sum;
    }

    Quadric quadric;
    std::vector<Term> terms;
};

TEST(Quadric, IsTheSumOfItsPlanesAndPoints) {
    test::Random random(1);
    for (int i = 0; i < 1000; ++i) {
        Sum sum;
        for (std::size_t n = random.below(std::size_t{6}); n > 0; --n) sum.add(random);
        const Vec3 x = random.vec(2);
        EXPECT_NEAR(sum.quadric(x), sum.at(x), 1e-12 * (1 + sum.at(x))) << i;
    }
}

TEST(Quadric, AddsAndScales) {
    test::Random random(2);
    for (int i = 0; i < 1000; ++i) {
        Sum a;
        Sum b;
        a.add(random);
        b.add(random);
        const Vec3 x = random.vec(2);
        const double expected = a.at(x) + 0.25 * b.at(x);
        b.quadric *= 0.25;
        a.quadric += b.quadric;
        EXPECT_NEAR(a.quadric(x), expected, 1e-12 * (1 + expected)) << i;
        EXPECT_NEAR(a.quadric.trace(), a.quadric.xx + a.quadric.yy + a.quadric.zz, 1e-14) << i;
    }
}

TEST(Quadric, MovingTheOriginKeepsTheValues) {
    test::Random random(3);
    for (int i = 0; i < 1000; ++i) {
        Sum sum;
        for (int n = 0; n < 4; ++n) sum.add(random);
        const Vec3 origin = random.vec(2);
        const Vec3 x = random.vec(2);
        EXPECT_NEAR(sum.quadric.moved_to(origin)(x - origin), sum.at(x), 1e-11 * (1 + sum.at(x))) << i;
    }
}

}  // namespace
}  // namespace delmesh
