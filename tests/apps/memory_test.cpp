// Out of memory is a sentence and an exit code: the program under limits of its address space, from far too little to
// enough.

#include "apps/running.hpp"

#include <algorithm>

#if defined(__SANITIZE_ADDRESS__)
#define DELMESH_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define DELMESH_ADDRESS_SANITIZER 1
#endif
#endif

namespace delmesh {
namespace {

class Memory : public test::Running {
protected:
    void SetUp() override {
#ifdef DELMESH_ADDRESS_SANITIZER
        GTEST_SKIP() << "the address sanitizer itself needs terabytes of address space";
#endif
        ASSERT_EQ(delmesh("sample noisy-surface in.ply --faces 60000").exit_code, 0);
        ASSERT_EQ(delmesh("sample noisy-surface in.obj --faces 60000").exit_code, 0);
        ASSERT_EQ(delmesh("sample noisy-surface in.stl --faces 60000").exit_code, 0);
        ASSERT_EQ(shell("gzip -k in.obj").exit_code, 0);
        before_ = files();
    }

    /// Runs the command under limits from little to enough. Whether it is little enough is part of the test: some of
    /// these runs must fail for want of memory, the last one must not.
    void expect_success_or_one_sentence(const std::string& command) {
        constexpr int enough_mib = 4096;
        bool failed = false;
        for (const int mib : {16, 20, 24, 30, 40, 56, 80, 120, enough_mib}) {
            SCOPED_TRACE(command + " in " + std::to_string(mib) + " MiB");
            const std::string limit = "ulimit -v " + std::to_string(1024 * mib);
            if (shell("( " + limit + "; delmesh --version ) >/dev/null 2>&1").exit_code != 0) continue;
            const test::Ran ran = shell("( " + limit + "; delmesh " + command + " --quiet )");
            if (ran.exit_code <= 1 && ran.exit_code >= 0) {  // 1: `check` says no
                for (const char* name : {"out.ply", "out.stl"}) std::filesystem::remove(*this / name);
            } else {
                failed = true;
                EXPECT_EQ(ran.exit_code, 3) << ran.err;
                EXPECT_TRUE(ran.tells_one_sentence());
                EXPECT_NE(ran.err.find("not enough memory"), std::string::npos) << ran.err;
            }
            EXPECT_EQ(files(), before_);
            if (mib == enough_mib) {
                EXPECT_LE(ran.exit_code, 1) << ran.err;
            }
        }
        EXPECT_TRUE(failed) << "no limit was too small";
    }

private:
    std::vector<std::string> before_;
};

TEST_F(Memory, LackingInCheckIsASentence) {
    expect_success_or_one_sentence("check in.ply");
}

TEST_F(Memory, LackingInStatsIsASentence) {
    expect_success_or_one_sentence("stats in.obj.gz");
}

TEST_F(Memory, LackingInRepairIsASentence) {
    expect_success_or_one_sentence("repair in.stl out.ply");
}

TEST_F(Memory, LackingInRemeshIsASentence) {
    expect_success_or_one_sentence("remesh in.ply out.ply --effort 0");
    expect_success_or_one_sentence("remesh in.obj out.stl --mode flip --threads 2");
    expect_success_or_one_sentence("remesh in.ply out.ply --mode feature --placement shells --threads 8");
}

/// What is allowed for each face that is left is less than a face of the input takes.
TEST_F(Memory, SimplifyOfALargeMeshNeedsLittleBesideIt) {
    ASSERT_EQ(delmesh("sample noisy-sphere large.ply --faces 450000 --precision float").exit_code, 0);
    const test::Ran ran = delmesh("simplify large.ply out.ply --ratio 0.1 --json");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const nlohmann::json json = ran.json();
    EXPECT_EQ(json["output"]["delaunay"]["certified"], true);
    EXPECT_LT(json["peak_memory_bytes"].get<double>(), 50e6 + 200 * json["output"]["mesh"]["faces"].get<double>());
}

TEST_F(Memory, LackingInSimplifyIsASentence) {
    expect_success_or_one_sentence("simplify in.obj out.ply --ratio 0.5");
}

TEST_F(Memory, LackingInSampleIsASentence) {
    expect_success_or_one_sentence("sample noisy-sphere out.ply --faces 500000");
}

TEST_F(Memory, OfRepairIsLittleMoreThanTheMesh) {
    ASSERT_EQ(delmesh("sample noisy-surface large.ply --faces 300000").exit_code, 0);
    const nlohmann::json small = delmesh("repair in.ply out.ply --json").json();
    const nlohmann::json large = delmesh("repair large.ply out.ply --json").json();
    const auto more = [&](const char* key) { return large.at(key).get<double>() - small.at(key).get<double>(); };
    // The mesh takes 24: three corners for each face, and a point for each two.
    EXPECT_LT(more("peak_memory_bytes") / more("faces"), 70);
}

}  // namespace
}  // namespace delmesh
