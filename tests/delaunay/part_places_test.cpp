#include "delmesh/delaunay/part_places.hpp"

#include "delaunay/preserve_check.hpp"
#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/mesh/coincident.hpp"
#include "delmesh/mesh/rounding.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "delmesh/mesh/validate.hpp"
#include "support/families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

namespace delmesh {
namespace {

using test::check_delaunay;

/// The shape so many times at its place, each with vertices of its own.
Mesh repeated(const char* name, std::size_t faces, int times) {
    PolygonSoup one = make_sample(name, faces);
    triangulate(one);
    round_to_float(one);
    PolygonSoup soup;
    for (int k = 0; k < times; ++k) {
        const auto offset = static_cast<std::uint32_t>(soup.points.size());
        soup.points.insert(soup.points.end(), one.points.begin(), one.points.end());
        for (std::size_t f = 0; f < one.face_count(); ++f)
            soup.add_face(std::array{one.corners[3 * f] + offset, one.corners[3 * f + 1] + offset,
                                     one.corners[3 * f + 2] + offset});
    }
    return Mesh(std::move(soup));
}

TEST(PartPlaces, KeepsADelaunayMeshAndMovesByTheLastBits) {
    for (const char* name : {"icosphere", "grid", "noisy-sphere", "plate"}) {
        Mesh mesh = repeated(name, 500, 3);
        RemeshOptions options;
        options.precision = Precision::float32;
        ASSERT_EQ(make_delaunay(mesh, options).stop, StopReason::done) << name;
        const Mesh before = mesh;
        const std::size_t touching = find_coincident(to_soup(mesh)).size();
        ASSERT_GT(touching, mesh.vertex_count() / 3);
        const Parting parting = part_places(mesh);
        EXPECT_EQ(validate(mesh), "");
        EXPECT_EQ(check_delaunay(mesh), "") << name;
        EXPECT_EQ(find_coincident(to_soup(mesh)).size(), parting.left.size()) << name;
        EXPECT_EQ(parting.moved + parting.left.size(), touching) << name;
        // Where all around a vertex is co-circular, it may have nowhere to go.
        const bool is_flat = std::string_view(name) == "grid" || std::string_view(name) == "plate";
        EXPECT_LE(parting.left.size(), is_flat ? touching / 50 : 0U) << name;
        double largest = 0;
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
            const Vec3& p = mesh.point(VertexId(v));
            EXPECT_EQ(round_to_float(p), p);
            largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
            EXPECT_LE(norm(p - before.point(VertexId(v))), parting.furthest);
        }
        EXPECT_LE(parting.furthest, 6 * 0x1p-23 * largest);
    }
}

TEST(PartPlaces, LeavesAMeshAloneWhoseVerticesAreApart) {
    Mesh mesh = repeated("icosphere", 300, 1);
    const Mesh before = mesh;
    EXPECT_EQ(part_places(mesh).moved, 0U);
    EXPECT_EQ(std::memcmp(mesh.points().data(), before.points().data(), before.points().size_bytes()), 0);
}

TEST(PartPlaces, SaysWhatItCanNotPart) {
    // All of these have one place, and there are more of them than places within three steps.
    Mesh mesh = repeated("grid", 2, 400);
    const Parting parting = part_places(mesh);
    EXPECT_FALSE(parting.left.empty());
    EXPECT_EQ(find_coincident(to_soup(mesh)).size(), parting.left.size());
    for (const auto& [owner, other] : parting.left) EXPECT_EQ(mesh.point(owner), mesh.point(other));
    EXPECT_EQ(check_delaunay(mesh), "");
}

}  // namespace
}  // namespace delmesh
