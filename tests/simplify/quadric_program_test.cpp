#include "delmesh/simplify/quadric_program.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace delmesh {
namespace {

using test::Random;

double worst_violation(const std::vector<HalfSpace>& all, const Vec3& x) {
    double worst = -1e300;
    for (const HalfSpace& h : all) {
        const double length = norm(h.normal);
        worst = std::max(worst, length > 0 ? (h.offset - dot(h.normal, x)) / length : h.offset > 0 ? 1e300 : -1e300);
    }
    return worst;
}

constexpr std::size_t most_unknowns = 6;
using System = std::array<std::array<double, most_unknowns + 1>, most_unknowns>;

/// Solves the first n rows by elimination with pivoting; false if they are singular.
bool solve(System& a, std::size_t n, std::array<double, most_unknowns>& x) {
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t row = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::fabs(a[i][k]) > std::fabs(a[row][k])) row = i;
        if (std::fabs(a[row][k]) < 1e-11) return false;
        std::swap(a[k], a[row]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const double f = a[i][k] / a[k][k];
            for (std::size_t j = k; j <= n; ++j) a[i][j] -= f * a[k][j];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        double sum = a[k][n];
        for (std::size_t j = k + 1; j < n; ++j) sum -= a[k][j] * x[j];
        x[k] = sum / a[k][k];
    }
    return true;
}

using Tight = std::vector<const HalfSpace*>;

/// The lowest point with the given half-spaces tight, by the Karush-Kuhn-Tucker system.
bool lowest_on(const Quadric& q, const Tight& tight, Vec3& out) {
    const std::size_t n = 3 + tight.size();
    System a{};
    const double matrix[3][3] = {{q.xx, q.xy, q.xz}, {q.xy, q.yy, q.yz}, {q.xz, q.yz, q.zz}};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) a[i][j] = matrix[i][j];
        a[i][n] = -q.b[i];
        for (std::size_t k = 0; k < tight.size(); ++k) a[i][3 + k] = a[3 + k][i] = tight[k]->normal[i];
    }
    for (std::size_t k = 0; k < tight.size(); ++k) a[3 + k][n] = tight[k]->offset;
    std::array<double, most_unknowns> x{};
    if (!solve(a, n, x)) return false;
    out = {x[0], x[1], x[2]};
    return true;
}

/// Tries every set of at most three tight half-spaces. The best value among feasible points; infinite if none.
double brute_force(const Quadric& q, const std::vector<HalfSpace>& all, double slack) {
    double best = std::numeric_limits<double>::infinity();
    Tight tight;
    tight.reserve(3);
    const auto consider = [&] {
        Vec3 x;
        if (lowest_on(q, tight, x) && worst_violation(all, x) <= slack) best = std::min(best, q(x));
    };
    consider();
    for (std::size_t i = 0; i < all.size(); ++i) {
        tight = {&all[i]};
        consider();
        for (std::size_t j = i + 1; j < all.size(); ++j) {
            tight = {&all[i], &all[j]};
            consider();
            for (std::size_t k = j + 1; k < all.size(); ++k) {
                tight = {&all[i], &all[j], &all[k]};
                consider();
            }
        }
    }
    return best;
}

Quadric random_quadric(Random& random) {
    Quadric q;
    const std::size_t planes = 1 + random.below(6);
    for (std::size_t i = 0; i < planes; ++i) q.add_plane(random.vec(1), random.real(-1, 1), random.real(0.1, 2));
    q.add_point(random.vec(1), random.below(3) == 0 ? 1e-4 : 0.1);
    return q;
}

std::vector<HalfSpace> random_half_spaces(Random& random) {
    std::vector<HalfSpace> all;
    const std::size_t count = random.below(7);
    const std::size_t kind = random.below(6);
    const Vec3 inside = random.vec(1);
    for (std::size_t i = 0; i < count; ++i) {
        Vec3 n = random.vec(1);
        if (kind == 1)
            n = {static_cast<double>(random.below(3)) - 1, static_cast<double>(random.below(3)) - 1,
                 static_cast<double>(random.below(3)) - 1};                         // parallel, opposite, zero
        if (kind == 2) n.z = 0;                                                     // all borders parallel to a line
        const double gap = kind == 3 ? 0 : random.real(kind == 4 ? -0.3 : 0, 0.5);  // 3: all through one point
        all.push_back({n, dot(n, inside) - gap * norm(n)});
        if (kind == 5 && !all.empty()) all.push_back(all.front());  // repeated
    }
    return all;
}

TEST(QuadricProgram, AgreesWithAllActiveSetsInAHundredThousandCases) {
    Random random(1);
    int feasible = 0, infeasible = 0, thin = 0, active = 0;
    for (int i = 0; i < 100000; ++i) {
        const Quadric q = random_quadric(random);
        const std::vector<HalfSpace> all = random_half_spaces(random);
        const auto factors = factorise(q);
        ASSERT_TRUE(factors);
        std::vector<HalfSpace> scratch = all;
        const auto found = minimise(*factors, scratch);
        const double exact = brute_force(q, all, 1e-9);
        if (!found) {
            // Nothing may be left that is thicker than the tolerance.
            ++infeasible;
            std::vector<HalfSpace> shrunk = all;
            for (HalfSpace& h : shrunk) h.offset += 1e-7 * norm(h.normal);
            ASSERT_TRUE(std::isinf(brute_force(q, shrunk, 1e-10))) << "case " << i;
            continue;
        }
        ASSERT_LE(worst_violation(all, *found), 1e-8) << "case " << i;
        if (std::isinf(exact)) {
            ++thin;
            continue;
        }
        ++feasible;
        if (norm(*found - factors->lowest) > 1e-9) ++active;
        ASSERT_NEAR(q(*found), exact, 1e-7 * (1 + std::fabs(exact))) << "case " << i;
    }
    EXPECT_GT(feasible, 50000);
    EXPECT_GT(active, 15000);
    EXPECT_GT(infeasible, 500);
    EXPECT_LT(thin, 200);
}

TEST(QuadricProgram, AZeroNormalHoldsEverywhereOrNowhere) {
    Quadric q;
    q.add_point({1, 2, 3}, 1);
    const auto factors = factorise(q);
    std::vector<HalfSpace> always{{{}, -1}}, never{{{}, 1}};
    EXPECT_EQ(minimise(*factors, always), (Vec3{1, 2, 3}));
    EXPECT_FALSE(minimise(*factors, never));
}

TEST(QuadricProgram, APlaneAloneHasNoFactors) {
    Quadric q;
    q.add_plane({0, 0, 1}, 2, 1);
    EXPECT_FALSE(factorise(q));
}

}  // namespace
}  // namespace delmesh
