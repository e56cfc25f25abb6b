// Whatever comes in: what is promised holds. Random triangles over few places meet in every way there is.

#include "support/random.hpp"
#include "delmesh/exact/predicates.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "repair/repair_support.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <set>

namespace delmesh::test {
namespace {

/// Triangles between points of a small integer grid: coincident vertices, caps, needles, double faces, crowded edges.
PolygonSoup random_soup(std::uint64_t seed) {
    Random random(seed);
    PolygonSoup soup;
    const std::uint32_t vertices = 4 + random.below(20);
    const std::uint32_t grid = 2 + random.below(4);
    const bool flat = random.below(4) == 0;
    for (std::uint32_t v = 0; v < vertices; ++v)
        soup.points.push_back({static_cast<double>(random.below(grid)), static_cast<double>(random.below(grid)),
                               flat ? 0.0 : static_cast<double>(random.below(grid))});
    const std::uint32_t faces = 1 + random.below(4 * vertices);
    for (std::uint32_t f = 0; f < faces; ++f)
        soup.add_face(Triangle{random.below(vertices), random.below(vertices), random.below(vertices)});
    return soup;
}

TEST(RandomSoup, IsRepaired) {
    for (std::uint64_t seed = 0; seed < 1500; ++seed) {
        SCOPED_TRACE(seed);
        repair_and_check(random_soup(seed));
        if (::testing::Test::HasFailure()) return;
    }
}

TEST(RandomSoup, IsRepairedWithTolerance) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        repair_and_check(random_soup(seed), {.weld_tolerance_rel = 0.05 * static_cast<double>(seed % 10)});
        if (::testing::Test::HasFailure()) return;
    }
}

/// Parts of solids on a voxel grid: cubes meet along edges, at corners and in whole sides.
TEST(RandomSoup, VoxelsComeApartClosed) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        PolygonSoup soup;
        for (int i = 0; i < 27; ++i)
            if (random.below(2) == 0)
                append(soup, make_cube({static_cast<double>(i % 3), static_cast<double>(i / 3 % 3),
                                        static_cast<double>(i / 9)}));
        const std::size_t cubes = soup.points.size() / 8;
        if (random.below(2) == 0) soup = take_apart(soup);
        if (random.below(2) == 0) soup = merge_places(soup);
        const Repaired out = repair_and_check(soup);
        EXPECT_EQ(count_boundary_edges(out.soup), 0U);
        EXPECT_EQ(count_components(out.soup), cubes);
        if (::testing::Test::HasFailure()) return;
    }
}

/// Closed bodies over few vertices, glued in every way: every edge has an even number of faces, and stays without hole.
TEST(RandomSoup, GluedTetrahedraStayClosed) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        PolygonSoup soup;
        const std::uint32_t vertices = 5 + random.below(12);
        for (std::uint32_t v = 0; v < vertices; ++v)
            soup.points.push_back({random.below(6) + 0.1 * v, random.below(6) + 0.01 * v * v, 1.0 * random.below(6)});
        for (std::uint32_t t = 0; t < 2 * vertices; ++t) {
            std::array<std::uint32_t, 4> p{};
            for (auto& v : p) v = random.below(vertices);
            if (std::set<std::uint32_t>(p.begin(), p.end()).size() < 4) continue;
            if (orientation(soup.points[p[0]], soup.points[p[1]], soup.points[p[2]], soup.points[p[3]]) ==
                Sign::positive)
                std::swap(p[0], p[1]);
            for (const Triangle& f : {Triangle{p[0], p[1], p[2]}, Triangle{p[0], p[3], p[1]},
                                      Triangle{p[1], p[3], p[2]}, Triangle{p[0], p[2], p[3]}}) {
                soup.add_face(f);
                if (seed % 2 == 0 && random.below(3) == 0) turn_face(soup, soup.face_count() - 1);
            }
        }
        // But for obtuse triangles that only their own backs were joined with.
        const Repaired out = repair_and_check(soup);
        EXPECT_LE(count_boundary_edges(out.soup), 3 * out.report.count(Defect::duplicate_face));
        if (::testing::Test::HasFailure()) return;
    }
}

/// Turned faces, torn vertices and dropped faces on good meshes.
TEST(RandomSoup, DamagedFamiliesAreRepaired) {
    for (const NamedSoup& family : families(120)) {
        SCOPED_TRACE(family.name);
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            SCOPED_TRACE(seed);
            Random random(seed);
            PolygonSoup soup = seed == 0 ? take_apart(family.soup) : family.soup;
            for (std::size_t f = 0; f < soup.face_count(); ++f) {
                if (random.below(10) == 0) turn_face(soup, f);
                if (random.below(20) == 0)
                    soup.corners[3 * f] = random.below(static_cast<std::uint32_t>(soup.points.size()));
            }
            if (family.extreme_scale) continue;
            repair_and_check(soup);
            if (::testing::Test::HasFailure()) return;
        }
    }
}

}  // namespace
}  // namespace delmesh::test
