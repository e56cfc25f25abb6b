#include "delmesh/delaunay/provenance.hpp"

#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/shapes.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

TEST(Provenance, IsTheIdentityWhereNothingIsDone) {
    Mesh mesh(make_sample("icosphere", 320));
    const Provenance provenance = make_delaunay(mesh).provenance;
    EXPECT_EQ(provenance.input_vertices, mesh.vertex_count());
    EXPECT_TRUE(provenance.splits.empty());
    EXPECT_EQ(provenance.facet_of_face, provenance.facet_of_input_face);
}

TEST(Provenance, AttributesFollowFromIt) {
    // A linear field on the vertices, carried to the new ones by (a, b, t), is the field at their positions.
    const Mesh before(make_sample("saddle", 300));
    Mesh after = before;
    const Provenance provenance = make_delaunay(after).provenance;
    const auto field = [](const Vec3& p) { return 2 * p.x - 3 * p.y + 5 * p.z; };
    ASSERT_FALSE(provenance.splits.empty());
    for (std::size_t i = 0; i < provenance.splits.size(); ++i) {
        const SplitPoint& split = provenance.splits[i];
        const double carried = (1 - split.t) * field(before.point(split.a)) + split.t * field(before.point(split.b));
        EXPECT_NEAR(carried, field(after.points()[provenance.input_vertices + i]), 1e-12);
    }
}

}  // namespace
}  // namespace delmesh
