#include "delmesh/mesh/validate.hpp"

#include "delmesh/mesh/shapes.hpp"
#include "mesh/editor.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace delmesh {
namespace {

Mesh open_mesh() {
    return Mesh(make_sample("terrain", 60));
}

TEST(Validate, AcceptsWhatWasBuilt) {
    for (const test::NamedSoup& named : test::families()) EXPECT_EQ(validate(Mesh(named.soup)), "") << named.name;
}

// Every single entry of the connectivity matters: whatever it is replaced by, the mesh is no longer valid.
TEST(Validate, SeesEachChangeOfAnOrigin) {
    for (std::size_t h = 0; h < open_mesh().halfedge_count(); ++h) {
        for (const VertexId wrong : {VertexId(0), VertexId(7), VertexId(100000), VertexId()}) {
            Mesh mesh = open_mesh();
            if (mesh.origin(HalfedgeId(h)) == wrong) continue;
            MeshEditor(mesh).origin[h] = wrong;
            EXPECT_NE(validate(mesh), "") << h << " to " << wrong.value();
        }
    }
}

TEST(Validate, SeesEachChangeOfATwin) {
    for (std::size_t h = 0; h < open_mesh().halfedge_count(); ++h) {
        for (const HalfedgeId wrong : {HalfedgeId(0), HalfedgeId(h), HalfedgeId(100000), HalfedgeId()}) {
            Mesh mesh = open_mesh();
            if (mesh.twin(HalfedgeId(h)) == wrong) continue;
            MeshEditor(mesh).twin[h] = wrong;
            EXPECT_NE(validate(mesh), "") << h << " to " << wrong.value();
        }
    }
}

TEST(Validate, SeesAWrongOutgoingHalfedge) {
    for (std::size_t v = 0; v < open_mesh().vertex_count(); ++v) {
        Mesh mesh = open_mesh();
        const HalfedgeId right = mesh.halfedge(VertexId(v));
        for (const HalfedgeId wrong : {Mesh::next(right), HalfedgeId(100000), HalfedgeId()}) {
            MeshEditor(mesh).out[v] = wrong;
            EXPECT_NE(validate(mesh), "") << v;
        }
        // In an open fan only the boundary half-edge will do, or the walk round the vertex misses faces.
        if (!mesh.twin(right).valid() && mesh.next_around(right).valid()) {
            MeshEditor(mesh).out[v] = mesh.next_around(right);
            EXPECT_NE(validate(mesh), "") << v;
        }
    }
}

TEST(Validate, SeesAPointThatIsNotFinite) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Mesh mesh = open_mesh();
        mesh.set_point(VertexId(5), {0, bad, 0});
        EXPECT_NE(validate(mesh), "");
    }
}

// Two pairs of triangles joined to a sphere in which two edges join the vertices 0 and 1: every half-edge and every fan
// is in order, and it is no mesh all the same.
TEST(Validate, SeesTwoEdgesBetweenTheSameVertices) {
    Mesh mesh(make_sample("flat-tets", 4));
    ASSERT_EQ(mesh.halfedge_count(), 12U);
    MeshEditor arrays(mesh);
    const int origins[12] = {0, 1, 2, 1, 0, 2, 1, 0, 3, 0, 1, 3};
    const int twins[12] = {6, 5, 4, 9, 2, 1, 0, 11, 10, 3, 8, 7};
    for (std::size_t h = 0; h < 12; ++h) {
        arrays.origin[h] = VertexId(origins[h]);
        arrays.twin[h] = HalfedgeId(twins[h]);
    }
    arrays.out = {HalfedgeId(0), HalfedgeId(1), HalfedgeId(2), HalfedgeId(8)};
    EXPECT_EQ(validate(mesh), "vertices 0 and 1 are joined by two edges");
}

}  // namespace
}  // namespace delmesh
