#include "simplify/samples.hpp"

#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "simplify/decimator.hpp"
#include "simplify/delaunay_sample.hpp"
#include "simplify/frame.hpp"
#include "simplify/sweeper.hpp"
#include "simplify/triangle_point.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace delmesh {
namespace {

/// The nearest point of all faces of the star with its centre at w, one by one.
double nearest2(const Star& star, const Vec3& w, const Vec3& p) {
    double best = -1;
    for (std::size_t i = 0; i < star.face_count(); ++i) {
        const double d = nearest_on_triangle(p, w, star.ring[i].point, star.ring[star.after(i)].point).distance2;
        if (best < 0 || d < best) best = d;
    }
    return best;
}

using test::delaunay_sample;

class SamplesOf : public testing::TestWithParam<const char*> {};

TEST_P(SamplesOf, AreMeasuredToTheNearestFaceOfTheStar) {
    Mesh mesh = delaunay_sample(GetParam(), 2000);
    SurfaceSamples samples(mesh, mesh.vertex_count(), 1, 1'000'000);
    test::Random random(7);
    Star star;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        gather(mesh, VertexId(v), 1, star);
        samples.gather(star);
        const double size = norm(star.ring[0].point);
        const auto shift = [&] { return random.real(-0.5, 0.5) * size; };
        const Vec3 w{shift(), shift(), shift()};
        const SampleError error = samples.measure(star, w);
        double worst = 0;
        for (const SurfaceSamples::Member& m : samples.members()) {
            const double expected = nearest2(star, w, m.point);
            EXPECT_NEAR(m.distance2, expected, 1e-12 * size * size);
            worst = std::max(worst, expected);
        }
        EXPECT_NEAR(error.forward, worst, 1e-12 * size * size);
        EXPECT_GE(error.worst(), error.forward);
    }
}

/// Of any faces, not only those of a star.
TEST_P(SamplesOf, FindTheNearestOfTheFacesNamed) {
    Mesh mesh = delaunay_sample(GetParam(), 2000);
    SurfaceSamples samples(mesh, mesh.vertex_count(), 1, 1'000'000);
    std::vector<FaceId> faces;
    for (std::size_t f = 0; f < mesh.face_count() && faces.size() < 40; f += 7) faces.emplace_back(f);
    test::Random random(9);
    for (const FaceId f : faces)
        for (const VertexId v : mesh.corners().subspan(3 * f.index(), 3))
            mesh.set_point(v, mesh.point(v) + Vec3{random.real(-0.1, 0.1), random.real(-0.1, 0.1), 0});
    std::vector<SurfaceSamples::Place> places;
    samples.gather(faces, places);
    ASSERT_GT(places.size(), faces.size());
    const std::vector<SurfaceSamples::Place> before = places;
    const SampleError error = samples.find_places(mesh, 1, faces, 1e300, places);
    double sum = 0;
    for (const SurfaceSamples::Place& place : places) {
        const auto distance2 = [&](FaceId f) {
            const auto v = mesh.corners().subspan(3 * f.index(), 3);
            return nearest_on_triangle(samples.point(place), mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]))
                .distance2;
        };
        double best = distance2(faces[0]);
        for (const FaceId f : faces) best = std::min(best, distance2(f));
        EXPECT_NEAR(place.distance2, best, 1e-6 * best + 1e-12);
        EXPECT_NEAR(distance2(place.face), best, 1e-6 * best + 1e-12);
        sum += samples.weight(place) * static_cast<double>(place.distance2);
    }
    EXPECT_NEAR(error.sum, sum, 1e-9 * sum);
    const double total = samples.sum();
    samples.put(faces, places);
    EXPECT_NEAR(samples.sum(), total + sum, 1e-9 * sum) << "all were on the surface";
    samples.put(faces, before);
    EXPECT_NEAR(samples.sum(), total, 1e-9 * sum);
}

/// In a plane the height says nothing about what lies beside the surface.
TEST(Samples, SeeWhatSticksOutBesideTheSurface) {
    Mesh mesh = delaunay_sample("grid", 800);
    const double scale = local_scale(mesh);
    SurfaceSamples samples(mesh, mesh.vertex_count(), scale, 1'000'000);
    std::size_t inner = 0;
    while (mesh.is_boundary(VertexId(inner))) ++inner;
    Star star;
    gather(mesh, VertexId(inner), scale, star);
    samples.gather(star);
    const Vec3 arm = star.ring[0].point;
    EXPECT_EQ(samples.measure_backward(star, {}), 0);
    EXPECT_EQ(samples.measure_backward(star, arm * 0.5), 0);
    const double far = samples.measure_backward(star, arm * 20.0);
    EXPECT_GT(far, 10 * 10 * squared_norm(arm));
    EXPECT_LT(far, 20 * 20 * squared_norm(arm));

    const std::vector<FaceId> faces{star.ring[0].face};
    const VertexId v = star.ring[0].vertex;
    std::vector<SurfaceSamples::Place> places;
    samples.gather(faces, places);
    EXPECT_EQ(samples.measure_backward(mesh, scale, faces, places, VertexId()), 0);
    mesh.set_point(v, mesh.point(v) + (mesh.point(v) - mesh.point(VertexId(inner))) * 30.0);
    EXPECT_GT(samples.measure_backward(mesh, scale, faces, places, VertexId()), 5 * 5 * squared_norm(arm));
    EXPECT_EQ(samples.measure_backward(mesh, scale, faces, places, v), 0) << "left out";
}

