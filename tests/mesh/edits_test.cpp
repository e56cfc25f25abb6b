#include "delmesh/mesh/edits.hpp"

#include "delmesh/mesh/validate.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

namespace delmesh {
namespace {

PolygonSoup grid(std::uint32_t n, bool closed) {
    PolygonSoup soup;
    const std::uint32_t side = closed ? n : n + 1;
    for (std::uint32_t j = 0; j < side; ++j)
        for (std::uint32_t i = 0; i < side; ++i)
            soup.points.push_back({static_cast<double>(i), static_cast<double>(j), 0});
    const auto at = [side](std::uint32_t i, std::uint32_t j) { return (j % side) * side + i % side; };
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i)
            for (const std::uint32_t v :
                 {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
                soup.corners.push_back(v);
    return soup;
}

long long euler(const Mesh& mesh) {
    std::set<VertexId> used(mesh.corners().begin(), mesh.corners().end());
    used.erase(VertexId());
    long long faces = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) faces += mesh.is_live(FaceId(f)) ? 1 : 0;
    return static_cast<long long>(used.size()) - static_cast<long long>(mesh.count_edges()) + faces;
}

std::size_t boundary_edges(const Mesh& mesh) {
    std::size_t count = 0;
    for (std::size_t h = 0; h < mesh.halfedge_count(); ++h)
        if (mesh.is_live(Mesh::face(HalfedgeId(h))) && mesh.is_boundary(HalfedgeId(h))) ++count;
    return count;
}

class Edits : public testing::TestWithParam<bool> {};

TEST_P(Edits, RandomFlipsAndSplitsKeepEverything) {
    Mesh mesh(grid(6, GetParam()));
    const long long chi = euler(mesh);
    test::Random random{1};
    std::size_t flips = 0;
    for (int step = 0; step < 3000; ++step) {
        const HalfedgeId h(random.below(mesh.halfedge_count()));
        if (step % 10 == 0) {
            ASSERT_TRUE(can_split(mesh, h));
            split_edge(mesh, h, {0.5 * step, 1, 2});
        } else if (can_flip(mesh, h)) {
            flip(mesh, h);
            ++flips;
        }
        ASSERT_EQ(validate(mesh), "") << "after step " << step;
    }
    EXPECT_GT(flips, 1000u);
    EXPECT_EQ(euler(mesh), chi);
}

TEST_P(Edits, RandomCollapsesKeepTopology) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        Mesh mesh(grid(7, GetParam()));
        const long long chi = euler(mesh);
        const bool closed = GetParam();
        test::Random random{seed};
        std::size_t collapses = 0;
        for (int step = 0; step < 4000; ++step) {
            const HalfedgeId h(random.below(mesh.halfedge_count()));
            if (!mesh.is_live(Mesh::face(h)) || !can_collapse(mesh, h)) continue;
            collapse(mesh, h, {1, 2, 3});
            ++collapses;
            ASSERT_EQ(validate(mesh), "") << "seed " << seed << " step " << step;
            ASSERT_EQ(euler(mesh), chi);
        }
        EXPECT_GT(collapses, 20u);
        if (!closed) {
            EXPECT_GE(boundary_edges(mesh), 3u);
        }
        Mesh other = mesh;
        CompactMap map = compact(mesh);
        EXPECT_EQ(validate(mesh), "");
        EXPECT_EQ(euler(mesh), chi);
        // The same, the other way round.
        for (VertexId& v : map.vertex)
            if (v.valid()) v = VertexId(mesh.vertex_count() - 1 - v.index());
        for (FaceId& f : map.face)
            if (f.valid()) f = FaceId(mesh.face_count() - 1 - f.index());
        renumber(other, map);
        EXPECT_EQ(validate(other), "");
        ASSERT_EQ(other.face_count(), mesh.face_count());
        for (std::size_t h = 0; h < mesh.halfedge_count(); ++h) {
            const std::size_t there = 3 * (mesh.face_count() - 1 - h / 3) + h % 3;
            EXPECT_EQ(other.origin(HalfedgeId(there)).index(),
                      mesh.vertex_count() - 1 - mesh.origin(HalfedgeId(h)).index());
        }
        if (closed) {
            EXPECT_LE(mesh.vertex_count(), 9u) << "a torus goes down to seven or little more";
        }
        if (!closed) {
            EXPECT_EQ(mesh.face_count(), 1u) << "a disk goes down to one triangle";
        }
    }
}

