#include "simplify/faults.hpp"

#include "delmesh/measure/certificate.hpp"
#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "simplify/walk.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

TEST(Faults, AreWhatTheCertificateCounts) {
    for (const char* name : {"noisy-sphere", "torus", "needle-fans", "saddle", "terrain"}) {
        const Mesh mesh(make_sample(name, 600));
        const Certificate certificate = certify(mesh);
        EXPECT_EQ(count_faults(mesh), certificate.non_delaunay_edges + certificate.obtuse_boundary_edges) << name;
    }
}

/// A collapse predicts the faults that are counted once it is made, and looks at all the edges that it may change.
TEST(Faults, AroundAStarChangeAsInTheWholeMesh) {
    std::size_t changed = 0;
    std::size_t open = 0;
    for (const char* name : {"noisy-sphere", "terrain"}) {
        const Mesh mesh(make_sample(name, 300));
        const double scale = local_scale(mesh);
        const std::size_t all = count_faults(mesh);
        for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
            const HalfedgeId h(i);
            Star star;
            if (!mesh.names_edge(h) || !gather(mesh, h, scale, star)) continue;
            const Vec3 w = star.v_point * 0.5;
            const std::size_t before = count_faults(mesh, star);
            const std::size_t after = count_faults(mesh, star, w);
            Mesh merged = mesh;
            collapse(merged, h, star.frame.to_mesh(w));
            EXPECT_EQ(count_faults(merged) + before, all + after) << name << ' ' << i;
            changed += before != after ? 1 : 0;
            open += star.closed ? 0 : 1;
        }
    }
    EXPECT_GT(changed, 100u);
    EXPECT_GT(open, 20u);
}

}  // namespace
}  // namespace delmesh