TEST(Samples, KnowWhereThereIsAnError) {
    Mesh mesh = delaunay_sample("torus", 2000);
    SurfaceSamples samples(mesh, mesh.vertex_count(), 1, 1'000'000);
    EXPECT_EQ(samples.busy_part(), 1) << "no error anywhere";
    Star star;
    gather(mesh, VertexId(0), 1, star);
    samples.gather(star);
    const Vec3 w = star.ring[0].old_normal * (0.1 / norm(star.ring[0].old_normal));
    (void)samples.measure(star, w);
    mesh.set_point(VertexId(0), star.frame.to_mesh(w));
    samples.commit(star);
    EXPECT_GT(samples.busy_part(), 0.0005);
    EXPECT_LT(samples.busy_part(), 0.02);
}

TEST_P(SamplesOf, AreAllKeptAndKnowTheirDistanceAfterDecimation) {
    Mesh mesh = delaunay_sample(GetParam(), 3000);
    const std::size_t faces = mesh.face_count();
    const std::size_t vertices = mesh.vertex_count();
    Decimator decimator(mesh, Tuning{});
    decimator.follow_samples(vertices, 1'000'000);
    decimator.run(vertices / 4);
    decimator.refit({});
    decimator.run(vertices / 8);
    std::size_t seen = 0;
    Star star;
    SurfaceSamples& samples = decimator.samples();
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.halfedge(VertexId(v)).valid()) continue;
        gather(mesh, VertexId(v), decimator.scale(), star);
        samples.gather(star);
        seen += samples.members().size();
        for (const SurfaceSamples::Member& m : samples.members()) {
            const TrianglePoint own =
                nearest_on_triangle(m.point, {}, star.ring[m.face].point, star.ring[star.after(m.face)].point);
            // Kept in single precision.
            EXPECT_NEAR(std::sqrt(m.distance2), std::sqrt(own.distance2), 1e-6);
        }
    }
    EXPECT_EQ(seen, 3 * (vertices + faces)) << "every sample lies on one face";
}

/// Places that single precision holds take less room than others, and no bit of either is lost.
TEST_P(SamplesOf, AreMadeAgainToTheLastBit) {
    Mesh mesh = delaunay_sample(GetParam(), 1000);
    for (std::size_t v = 0; v < mesh.vertex_count() / 2; ++v)
        mesh.set_point(VertexId(v), round_to_float(mesh.point(VertexId(v))));
    const Mesh original = mesh;
    const SampleSource source(mesh, mesh.vertex_count() - 3, 1, 700);
    const std::size_t stride = source.stride();
    ASSERT_GT(stride, 1u);
    mesh = Mesh();
    std::size_t i = 0;
    for (std::size_t v = 0; v < original.vertex_count() - 3; v += stride, ++i) {
        EXPECT_EQ(source.point(i), original.point(VertexId(v)));
        EXPECT_EQ(source.near(i), VertexId(v));
    }
    for (std::size_t f = 0; f < original.face_count(); f += stride, ++i) {
        const auto corner = [&](std::size_t k) { return original.point(original.corners()[3 * f + k]); };
        EXPECT_EQ(source.point(i), (corner(0) * (1.0 / 3) + corner(1) * (1.0 / 3)) + corner(2) * (1.0 / 3));
        EXPECT_EQ(source.face(original, i), FaceId(f));
        const Vec3 normal = cross(corner(1) - corner(0), corner(2) - corner(0));
        EXPECT_NEAR(source.facing(i).weight, 0.75 * norm(normal), 1e-6 * norm(normal));
        EXPECT_NEAR(source.facing(i).normal[2], normal.z / norm(normal), 1e-6);
    }
    EXPECT_EQ(source.size(), i);
}