TEST_P(Edits, AllowedExactlyWhereTheResultIsAMesh) {
    // can_collapse must agree with trying it on the soup: merge, drop the two faces, build.
    Mesh mesh(grid(3, GetParam()));
    test::Random random{7};
    for (int round = 0; round < 60; ++round) {
        for (std::size_t i = 0; i < mesh.halfedge_count(); ++i) {
            const HalfedgeId h(i);
            PolygonSoup soup = to_soup(mesh);
            const std::uint32_t kept = mesh.origin(h).value();
            const std::uint32_t gone = mesh.target(h).value();
            std::vector<std::uint32_t> corners;
            for (std::size_t f = 0; f < mesh.face_count(); ++f) {
                std::array<std::uint32_t, 3> c{soup.corners[3 * f], soup.corners[3 * f + 1], soup.corners[3 * f + 2]};
                for (std::uint32_t& v : c)
                    if (v == gone) v = kept;
                if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) corners.insert(corners.end(), c.begin(), c.end());
            }
            const std::size_t faces_lost = mesh.is_boundary(h) ? 1 : 2;
            bool builds = corners.size() / 3 + faces_lost == mesh.face_count();
            soup.corners = corners;
            try {
                const Mesh result(soup);
                builds = builds && euler(result) == euler(mesh) &&
                         (boundary_edges(result) > 0) == (boundary_edges(mesh) > 0);
            } catch (const std::exception&) {
                builds = false;
            }
            if (can_collapse(mesh, h)) {
                EXPECT_TRUE(builds) << "round " << round << " half-edge " << i;
            } else if (GetParam()) {
                EXPECT_FALSE(builds && mesh.face_count() > 4 && corners.size() / 3 >= 4)
                    << "round " << round << " half-edge " << i;
            }
        }
        const HalfedgeId h(random.below(mesh.halfedge_count()));
        if (can_flip(mesh, h)) flip(mesh, h);
    }
}

INSTANTIATE_TEST_SUITE_P(OpenAndClosed, Edits, testing::Bool(),
                         [](const auto& mode) { return mode.param ? "Torus" : "Disk"; });

TEST(Flip, MovesHalfedgesAsDocumented) {
    Mesh mesh(grid(4, true));
    const HalfedgeId h(9);
    const HalfedgeId t = mesh.twin(h);
    const HalfedgeId hp = Mesh::prev(h);
    const HalfedgeId tp = Mesh::prev(t);
    const VertexId p = mesh.origin(h);
    const VertexId q = mesh.target(h);
    const VertexId u = mesh.apex(h);
    const VertexId v = mesh.apex(t);
    const HalfedgeId beyond_v = mesh.twin(tp);
    const HalfedgeId beyond_u = mesh.twin(hp);
    ASSERT_TRUE(can_flip(mesh, h));
    EXPECT_EQ(flip(mesh, h), hp);
    EXPECT_EQ(mesh.origin(hp), u);
    EXPECT_EQ(mesh.target(hp), v);
    EXPECT_EQ(mesh.twin(hp), tp);
    EXPECT_EQ(mesh.origin(h), v);
    EXPECT_EQ(mesh.target(h), q);
    EXPECT_EQ(mesh.twin(h), beyond_v);
    EXPECT_EQ(mesh.origin(t), u);
    EXPECT_EQ(mesh.target(t), p);
    EXPECT_EQ(mesh.twin(t), beyond_u);
}

TEST(Flip, RefusesBoundaryAndExistingEdge) {
    Mesh open(grid(2, false));
    for (std::size_t h = 0; h < open.halfedge_count(); ++h)
        if (open.is_boundary(HalfedgeId(h))) {
            EXPECT_FALSE(can_flip(open, HalfedgeId(h)));
        }
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    soup.corners = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
    const Mesh tetrahedron(soup);
    for (std::size_t h = 0; h < 12; ++h) EXPECT_FALSE(can_flip(tetrahedron, HalfedgeId(h)));
}

TEST(Split, RefusesTwoEqualApexes) {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    soup.corners = {0, 1, 2, 2, 1, 0};
    const Mesh mesh(soup);
    for (std::size_t h = 0; h < 6; ++h) {
        EXPECT_FALSE(can_split(mesh, HalfedgeId(h)));
        EXPECT_FALSE(can_flip(mesh, HalfedgeId(h)));
    }
}

TEST(Split, NamesItsFacesAsDocumented) {
    for (const bool closed : {false, true}) {
        Mesh mesh(grid(4, closed));
        for (std::size_t i = 0; i < 40; ++i) {
            const HalfedgeId h(i);
            const VertexId p = mesh.origin(h);
            const VertexId q = mesh.target(h);
            const VertexId u = mesh.apex(h);
            const HalfedgeId t = mesh.twin(h);
            const VertexId v = t.valid() ? mesh.apex(t) : VertexId();
            const HalfedgeId first(mesh.halfedge_count());
            const VertexId s = split_edge(mesh, h, {1, 2, 3});
            EXPECT_EQ(mesh.target(h), s);
            EXPECT_EQ(mesh.origin(h), p);
            EXPECT_EQ(mesh.origin(first), s);
            EXPECT_EQ(mesh.target(first), q);
            EXPECT_EQ(mesh.apex(first), u);
            ASSERT_EQ(validate(mesh), "");
            if (!t.valid()) continue;
            const HalfedgeId second(first.value() + 3);
            EXPECT_EQ(mesh.origin(second), q);
            EXPECT_EQ(mesh.apex(second), v);
            EXPECT_EQ(mesh.twin(first), second);
            EXPECT_EQ(mesh.twin(h), t);
        }
    }
}

TEST(RemoveFace, TakesOffAFaceAtTheBoundary) {
    Mesh mesh(grid(4, false));
    std::size_t removed = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (!mesh.is_live(FaceId(f)) || !can_remove_face(mesh, FaceId(f))) continue;
        remove_face(mesh, FaceId(f));
        ++removed;
        ASSERT_EQ(validate(mesh), "") << f;
    }
    EXPECT_GT(removed, 4u);
    EXPECT_EQ(euler(mesh), 1);
    compact(mesh);
    EXPECT_EQ(validate(mesh), "");
}

}  // namespace
}  // namespace delmesh
