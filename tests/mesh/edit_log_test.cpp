#include "mesh/edit_log.hpp"

#include "delmesh/mesh/edits.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "delmesh/mesh/validate.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

namespace delmesh {
namespace {

/// All that a mesh says, as numbers.
std::vector<std::uint64_t> content(const Mesh& mesh) {
    std::vector<std::uint64_t> all;
    for (std::size_t h = 0; h < mesh.halfedge_count(); ++h) {
        all.push_back(mesh.origin(HalfedgeId(h)).value());
        all.push_back(mesh.twin(HalfedgeId(h)).value());
    }
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        all.push_back(mesh.halfedge(VertexId(v)).value());
        for (int axis = 0; axis < 3; ++axis) all.push_back(std::bit_cast<std::uint64_t>(mesh.points()[v][axis]));
    }
    return all;
}

/// One edit at a half-edge drawn, if any is allowed there.
bool edit(Mesh& mesh, EditLog& log, test::Random& random) {
    const HalfedgeId h(random.below(mesh.halfedge_count()));
    if (!mesh.origin(h).valid()) return false;
    const Vec3 point{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
    switch (random.below(4)) {
        case 0:
            if (!can_flip(mesh, h)) return false;
            log.flip(h);
            return true;
        case 1:
            if (!can_collapse(mesh, h)) return false;
            log.collapse(h, point);
            return true;
        case 2:
            if (!can_split(mesh, h)) return false;
            log.split_edge(h, point);
            return true;
        default:
            log.set_point(mesh.origin(h), point);
            return true;
    }
}

class EditLogOf : public testing::TestWithParam<const char*> {};

TEST_P(EditLogOf, TakesBackAllThatCameAfterKeep) {
    Mesh mesh(make_sample(GetParam(), 200));
    EditLog log(mesh);
    test::Random random(3);
    std::size_t edits = 0;
    for (int round = 0; round < 200; ++round) {
        log.keep();
        const std::vector<std::uint64_t> before = content(mesh);
        const std::size_t most = 1 + random.below(8);
        for (std::size_t i = 0; i < most; ++i) edits += edit(mesh, log, random) ? 1 : 0;
        if (round % 4 == 0) continue;
        log.undo();
        ASSERT_EQ(content(mesh), before) << round;
    }
    EXPECT_GT(edits, 300u);
    compact(mesh);
    EXPECT_EQ(validate(mesh), "");
}

TEST_P(EditLogOf, NamesTheFacesThatHaveChanged) {
    Mesh mesh(make_sample(GetParam(), 200));
    EditLog log(mesh);
    test::Random random(5);
    for (int round = 0; round < 100; ++round) {
        log.keep();
        const Mesh before = mesh;
        for (int i = 0; i < 3; ++i) edit(mesh, log, random);
        std::vector<bool> named(mesh.face_count());
        for (const FaceId f : log.changed()) named[f.index()] = true;
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            if (named[f]) continue;
            for (std::size_t i = 3 * f; i < 3 * f + 3; ++i)
                ASSERT_EQ(mesh.corners()[i], before.corners()[i]) << "face " << f << ", round " << round;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, EditLogOf, testing::Values("torus", "terrain", "noisy-sphere"));

}  // namespace
}  // namespace delmesh