/// After sweeps, which leave the samples alone, each is attached to a face that is nearly the nearest of all.
TEST_P(SamplesOf, AreFoundAgainAfterSweeps) {
    Mesh mesh = delaunay_sample(GetParam(), 3000);
    const std::size_t all = mesh.vertex_count() + mesh.face_count();
    SurfaceSamples samples(SampleSource(mesh, mesh.vertex_count(), local_scale(mesh), 1'000'000));
    Numbering numbering(mesh);
    Sweeper sweeper(mesh, Tuning{}, Precision::float64, numbering);
    sweeper.run(mesh.vertex_count() / 5, nullptr);
    const double scale = local_scale(mesh);
    samples.reattach(mesh, scale, sweeper.merged_into());
    std::size_t seen = 0;
    std::size_t nearest = 0;
    Star star;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        gather(mesh, VertexId(v), scale, star);
        samples.gather(star);
        for (const SurfaceSamples::Member& m : samples.members()) {
            const TrianglePoint own =
                nearest_on_triangle(m.point, {}, star.ring[m.face].point, star.ring[star.after(m.face)].point);
            EXPECT_NEAR(std::sqrt(m.distance2), std::sqrt(own.distance2), 1e-6);
            double least = own.distance2;
            for (std::size_t f = 0; f < mesh.face_count(); ++f) {
                const auto corner = [&](std::size_t i) {
                    return star.frame.to_local(mesh.point(mesh.corners()[3 * f + i]));
                };
                least = std::min(least, nearest_on_triangle(m.point, corner(0), corner(1), corner(2)).distance2);
            }
            nearest += std::sqrt(own.distance2) <= std::sqrt(least) + 1e-6 ? 1 : 0;
            ++seen;
        }
    }
    EXPECT_EQ(seen, 3 * all) << "every sample lies on one face";
    EXPECT_GT(static_cast<double>(nearest), 0.98 * static_cast<double>(seen));
    EXPECT_GT(samples.mean2(), 0);
}

/// Nothing is looked at as long as it can not get too far off, and then it has not.
TEST_P(SamplesOf, SlideNoFartherThanAllowed) {
    Mesh mesh = delaunay_sample(GetParam(), 600);
    SurfaceSamples samples(mesh, mesh.vertex_count(), 1, 1'000'000);
    test::Random random(5);
    Star star;
    gather(mesh, VertexId(0), 1, star);
    const double most = 0.1 * norm(star.ring[0].point);
    std::size_t slid = 0;
    std::size_t refused = 0;
    for (int round = 0; round < 8; ++round) {
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
            gather(mesh, VertexId(v), 1, star);
            const auto shift = [&] { return random.real(-0.1, 0.1) * most; };
            const Vec3 w{shift(), shift(), shift()};
            const bool slides = samples.let_slide(star, norm(w), most);
            ++(slides ? slid : refused);
            if (slides) mesh.set_point(VertexId(v), mesh.point(VertexId(v)) + w);
        }
    }
    EXPECT_EQ(samples.found(), 0u);
    EXPECT_GT(slid, mesh.vertex_count());
    EXPECT_GT(refused, 100u);
    EXPECT_EQ(samples.sum(), 0);  // as it was
    samples.freshen(mesh, 1);
    EXPECT_GT(samples.found(), mesh.vertex_count());
    EXPECT_GT(samples.sum(), 0);
    double sum = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) sum += samples.error(FaceId(f));
    EXPECT_NEAR(sum, samples.sum(), 1e-9 * sum);
    std::size_t found = 0;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        gather(mesh, VertexId(v), 1, star);
        samples.gather(star);
        found += samples.members().size();
        EXPECT_LE(samples.present().forward, most * most * (1 + 1e-6));
        const double noted = samples.present().sum;
        EXPECT_LE(samples.measure(star, {}).sum, noted * (1 + 1e-5) + 1e-15);
    }
    EXPECT_EQ(found, 3 * (mesh.vertex_count() + mesh.face_count()));  // none is lost
}

INSTANTIATE_TEST_SUITE_P(Shapes, SamplesOf, testing::Values("noisy-sphere", "terrain", "torus"));

TEST(Samples, GuardingKeepsTheWorstOneClose) {
    const auto worst = [](const char* name, double guard) {
        Mesh mesh = delaunay_sample(name, 6000);
        Tuning tuning;
        tuning.guard = guard;
        Decimator decimator(mesh, tuning);
        decimator.follow_samples(mesh.vertex_count(), 1'000'000);
        decimator.guard_for(decimator.vertices() / 20);
        decimator.run(decimator.vertices() / 20);
        double forward2 = 0;
        Star star;
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
            if (!mesh.halfedge(VertexId(v)).valid()) continue;
            gather(mesh, VertexId(v), decimator.scale(), star);
            decimator.samples().gather(star);
            forward2 = std::max(forward2, decimator.samples().present().forward);
        }
        return std::sqrt(forward2);
    };
    double guarded = 1;
    double free = 1;
    for (const char* name : {"noisy-sphere", "terrain", "noisy-surface"}) {
        guarded *= worst(name, 3);
        free *= worst(name, 0);
    }
    EXPECT_LT(guarded, 0.8 * free);
}

}  // namespace
}  // namespace delmesh
