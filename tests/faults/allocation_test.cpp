// Memory runs out at the n-th allocation, for every n: each step throws std::bad_alloc and nothing else, gives back all
// that it took (the leak checker of the sanitizers sees to that), leaves what it was working on whole, and no file
// behind.

#include "delmesh/delaunay/remesh.hpp"
#include "delmesh/io/read.hpp"
#include "delmesh/io/write.hpp"
#include "delmesh/measure/certificate.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "delmesh/mesh/validate.hpp"
#include "delmesh/repair/repair.hpp"
#include "delmesh/simplify/simplify.hpp"
#include "faults/failing_allocations.hpp"
#include "io/io_support.hpp"
#include "io/packed_gltf.hpp"
#include "io/packing.hpp"
#include "io/scene_files.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <new>

namespace delmesh {
namespace {

/// Runs `call` with ever more memory, until it gets through. `start` makes what it works on, and `check` looks at what
/// is left of that after a failure. Up to `all_below` allocations no number is left out. Returns how many runs failed.
std::size_t exhaust(
    const std::function<void()>& start, const std::function<void()>& call, const std::function<void()>& check = [] {},
    std::size_t all_below = 15) {
    std::size_t failures = 0;
    for (std::size_t n = 0; n < 100'000; n += 1 + (n < all_below ? 0 : n / 15)) {
        start();
        test::some_allocation_failed = false;
        bool threw = false;
        test::allocations_left = n;
        try {
            call();
        } catch (const std::bad_alloc&) {
            threw = true;
        }
        test::allocations_left = test::no_limit;
        // (A sort that gets no room for a copy sorts in place.)
        if (!test::some_allocation_failed) return failures;
        if (threw) ++failures;
        check();
        if (testing::Test::HasFailure()) {
            ADD_FAILURE() << "memory for " << n << " allocations";
            return failures;
        }
    }
    ADD_FAILURE() << "no end";
    return failures;
}

/// With coordinates that are floats, as STL wants them.
PolygonSoup rounded(PolygonSoup soup) {
    for (Vec3& p : soup.points) p = {std::round(p.x * 64), std::round(p.y * 64), std::round(p.z * 64)};
    return soup;
}

/// Bodies that touch, faces that are there twice, turned or without area.
PolygonSoup broken_soup() {
    PolygonSoup soup = make_sample("torus", 60);
    const std::size_t faces = soup.face_count();
    for (std::size_t f = 0; f < faces; f += 7) std::swap(soup.corners[3 * f], soup.corners[3 * f + 1]);
    for (std::size_t f = 0; f < faces; f += 5)
        soup.add_face(std::array{soup.corners[3 * f], soup.corners[3 * f + 1], soup.corners[3 * f + 2]});
    soup.add_face(std::array{soup.corners[0], soup.corners[1], soup.corners[40]});
    soup.add_face(std::array{soup.corners[0], soup.corners[1], soup.corners[1]});
    soup.points.push_back({1, 2, 3});
    return soup;
}

std::vector<std::pair<std::string, std::string>> small_files() {
    const test::TestFolder folder;
    std::vector<std::pair<std::string, std::string>> files{
        {"a.glb", test::glb(test::tetrahedron_json("[{\"mesh\":0}]"), test::tetrahedron_buffer())},
        {"a.gltf",
         test::tetrahedron_json("[{\"mesh\":0}]", 2, "data:a/b;base64," + test::base64(test::tetrahedron_buffer()))},
        {"meshopt.glb", test::meshopt_glb(test::meshopt_tetrahedron(true))},
        {"draco.glb", test::draco_glb(test::draco_data(test::packed_tetrahedron(), {.has_texture = true}))},
        {"a.3mf", test::package_3mf(test::model_3mf(test::tetrahedron_3mf(1), "<item objectid=\"1\"/>"))}};
    for (const Format format : {Format::ply, Format::obj, Format::off, Format::stl}) {
        const std::string file = "a." + std::string(name(format));
        write_soup(folder / file, rounded(broken_soup()), {.format = format, .ascii = true});
        files.emplace_back(file, test::read_bytes(folder / file));
    }
    files.emplace_back("a.stl.gz", test::gzip(files.back().second));
    files.emplace_back("a.stl.zst", test::zstd(files[files.size() - 2].second));
    return files;
}

/// Whether only one allocation fails, or all from then on: a step that takes a failure for something else must not get
/// away with it because its message finds no memory either.
class Allocation : public testing::TestWithParam<bool> {
protected:
    void SetUp() override { test::only_one_fails = GetParam(); }
    void TearDown() override {
        test::only_one_fails = false;
        test::libraries_count = false;
    }
};

INSTANTIATE_TEST_SUITE_P(Fails, Allocation, testing::Bool(),
                         [](const auto& fails) { return fails.param ? "Once" : "FromThenOn"; });

void expect_readers_to_tell() {
    for (const auto& [name, bytes] : small_files()) {
        SCOPED_TRACE(name);
        const auto read = [&, &file = name, &text = bytes] { (void)test::parse(text, file); };
        EXPECT_GT(exhaust([] {}, read, [] {}, 5000), 0U);
    }
}

TEST_P(Allocation, Readers) {
    expect_readers_to_tell();
}

TEST_P(Allocation, LibrariesOfReaders) {
    if (!test::libraries_can_count) GTEST_SKIP() << "malloc can not be replaced here";
    test::libraries_count = true;
    expect_readers_to_tell();
}

TEST_P(Allocation, RepairLeavesTheSoupAsItWas) {
    const PolygonSoup input = broken_soup();
    PolygonSoup soup;
    bool done = false;
    const std::size_t failures = exhaust(
        [&] {
            soup = input;
            done = false;
        },
        [&] {
            (void)repair(soup);
            done = true;
        },
        [&] { EXPECT_TRUE(done || test::same_soup(soup, input)); });
    EXPECT_GT(failures, 20U);
    EXPECT_NO_THROW((void)Mesh(soup));
}

TEST_P(Allocation, RemeshingLeavesAMesh) {
    const Mesh input{make_sample("torus", 24)};
    for (const RemeshMode mode : {RemeshMode::preserve, RemeshMode::flip, RemeshMode::feature}) {
        SCOPED_TRACE(static_cast<int>(mode));
        Mesh mesh = input;
        RemeshOptions options;
        options.mode = mode;
        options.effort = 0;
        const std::size_t failures = exhaust([&] { mesh = input; }, [&] { (void)make_delaunay(mesh, options); },
                                             [&] { EXPECT_EQ(validate(mesh), ""); });
        EXPECT_GT(failures, 5U);
        EXPECT_TRUE(certify(mesh).certified);
    }
}

TEST_P(Allocation, SimplifyingLeavesAMesh) {
    const Mesh input{make_sample("torus", 200)};
    Mesh mesh = input;
    SimplifyOptions options;
    options.levels = {60};
    EXPECT_GT(
        exhaust([&] { mesh = input; }, [&] { (void)simplify(mesh, options); }, [&] { EXPECT_EQ(validate(mesh), ""); }),
        5U);
}

TEST_P(Allocation, WritersLeaveNoFile) {
    const Mesh mesh{rounded(make_sample("torus", 60))};
    const test::TestFolder folder;
    test::write_bytes(folder / "a", "old");
    for (const Format format : {Format::ply, Format::obj, Format::off, Format::stl}) {
        EXPECT_GT(exhaust([] {}, [&] { write_mesh(folder / "a", mesh, {.format = format}); },
                          [&] {
                              EXPECT_EQ(test::read_bytes(folder / "a"), "old");
                              const std::filesystem::directory_iterator files(folder.path());
                              EXPECT_EQ(std::distance(begin(files), end(files)), 1);
                          }),
                  0U);
        test::write_bytes(folder / "a", "old");
    }
}

}  // namespace
}  // namespace delmesh
