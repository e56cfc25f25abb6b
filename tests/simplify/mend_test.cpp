#include "simplify/mend.hpp"

#include "delmesh/measure/certificate.hpp"
#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "delmesh/mesh/validate.hpp"
#include "delmesh/simplify/simplify.hpp"
#include "simplify/least_vertices.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

namespace delmesh {
namespace {

Mesh stretched_sphere(std::size_t faces, double by) {
    Mesh mesh(make_sample("icosphere", faces));
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        Vec3 p = mesh.point(VertexId(v));
        p.z *= by;
        mesh.set_point(VertexId(v), p);
    }
    return mesh;
}

void expect_mended(Mesh mesh, std::size_t vertices, const std::string& name) {
    ASSERT_FALSE(certify(mesh).certified) << name;
    const test::SurfaceFacts before = test::examine(to_soup(mesh));
    Mesh again = mesh;
    EXPECT_TRUE(mend(mesh, Tuning{}, SimplifyOptions::default_remesh(), vertices, nullptr)) << name;
    EXPECT_EQ(validate(mesh), "") << name;
    EXPECT_TRUE(certify(mesh).certified) << name;
    EXPECT_LE(mesh.vertex_count(), std::max(2 * vertices, least_vertices(mesh))) << name;
    const test::SurfaceFacts after = test::examine(to_soup(mesh));
    EXPECT_EQ(after.euler, before.euler) << name;
    EXPECT_EQ(after.components, before.components) << name;
    EXPECT_EQ(after.boundary_loops, before.boundary_loops) << name;
    mend(again, Tuning{}, SimplifyOptions::default_remesh(), vertices, nullptr);
    EXPECT_EQ(test::hash_bits(to_soup(again)), test::hash_bits(to_soup(mesh))) << name;
}

TEST(Mend, NeedlesBecomeDelaunayWithoutAPointMore) {
    for (const double by : {32.0, 1e3, 1e6}) expect_mended(stretched_sphere(1280, by), 64, std::to_string(by));
}

TEST(Mend, PartsThatAreFlatGetSomeHeight) {
    expect_mended(Mesh(make_sample("flat-tets", 400)), 50, "flat-tets");
}

TEST(Mend, KeepsHolesAndHandles) {
    expect_mended(Mesh(make_sample("needle-fans", 400)), 60, "needle-fans");
    expect_mended(Mesh(make_sample("torus", 1000)), 60, "torus");
}

TEST(Mend, WhatIsStoredAsFloatIsFloat) {
    PolygonSoup soup = to_soup(stretched_sphere(1280, 1e6));
    round_to_float(soup);
    Mesh mesh(soup);
    RemeshOptions remesh = SimplifyOptions::default_remesh();
    remesh.precision = Precision::float32;
    EXPECT_TRUE(mend(mesh, Tuning{}, remesh, 64, nullptr));
    EXPECT_TRUE(certify(mesh).certified);
    for (const Vec3& p : mesh.points()) EXPECT_EQ(round_to_float(p), p);
}

}  // namespace
}  // namespace delmesh
