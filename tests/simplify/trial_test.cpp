#include "simplify/trial.hpp"

#include "delmesh/measure/certificate.hpp"
#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/validate.hpp"
#include "simplify/decimator.hpp"
#include "simplify/delaunay_sample.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace delmesh {
namespace {

constexpr double huge = std::numeric_limits<double>::max();

class TrialOf : public testing::TestWithParam<const char*> {
protected:
    TrialOf() : mesh(test::delaunay_sample(GetParam(), 1500)), decimator(mesh, tuning) {
        decimator.follow_samples(mesh.vertex_count(), 1'000'000);
        decimator.run(mesh.vertex_count() / 6);
    }
    [[nodiscard]] Trial make() {
        return {mesh, decimator.samples(), placer, decimator.scale(), [](const Vec3& w) { return w; }};
    }
    [[nodiscard]] Mesh living() const {
        Mesh copy = mesh;
        compact(copy);
        return copy;
    }
    /// Every edge inside, with a collapse to its middle or an insertion.
    template <class Done>
    std::size_t try_all(Trial& trial, bool inserts, const TrialLimits& limits, Done&& done) {
        std::size_t successes = 0;
        Star star;
        for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
            const HalfedgeId h(i);
            if (!mesh.origin(h).valid() || !mesh.names_edge(h) || mesh.is_boundary(h)) continue;
            if (inserts) {
                if (!trial.insert(h, limits)) continue;
            } else {
                if (mesh.is_boundary(mesh.origin(h)) || mesh.is_boundary(mesh.target(h))) continue;
                if (!gather(mesh, h, decimator.scale(), star)) continue;
                if (!trial.collapse(star, h, star.v_point * 0.5, limits)) continue;
            }
            ++successes;
            done(h);
        }
        return successes;
    }

    Tuning tuning;
    Mesh mesh;
    Decimator decimator;
    Placer placer{mesh, tuning};
};

TEST_P(TrialOf, UndoneLeavesNoTrace) {
    Trial trial = make();
    const std::uint64_t bits = test::hash_bits(to_soup(mesh));
    const double sum = decimator.samples().sum();
    for (const bool around : {false, true}) {
        for (const bool inserts : {false, true}) {
            const std::size_t successes =
                try_all(trial, inserts, {inserts ? 0 : huge, huge, around}, [&](HalfedgeId h) {
                    EXPECT_NEAR(decimator.samples().sum(), sum + trial.change(), 1e-9 * sum) << h.value();
                    trial.undo();
                });
            EXPECT_GT(successes, 50u);
        }
    }
    EXPECT_EQ(test::hash_bits(to_soup(mesh)), bits);
    EXPECT_NEAR(decimator.samples().sum(), sum, 1e-9 * sum);
    double of_faces = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) of_faces += decimator.samples().error(FaceId(f));
    EXPECT_NEAR(of_faces, sum, 1e-9 * sum) << "none is lost";
}

/// The same insertions, one by one, are worth more when the vertices around give way.
TEST_P(TrialOf, FittingAroundFindsMoreGain) {
    Trial trial = make();
    double alone = 0;
    double together = 0;
    const auto undone = [&](double& sum) {
        return [&](HalfedgeId) {
            sum += trial.change();
            trial.undo();
        };
    };
    const std::size_t few = try_all(trial, true, {0, huge}, undone(alone));
    const std::size_t many = try_all(trial, true, {0, huge, true}, undone(together));
    EXPECT_GE(many + many / 50, few) << "what gives way may also come too near";
    EXPECT_LT(together, 1.05 * alone) << "both are negative";
}

TEST_P(TrialOf, KeptKeepsTheMeshDelaunayAndTheLimits) {
    Trial trial = make();
    SurfaceSamples& samples = decimator.samples();
    for (const bool inserts : {true, false}) {
        const TrialLimits limits{inserts ? 0 : 0.02 * samples.sum(), 9 * samples.mean2(), GetParam()[0] == 't'};
        const test::SurfaceFacts before = test::examine(to_soup(living()));
        const std::size_t kept = try_all(trial, inserts, limits, [&](HalfedgeId) {
            EXPECT_LT(trial.change(), limits.most);
            trial.keep();
        });
        EXPECT_GT(kept, 10u);
        const Mesh result = living();
        EXPECT_EQ(validate(result), "");
        EXPECT_TRUE(certify(result).certified);
        const test::SurfaceFacts after = test::examine(to_soup(result));
        EXPECT_EQ(after.euler, before.euler);
        EXPECT_EQ(after.components, before.components);
        EXPECT_EQ(after.boundary_loops, before.boundary_loops);
    }
}

TEST_P(TrialOf, ThatFailsChangesNothing) {
    Trial trial = make();
    const std::uint64_t bits = test::hash_bits(to_soup(mesh));
    const double sum = decimator.samples().sum();
    for (const bool inserts : {false, true}) EXPECT_EQ(try_all(trial, inserts, {-huge, 0}, [](HalfedgeId) {}), 0u);
    EXPECT_EQ(test::hash_bits(to_soup(mesh)), bits);
    EXPECT_NEAR(decimator.samples().sum(), sum, 1e-9 * sum);
}

INSTANTIATE_TEST_SUITE_P(All, TrialOf, testing::Values("torus", "terrain", "noisy-sphere"));

}  // namespace
}  // namespace delmesh
