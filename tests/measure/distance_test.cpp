#include "delmesh/measure/distance.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "measure/meshes.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace delmesh {
namespace {

using namespace delmesh::testing;

DistanceOptions few(std::size_t samples = 2000) {
    DistanceOptions options;
    options.min_samples = samples;
    options.samples_per_face = 1;
    return options;
}

PolygonSoup moved(PolygonSoup soup, const Vec3& by) {
    for (Vec3& p : soup.points) p = p + by;
    return soup;
}

void expect_identical(const DistanceFigure& a, const DistanceFigure& b) {
    EXPECT_EQ(a.value, b.value);
    EXPECT_EQ(a.percent, b.percent);
    EXPECT_EQ(a.forward, b.forward);
    EXPECT_EQ(a.backward, b.backward);
}

void expect_identical(const DistanceReport& a, const DistanceReport& b) {
    expect_identical(a.hausdorff, b.hausdorff);
    expect_identical(a.mean, b.mean);
    expect_identical(a.rms, b.rms);
    EXPECT_EQ(a.at.on_a, b.at.on_a);
    EXPECT_EQ(a.at.on_b, b.at.on_b);
    EXPECT_EQ(a.samples, b.samples);
    EXPECT_EQ(a.diagonal, b.diagonal);
}

TEST(Distance, OfEveryFamilyToItselfIsZero) {
    for (const test::NamedSoup& family : test::families()) {
        SCOPED_TRACE(family.name);
        const DistanceReport r = measure_distance(family.soup, family.soup, few(500));
        EXPECT_EQ(r.hausdorff.value, 0);
        EXPECT_EQ(r.mean.value, 0);
        EXPECT_EQ(r.rms.value, 0);
        EXPECT_EQ(r.hausdorff.percent, 0);
        EXPECT_TRUE(r.complete);
    }
}

TEST(Distance, DoesNotDependOnTheTriangulation) {
    // A square in two triangles, and in 800.
    const DistanceReport r = measure_distance(grid_soup(1, 20), grid_soup(20), few());
    EXPECT_EQ(r.hausdorff.value, 0);
}

TEST(Distance, OfParallelSquares) {
    const DistanceReport r = measure_distance(grid_soup(4), grid_soup(4, 1, 0.5), few());
    for (const DistanceFigure& figure : {r.hausdorff, r.mean, r.rms}) {
        EXPECT_NEAR(figure.forward, 0.5, 1e-14);
        EXPECT_NEAR(figure.backward, 0.5, 1e-14);
        EXPECT_NEAR(figure.percent, 100 * 0.5 / std::sqrt(32.0), 1e-11);
    }
    EXPECT_NEAR(r.diagonal, std::sqrt(32.0), 1e-14);
    EXPECT_NEAR(norm(r.at.on_a - r.at.on_b), 0.5, 1e-14);
}

TEST(Distance, IsTwoSided) {
    // A square of side 2 within one of side 6 in the same plane: only the way from the large one is far.
    const PolygonSoup inner = moved(grid_soup(1, 2), {2, 2, 0}), outer = grid_soup(1, 6);
    const DistanceReport r = measure_distance(inner, outer, few(40000));
    EXPECT_EQ(r.hausdorff.forward, 0);
    EXPECT_NEAR(r.hausdorff.backward, std::sqrt(8.0), 1e-14);  // at a corner
    EXPECT_EQ(r.hausdorff.value, r.hausdorff.backward);
    EXPECT_EQ(r.mean.forward, 0);
    // Mean over the ring of width 2 (four rectangles, four corner squares) and the centre, by integration.
    const double corner = 8.0 / 3 * (std::sqrt(2.0) + std::log(1 + std::sqrt(2.0)));  // of |x| over [0,2]^2
    EXPECT_NEAR(r.mean.backward, (4 * 4.0 + 4 * corner) / 36, 2e-3);
    // RMS: over [0,2] of x^2 for the rectangles, of x^2 + y^2 for the corners.
    EXPECT_NEAR(r.rms.backward, std::sqrt((4 * 16.0 / 3 + 4 * 32.0 / 3) / 36), 2e-3);
}

TEST(Distance, OfNestedSpheres) {
    PolygonSoup unit = make_sample("icosphere", 5000), larger = unit;
    for (Vec3& p : larger.points) p = 1.25 * p;
    const DistanceReport r = measure_distance(unit, larger, few());
    const double radius = norm(unit.points[0]);
    EXPECT_NEAR(r.hausdorff.value, 0.25 * radius, 0.001 * radius);
    EXPECT_NEAR(r.mean.value, 0.25 * radius, 0.002 * radius);
    EXPECT_NEAR(norm(r.at.on_a - r.at.on_b), r.hausdorff.value, 1e-14);
}

TEST(Distance, OfTwoPointsAndOfSegments) {
    // Triangles without area are segments and points.
    const PolygonSoup point = soup_of({{0, 0, 0}}, {0, 0, 0});
    const PolygonSoup segment = soup_of({{3, 4, 0}, {3, -4, 0}, {3, 0, 0}}, {0, 1, 2});
    const DistanceReport r = measure_distance(point, segment, few());
    EXPECT_NEAR(r.hausdorff.forward, 3, 1e-15);
    EXPECT_NEAR(r.hausdorff.backward, 5, 1e-15);
    EXPECT_NEAR(r.mean.forward, 3, 1e-15);
    EXPECT_TRUE(std::isinf(r.hausdorff.percent));
    EXPECT_EQ(measure_distance(point, point, few()).hausdorff.percent, 0);
}

TEST(Distance, ExchangeOfAAndBExchangesTheDirections) {
    const PolygonSoup a = torus_soup(20, 11, 0.1, 1), b = torus_soup(15, 13, 0.1, 2);
    const DistanceReport ab = measure_distance(a, b, few()), ba = measure_distance(b, a, few());
    EXPECT_GT(ab.hausdorff.forward, 0.01);
    EXPECT_NE(ab.hausdorff.forward, ab.hausdorff.backward);
    const auto expect_exchanged = [](const DistanceFigure& s, const DistanceFigure& t) {
        EXPECT_EQ(s.forward, t.backward);
        EXPECT_EQ(s.backward, t.forward);
        EXPECT_EQ(s.value, t.value);
    };
    expect_exchanged(ab.hausdorff, ba.hausdorff);
    expect_exchanged(ab.mean, ba.mean);
    expect_exchanged(ab.rms, ba.rms);
    EXPECT_EQ(ab.at.on_a, ba.at.on_b);
    EXPECT_EQ(ab.at.on_b, ba.at.on_a);
}

TEST(Distance, ScalingByAPowerOfTwoScalesEveryBit) {
    const PolygonSoup a = torus_soup(20, 11, 0.1, 1), b = torus_soup(15, 13, 0.1, 2);
    const DistanceReport unscaled = measure_distance(a, b, few());
    for (const int e : {-990, -300, 1, 300, 1020}) {
        const DistanceReport r = measure_distance(scaled(a, e), scaled(b, e), few());
        const auto expect_scaled = [e](const DistanceFigure& s, const DistanceFigure& t) {
            EXPECT_EQ(s.forward, std::scalbn(t.forward, e));
            EXPECT_EQ(s.backward, std::scalbn(t.backward, e));
            EXPECT_EQ(s.percent, t.percent);
        };
        expect_scaled(r.hausdorff, unscaled.hausdorff);
        expect_scaled(r.mean, unscaled.mean);
        expect_scaled(r.rms, unscaled.rms);
        EXPECT_EQ(r.diagonal, std::scalbn(unscaled.diagonal, e));
    }
}

TEST(Distance, DoesNotDependOnTheNumberOfThreads) {
    const PolygonSoup a = torus_soup(150, 130, 0.01, 1), b = torus_soup(130, 140, 0.01, 2);
    Context one({}, 1);
    const DistanceReport r = measure_distance(a, b, few(20000), &one);
    for (const int threads : {2, 5}) {
        Context several({}, threads);
        expect_identical(measure_distance(a, b, few(20000), &several), r);
    }
}

TEST(Distance, SeedChangesTheSamplesButHardlyTheMean) {
    const PolygonSoup a = torus_soup(20, 11, 0.1, 1), b = torus_soup(15, 13, 0.1, 2);
    DistanceOptions other = few(20000);
    const DistanceReport r = measure_distance(a, b, other);
    other.seed = 77;
    const DistanceReport s = measure_distance(a, b, other);
    EXPECT_NE(r.mean.value, s.mean.value);
    EXPECT_NEAR(s.mean.value / r.mean.value, 1, 5e-3);
    EXPECT_NEAR(s.rms.value / r.rms.value, 1, 5e-3);
}

TEST(Distance, OfMeshesIsThatOfTheirSoups) {
    const PolygonSoup a = torus_soup(20, 11, 0.1, 1), b = torus_soup(15, 13, 0.1, 2);
    expect_identical(measure_distance(Mesh(a), Mesh(b), few()), measure_distance(a, b, few()));
}

TEST(Distance, FarFromTheOriginNothingIsLost) {
    // All differences of coordinates stay exact.
    const PolygonSoup a = grid_soup(4), b = grid_soup(4, 1, 0.5);
    const Vec3 far{0x1p40, -0x1p40, 0x1p40};
    EXPECT_NEAR(measure_distance(moved(a, far), moved(b, far), few()).hausdorff.value, 0.5, 1e-14);
}

TEST(Distance, IsolatedVerticesDoNotCount) {
    const PolygonSoup a = grid_soup(4), b = grid_soup(4, 1, 0.5);
    PolygonSoup c = a;
    c.points.push_back({1e6, 1e6, 1e6});
    expect_identical(measure_distance(c, b, few()), measure_distance(a, b, few()));
}

TEST(Distance, PolygonsAreTriangulated) {
    PolygonSoup square;
    square.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    const std::uint32_t corners[] = {0, 1, 2, 3};
    square.add_face(corners);
    EXPECT_EQ(measure_distance(square, grid_soup(4), few()).hausdorff.value, 0);
}

TEST(Distance, RefusesWhatItCanNotMeasure) {
    const PolygonSoup a = grid_soup(1);
    const auto code = [&a](const PolygonSoup& b, const DistanceOptions& options) {
        try {
            (void)measure_distance(a, b, options);
        } catch (const Error& error) {
            return error.code();
        }
        ADD_FAILURE() << "nothing was thrown";
        return ErrorCode::file_format;
    };
    EXPECT_EQ(code(PolygonSoup(), few()), ErrorCode::no_surface);
    EXPECT_EQ(code(soup_of({{0, 0, 0}}, {0, 0, 1}), few()), ErrorCode::index_out_of_range);
    EXPECT_EQ(code(soup_of({{0, NAN, 0}}, {0, 0, 0}), few()), ErrorCode::not_finite);
    DistanceOptions options = few();
    options.samples_per_face = 0;
    EXPECT_EQ(code(a, options), ErrorCode::bad_argument);
    options.samples_per_face = NAN;
    EXPECT_EQ(code(a, options), ErrorCode::bad_argument);
}

TEST(Distance, CancelledCallSaysSo) {
    Context context;
    context.cancel();
    EXPECT_FALSE(measure_distance(grid_soup(4), grid_soup(5), few(), &context).complete);
}

}  // namespace
}  // namespace delmesh
