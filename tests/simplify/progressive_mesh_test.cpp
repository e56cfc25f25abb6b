#include "delmesh/simplify/progressive_mesh.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/measure/certificate.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "delmesh/mesh/validate.hpp"
#include "support/families.hpp"
#include "support/random.hpp"
#include "support/surface_facts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace delmesh {
namespace {

/// The faces as sets of places, whatever the numbering.
std::multiset<std::array<std::array<double, 3>, 3>> surface(const Mesh& mesh) {
    std::multiset<std::array<std::array<double, 3>, 3>> faces;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::array<std::array<double, 3>, 3> face;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& p = mesh.point(mesh.corners()[3 * f + i]);
            face[i] = {p.x, p.y, p.z};
        }
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
        faces.insert(face);
    }
    return faces;
}

SimplifyOptions as_far_as_it_goes() {
    SimplifyOptions options;
    options.vertices = 1;
    return options;
}

ProgressiveMesh record(Mesh mesh, const SimplifyOptions& options = as_far_as_it_goes()) {
    ProgressiveMesh progressive;
    (void)simplify(mesh, options, progressive);
    return progressive;
}

void expect_replays(const test::NamedSoup& named, std::uint64_t seed) {
    Mesh mesh(named.soup);
    SimplifyOptions options;
    options.remesh.max_vertices = 5000;
    options.remesh.seed = seed;
    const std::size_t n = mesh.vertex_count();
    options.levels = {n, n - n / 4, n / 2 + 1, n / 4 + 1, n / 8 + 1, n / 16 + 1};
    std::map<std::size_t, std::multiset<std::array<std::array<double, 3>, 3>>> seen;
    options.on_level = [&](const Mesh& coarse, const LevelReport& level) { seen[level.vertices] = surface(coarse); };
    ProgressiveMesh progressive;
    SimplifyReport report;
    try {
        report = simplify(mesh, options, progressive);
    } catch (const Error&) {
        return;
    }
    if (report.stop == SimplifyStop::not_delaunay) return;
    for (const auto& [vertices, faces] : seen) {
        const Mesh replayed = progressive.at(vertices);
        EXPECT_EQ(validate(replayed), "") << named.name;
        EXPECT_EQ(replayed.vertex_count(), vertices) << named.name;
        EXPECT_TRUE(surface(replayed) == faces) << named.name << " at " << vertices << ", seed " << seed;
    }
    EXPECT_TRUE(surface(progressive.at(0)) == surface(mesh)) << named.name;
}

TEST(ProgressiveMesh, ReplaysEveryLevelOfEveryFamilyAsItWas) {
    for (const test::NamedSoup& named : test::families(200)) expect_replays(named, 1);
}

/// A level that is blocked above its target has been handed out: what moves after that belongs to the next one.
TEST(ProgressiveMesh, ReplaysLevelsThatWereBlocked) {
    for (const test::NamedSoup& named : test::families(200)) {
        if (std::string_view(named.name) != "plate") continue;
        for (std::uint64_t seed = 3; seed <= 6; ++seed) expect_replays(named, seed);
    }
}

TEST(ProgressiveMesh, EveryNumberOfVerticesIsDelaunay) {
    for (const char* name : {"noisy-sphere", "terrain", "many-parts"}) {
        const ProgressiveMesh progressive = record(Mesh(make_sample(name, 250)));
        for (std::size_t k = progressive.least_vertices(); k <= progressive.most_vertices(); ++k) {
            const Mesh mesh = progressive.at(k);
            ASSERT_EQ(mesh.vertex_count(), k);
            ASSERT_EQ(validate(mesh), "") << name << " at " << k;
            ASSERT_TRUE(certify(mesh).certified) << name << " at " << k;
        }
    }
}

TEST(ProgressiveMesh, BytesComeBackAsTheyWere) {
    const ProgressiveMesh before = record(Mesh(make_sample("terrain", 500)));
    const std::vector<std::byte> bytes = encode(before);
    const ProgressiveMesh after = decode(bytes, "test");
    EXPECT_EQ(encode(after), bytes);
    EXPECT_EQ(test::hash_bits(to_soup(before.at(100))), test::hash_bits(to_soup(after.at(100))));
    EXPECT_EQ(test::hash_bits(to_soup(before.at(100000))), test::hash_bits(to_soup(after.at(100000))));
}

TEST(ProgressiveMesh, EveryTruncationIsRefused) {
    const std::vector<std::byte> bytes = encode(record(Mesh(make_sample("icosphere", 20))));
    for (std::size_t n = 0; n < bytes.size(); n += 1 + n / 50)
        EXPECT_THROW((void)decode(std::span(bytes).first(n), "test"), Error) << n;
}

/// Whatever the bytes: an error or a mesh that is valid, never anything else.
TEST(ProgressiveMesh, BrokenBytesAreRefusedOrHarmless) {
    const std::vector<std::byte> good = encode(record(Mesh(make_sample("terrain", 120))));
    test::Random random(8);
    for (int i = 0; i < 1000; ++i) {
        std::vector<std::byte> bytes = good;
        for (std::size_t k = 0; k <= random.below(std::size_t{3}); ++k)
            bytes[random.below(bytes.size())] = static_cast<std::byte>(random.below(256));
        try {
            const Mesh mesh = decode(bytes, "test").at(1000000);
            EXPECT_EQ(validate(mesh), "") << i;
        } catch (const Error&) {
            continue;
        }
    }
}

}  // namespace
}  // namespace delmesh
