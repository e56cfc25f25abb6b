// Pipes, full disks, folders that may not be written, files that are input and output: the expected thing, or one
// sentence and the right exit code, and nothing lost.

#include "apps/running.hpp"

#include <unistd.h>

namespace delmesh {
namespace {

using Streams = test::Running;
using Names = std::vector<std::string>;

TEST_F(Streams, MeshesGoThroughPipes) {
    ASSERT_EQ(delmesh("sample plate a.ply --faces 200 --quiet").exit_code, 0);
    ASSERT_EQ(delmesh("remesh --effort 0 a.ply by_name.ply --quiet").exit_code, 0);
    for (const char* line :
         {"delmesh remesh --effort 0 - - --format ply <a.ply", "cat a.ply | delmesh remesh --effort 0 - - --format ply",
          "delmesh sample plate - --faces 200 --format ply | delmesh remesh --effort 0 - - --format ply --json",
          "cat a.ply | delmesh repair - - --format ply | delmesh remesh --effort 0 - - --format ply"}) {
        const test::Ran ran = shell(line);
        EXPECT_EQ(ran.exit_code, 0) << line << ran.err;
        EXPECT_TRUE(ran.out == bytes("by_name.ply")) << line;
        EXPECT_NE(ran.err, "") << line;  // the words
    }
    for (const char* format : {"obj", "off", "stl", "ply --ascii", "stl --ascii"}) {
        const test::Ran ran =
            shell("delmesh remesh --effort 0 a.ply - --quiet --format " + std::string(format) + " | delmesh check -");
        EXPECT_EQ(ran.exit_code, 0) << format << ran.err;
    }
    EXPECT_EQ(shell("gzip -c by_name.ply | delmesh check - --json").json()["delaunay"]["certified"], true);
    EXPECT_EQ(shell("printf '' | delmesh check -").exit_code, 3);
    EXPECT_EQ(shell("delmesh check - <&-").exit_code, 3);
}

TEST_F(Streams, OutputMayBeTheInput) {
    ASSERT_EQ(delmesh("sample plate a.ply --faces 200 --quiet").exit_code, 0);
    EXPECT_EQ(delmesh("remesh --effort 0 a.ply a.ply --quiet").exit_code, 0);
    EXPECT_EQ(delmesh("check a.ply").exit_code, 0);
    EXPECT_EQ(files(), Names{"a.ply"});
}

TEST_F(Streams, BrokenPipesAndFullDisksAre4) {
    ASSERT_EQ(delmesh("sample torus a.ply --faces 20000 --quiet").exit_code, 0);
    const test::Ran broken =
        shell("{ delmesh repair a.ply - --format ply --quiet; echo $? >code; } | head -c 10 >/dev/null");
    EXPECT_EQ(bytes("code"), "4\n");
    EXPECT_TRUE(broken.tells_one_sentence());
    EXPECT_NE(broken.err.find("Broken pipe"), std::string::npos) << broken.err;
    for (const char* line : {"delmesh remesh --effort 0 a.ply /dev/full --format ply --quiet",
                             "delmesh stats a.ply >/dev/full", "delmesh stats a.ply --json >/dev/full",
                             "delmesh repair a.ply - --format obj >/dev/full", "delmesh sample >/dev/full"}) {
        const test::Ran full = shell(line);
        EXPECT_EQ(full.exit_code, 4) << line;
        EXPECT_TRUE(full.tells_one_sentence()) << line;
        EXPECT_NE(full.err.find("No space left"), std::string::npos) << full.err;
    }
    for (const char* line :
         {"delmesh check a.ply >&-", "delmesh repair a.ply b.ply >&-", "delmesh check a.ply >&- <&-"}) {
        const test::Ran closed = shell(line);
        EXPECT_EQ(closed.exit_code, 4) << line;
        EXPECT_TRUE(closed.tells_one_sentence()) << line;
    }
    EXPECT_EQ(bytes("b.ply"), bytes("a.ply"));
    EXPECT_EQ(delmesh("repair a.ply b.ply 2>&-").exit_code, 0);
}

TEST_F(Streams, LimitsOnFileSizeLeaveNothingBehind) {
    ASSERT_EQ(delmesh("sample torus a.ply --faces 20000 --quiet").exit_code, 0);
    write("b.ply", "what the user had");
    const test::Ran ran = shell("(ulimit -f 20; delmesh repair a.ply b.ply --quiet)");
    EXPECT_EQ(ran.exit_code, 4);
    EXPECT_TRUE(ran.tells_one_sentence());
    EXPECT_EQ(bytes("b.ply"), "what the user had");
    EXPECT_EQ(files(), (Names{"a.ply", "b.ply"}));
}

TEST_F(Streams, PlacesThatCanNotBeWrittenAre4) {
    ASSERT_EQ(delmesh("sample plate a.ply --faces 200 --quiet").exit_code, 0);
    Names lines{"delmesh remesh --effort 0 a.ply no/such/folder/b.ply",
                "delmesh remesh --effort 0 a.ply . --format ply"};
    if (::geteuid() != 0) lines.push_back("mkdir shut; chmod 555 shut; delmesh remesh --effort 0 a.ply shut/b.ply");
    for (const std::string& line : lines) {
        const test::Ran ran = shell(line);
        EXPECT_EQ(ran.exit_code, 4) << line;
        EXPECT_TRUE(ran.tells_one_sentence()) << line;
    }
}

TEST_F(Streams, TwoProcessesLeaveOneWholeFile) {
    ASSERT_EQ(delmesh("sample torus a.ply --faces 20000 --quiet").exit_code, 0);
    ASSERT_EQ(delmesh("sample plate b.ply --faces 200 --quiet").exit_code, 0);
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(shell("delmesh repair a.ply c.ply --quiet & delmesh repair b.ply c.ply --quiet; wait").exit_code, 0);
        const std::string both = bytes("c.ply");
        EXPECT_TRUE(both == bytes("a.ply") || both == bytes("b.ply"));
    }
    EXPECT_EQ(files(), (Names{"a.ply", "b.ply", "c.ply"}));
}

}  // namespace
}  // namespace delmesh
