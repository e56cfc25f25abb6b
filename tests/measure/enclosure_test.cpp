#include "delmesh/measure/distance.hpp"
#include "measure/meshes.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace delmesh {
namespace {

using namespace delmesh::testing;

DistanceOptions bounded(double bound_rel, std::size_t samples = 200) {
    DistanceOptions options;
    options.min_samples = samples;
    options.samples_per_face = 0.1;
    options.bound_rel = bound_rel;
    return options;
}

DistanceEnclosure enclose(const PolygonSoup& a, const PolygonSoup& b, double bound_rel) {
    const DistanceReport r = measure_distance(a, b, bounded(bound_rel));
    EXPECT_TRUE(r.enclosure->reached);
    // Rounded outward at the end, which shows among denormals.
    constexpr double tiny = 2 * std::numeric_limits<double>::denorm_min();
    EXPECT_LE(r.enclosure->upper - r.enclosure->lower, bound_rel * r.diagonal * (1 + 1e-12) + tiny);
    EXPECT_GE(r.enclosure->upper, r.hausdorff.value);
    return *r.enclosure;
}

void expect_encloses(const DistanceEnclosure& e, double distance) {
    EXPECT_LE(e.lower, distance);
    EXPECT_GE(e.upper, distance);
}

PolygonSoup joined(PolygonSoup a, const PolygonSoup& b) {
    const auto first = static_cast<std::uint32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const std::uint32_t v : b.corners) a.corners.push_back(first + v);
    return a;
}

TEST(Enclosure, IsAbsentUnlessAskedFor) {
    EXPECT_FALSE(measure_distance(grid_soup(1), grid_soup(2), bounded(0)).enclosure);
}

TEST(Enclosure, HoldsWhereTheDistanceIsKnown) {
    for (const double width : {1e-2, 1e-5, 1e-9}) {
        SCOPED_TRACE(width);
        expect_encloses(enclose(grid_soup(4), grid_soup(3, 4.0 / 3, 0.5), width), 0.5);
        expect_encloses(enclose(grid_soup(7), grid_soup(5, 7.0 / 5), width), 0);
        PolygonSoup inner = grid_soup(1, 2);
        for (Vec3& p : inner.points) p = p + Vec3{2, 2, 0};
        expect_encloses(enclose(inner, grid_soup(3, 2), width), std::sqrt(8.0));
        const PolygonSoup point = soup_of({{0, 0, 0}}, {0, 0, 0}),
                          segment = soup_of({{3, 4, 0}, {3, -4, 0}}, {0, 1, 1});
        expect_encloses(enclose(segment, point, width), 5);
    }
}

TEST(Enclosure, FollowsARidgeBetweenTwoSheets) {
    // Points of the tilted square halfway between the sheets are at distance 1: a whole line of them.
    const auto sheet = [](std::uint32_t n, double height) { return grid_soup(n, 8.0 / n, height); };
    const PolygonSoup sheets = joined(sheet(9, -1), sheet(7, 1));
    PolygonSoup tilted = grid_soup(5);
    for (Vec3& p : tilted.points) p = {p.x + 1, p.y + 1.1, 0.36 * p.y - 0.85 + 0.01 * p.x};
    const DistanceReport r = measure_distance(joined(sheets, tilted), sheets, bounded(1e-8));
    EXPECT_TRUE(r.enclosure->reached);
    expect_encloses(*r.enclosure, 1);
    EXPECT_LT(r.enclosure->pieces, 5000U);  // some 10^8 without cuts between sheets
}

TEST(Enclosure, OfEveryFamilyToItselfHoldsZero) {
    for (const test::NamedSoup& family : test::families(100)) {
        SCOPED_TRACE(family.name);
        const DistanceEnclosure e = enclose(family.soup, family.soup, 1e-6);
        EXPECT_EQ(e.lower, 0);
    }
}

TEST(Enclosure, HoldsAndNarrowsOnRandomSurfaces) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(seed);
        const PolygonSoup a = torus_soup(7, 5, 0.2, seed), b = torus_soup(6, 9, 0.2, seed + 100);
        const double sampled = measure_distance(a, b, bounded(0, 50'000)).hausdorff.value;
        double lower = 0, upper = 1e9;
        for (const double width : {0.1, 1e-2, 1e-4, 1e-7, 1e-10}) {
            const DistanceEnclosure e = enclose(a, b, width);
            EXPECT_GE(e.upper, sampled);
            EXPECT_LE(e.lower, sampled * 1.05);
            EXPECT_GE(e.upper, lower);  // every interval meets every other
            EXPECT_LE(e.lower, upper);
            lower = std::max(lower, e.lower);
            upper = std::min(upper, e.upper);
        }
    }
}

TEST(Enclosure, ExchangeScaleAndThreadsChangeNothing) {
    const PolygonSoup a = torus_soup(40, 31, 0.1, 1), b = torus_soup(35, 33, 0.1, 2);
    Context one({}, 1), four({}, 4);
    const DistanceReport r = measure_distance(a, b, bounded(1e-5), &one);
    const DistanceReport threads = measure_distance(a, b, bounded(1e-5), &four);
    const DistanceReport scale = measure_distance(scaled(a, 700), scaled(b, 700), bounded(1e-5));
    EXPECT_EQ(threads.enclosure->lower, r.enclosure->lower);
    EXPECT_EQ(threads.enclosure->upper, r.enclosure->upper);
    EXPECT_EQ(threads.enclosure->pieces, r.enclosure->pieces);
    EXPECT_EQ(scale.enclosure->lower_percent, r.enclosure->lower_percent);
    EXPECT_EQ(scale.enclosure->upper_percent, r.enclosure->upper_percent);
    const DistanceReport exchanged = measure_distance(b, a, bounded(1e-5));
    EXPECT_GE(exchanged.enclosure->upper, r.enclosure->lower);
    EXPECT_GE(r.enclosure->upper, exchanged.enclosure->lower);
}

TEST(Enclosure, SaysSoWhenTheWorkIsBounded) {
    const PolygonSoup a = torus_soup(40, 31, 0.1, 1), b = torus_soup(35, 33, 0.1, 2);
    DistanceOptions options = bounded(1e-6);
    const DistanceEnclosure full = *measure_distance(a, b, options).enclosure;
    double width = 1e9;
    for (const std::size_t pieces : {std::size_t{1}, full.pieces / 4, full.pieces / 2}) {
        options.max_pieces = pieces;
        const DistanceEnclosure e = *measure_distance(a, b, options).enclosure;
        EXPECT_FALSE(e.reached);
        EXPECT_LE(e.lower, full.upper);
        EXPECT_GE(e.upper, full.lower);
        EXPECT_LE(e.upper - e.lower, width);  // more work, narrower
        width = e.upper - e.lower;
    }
}

TEST(Enclosure, WidthBeyondTheResolutionOfDoublesIsNotReached) {
    const DistanceReport r = measure_distance(grid_soup(2), grid_soup(2, 1, 0.3), bounded(1e-16));
    EXPECT_FALSE(r.enclosure->reached);
    expect_encloses(*r.enclosure, 0.3);
    EXPECT_LT(r.enclosure->upper - r.enclosure->lower, 1e-11);
}

TEST(Enclosure, CancelledCallHoldsAllTheSame) {
    Context context;
    context.cancel();
    const DistanceReport r = measure_distance(grid_soup(2), grid_soup(2, 1, 0.3), bounded(1e-3), &context);
    EXPECT_FALSE(r.complete);
    EXPECT_FALSE(r.enclosure->reached);
    expect_encloses(*r.enclosure, 0.3);
}

}  // namespace
}  // namespace delmesh
