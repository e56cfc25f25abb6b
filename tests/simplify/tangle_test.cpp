#include "simplify/tangle.hpp"

#include "simplify/decimator.hpp"
#include "simplify/delaunay_sample.hpp"
#include "simplify/star.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

using test::delaunay_sample;

/// Each one named is joined to both ends and lies in no face at the edge; where none is named, there is none.
TEST(Tangles, AreTheVerticesThatACollapseWouldPinchAt) {
    std::size_t tangles = 0;
    std::size_t free = 0;
    for (const char* name : {"torus", "plate", "terrain", "many-parts", "thin-helix"}) {
        Mesh mesh = delaunay_sample(name, 300);
        Decimator decimator(mesh, Tuning{});
        decimator.run(1);
        const std::vector<VertexId> third = find_tangles(mesh);
        ASSERT_EQ(third.size(), mesh.halfedge_count());
        for (std::size_t i = 0; i < third.size(); ++i) {
            const HalfedgeId h(i);
            if (!mesh.origin(h).valid() || !mesh.names_edge(h)) {
                EXPECT_FALSE(third[i].valid());
                continue;
            }
            const auto pinches = [&](VertexId x) {
                const HalfedgeId t = mesh.twin(h);
                return mesh.halfedge(x).valid() && x != mesh.apex(h) && !(t.valid() && x == mesh.apex(t)) &&
                       mesh.are_joined(x, mesh.origin(h)) && mesh.are_joined(x, mesh.target(h));
            };
            bool any = false;
            for (std::size_t v = 0; v < mesh.vertex_count(); ++v) any = any || pinches(VertexId(v));
            EXPECT_EQ(third[i].valid(), any) << name;
            ++(any ? tangles : free);
            if (!any) continue;
            EXPECT_TRUE(third[i].valid() && pinches(third[i])) << name;
            Star star;
            EXPECT_FALSE(gather(mesh, h, decimator.scale(), star)) << name;
        }
    }
    EXPECT_GT(tangles, 20u);
    EXPECT_GT(free, 20u);
}

}  // namespace
}  // namespace delmesh
