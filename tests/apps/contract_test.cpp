// What scripts rely on: exit codes, the keys of the JSON objects, help with examples, and no other words.

#include "apps/running.hpp"

#include <sstream>

namespace delmesh {
namespace {

using Contract = test::Running;
using Keys = std::vector<std::string>;

constexpr const char* square = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
/// The diagonal has two angles of 120 degrees and more opposite.
constexpr const char* kite = "OFF\n4 2 0\n-1 0 0\n1 0 0\n0 0.1 0\n0 -0.1 0\n3 0 1 2\n3 0 3 1\n";
/// Three faces at an edge.
constexpr const char* fan = "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n";

testing::AssertionResult has(const nlohmann::json& object, const Keys& keys) {
    for (const std::string& key : keys) {
        if (!object.contains(key)) return testing::AssertionFailure() << "no " << key << " in " << object.dump();
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult has_mesh_numbers(const nlohmann::json& object) {
    if (const auto all = has(object, {"mesh", "delaunay", "quality"}); !all) return all;
    const Keys of_mesh{"vertices", "edges", "faces", "boundary_edges", "components", "euler"};
    if (const auto all = has(object["mesh"], of_mesh); !all) return all;
    const Keys of_delaunay{"certified", "non_delaunay_edges", "obtuse_boundary_edges", "worst_excess_deg",
                           "worst_edge"};
    if (const auto all = has(object["delaunay"], of_delaunay); !all) return all;
    return has(object["quality"], {"min_angle_deg", "max_angle_deg", "small_angles_percent", "large_angles_percent"});
}

/// The first words of the lines under "Subcommands:".
Keys commands(const std::string& help) {
    Keys names;
    std::istringstream lines(help.substr(help.find("Subcommands:")));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line) && line.starts_with("  ")) {
        std::istringstream words(line);
        std::string name;
        if (line[2] != ' ' && words >> name) names.push_back(name);
    }
    return names;
}

TEST_F(Contract, EveryCommandHasHelpWithAnExample) {
    const test::Ran help = delmesh("--help");
    EXPECT_EQ(help.exit_code, 0);
    const Keys names = commands(help.out);
    for (const char* name : {"remesh", "check", "stats", "repair", "sample"})
        EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
    for (const std::string& name : names) {
        const test::Ran ran = delmesh(name + " --help");
        EXPECT_EQ(ran.exit_code, 0) << name;
        EXPECT_NE(ran.out.find("Example:\n  delmesh " + name), std::string::npos) << ran.out;
        if (name == "lod") continue;  // holds commands of its own
        for (const char* option : {"--json", "--quiet", "--threads"})
            EXPECT_NE(ran.out.find(option), std::string::npos) << name << " " << option;
        EXPECT_EQ(ran.err, "");
    }
}

TEST_F(Contract, WrongUsageIs2) {
    write("a.off", square);
    for (const char* arguments :
         {"", "paint a.off", "check", "check a.off --loud", "remesh a.off", "remesh a.off b.xyz", "remesh a.off -",
          "remesh a.off b.ply --mode sideways", "sample torus", "remesh a.off b.ply --max-vertices -3",
          "check a.off --threads 5000"}) {
        const test::Ran ran = delmesh(arguments);
        EXPECT_EQ(ran.exit_code, 2) << arguments << "\n" << ran.out;
        EXPECT_NE(ran.err, "") << arguments;
        EXPECT_EQ(ran.out, "") << arguments;
    }
    EXPECT_EQ(files(), Keys{"a.off"});
}

TEST_F(Contract, CheckTellsByItsExitCode) {
    write("good.off", square);
    write("bad.off", kite);
    const test::Ran good = delmesh("check good.off --json");
    EXPECT_EQ(good.exit_code, 0);
    EXPECT_EQ(good.err, "");
    EXPECT_TRUE(has_mesh_numbers(good.json()));
    EXPECT_TRUE(good.json()["delaunay"]["certified"].get<bool>());
    const test::Ran bad = delmesh("check bad.off --json");
    EXPECT_EQ(bad.exit_code, 1);
    EXPECT_FALSE(bad.json()["delaunay"]["certified"].get<bool>());
    EXPECT_EQ(bad.json()["delaunay"]["non_delaunay_edges"], 1);
}

TEST_F(Contract, StatsHasARowForEachMesh) {
    write("a.off", square);
    write("b.off", kite);
    const nlohmann::json one = delmesh("stats a.off --json").json();
    EXPECT_TRUE(has_mesh_numbers(one));
    const nlohmann::json two = delmesh("stats a.off b.off --json").json();
    ASSERT_EQ(two["meshes"].size(), 2u);
    EXPECT_TRUE(has_mesh_numbers(two["meshes"][1]));
}

TEST_F(Contract, RemeshTellsEverythingAboutTheRun) {
    write("bad.off", kite);
    for (const char* mode : {"preserve", "flip", "feature"}) {
        const test::Ran ran = delmesh(std::string("remesh bad.off out.ply --json --mode ") + mode);
        EXPECT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_EQ(ran.err, "");
        const nlohmann::json json = ran.json();
        ASSERT_TRUE(
            has(json, {"input", "output", "flips", "splits", "stop", "options", "seconds", "peak_memory_bytes"}));
        EXPECT_TRUE(has_mesh_numbers(json["input"]));
        EXPECT_TRUE(has_mesh_numbers(json["output"]));
        EXPECT_TRUE(has(json["seconds"], {"read", "build", "remesh", "certify", "write", "total"}));
        EXPECT_EQ(json["stop"], "done");
        EXPECT_EQ(delmesh("check out.ply").exit_code, 0);
    }
    const test::Ran quiet = delmesh("remesh bad.off out.ply --quiet");
    EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(Contract, TheProvedBoundIsToldWhereItIsAskedFor) {
    ASSERT_EQ(delmesh("sample terrain a.ply --faces 500").exit_code, 0);
    EXPECT_FALSE(delmesh("remesh a.ply b.ply --json").json().contains("lower_bound_strong"));
    EXPECT_FALSE(delmesh("remesh a.ply b.ply --json --bound --mode flip").json().contains("lower_bound_strong"));
    const nlohmann::json json = delmesh("remesh a.ply b.ply --json --bound").json();
    EXPECT_GT(json["lower_bound_strong"], json["lower_bound"]);
    EXPECT_LE(json["lower_bound_strong"], json["splits"]);
}

TEST_F(Contract, FlatToleranceIsARuleOrANumberAndItsEffectIsReported) {
    ASSERT_EQ(delmesh("sample inclined-grid a.ply --faces 500").exit_code, 0);
    const nlohmann::json exact = delmesh("remesh a.ply b.ply --json").json();
    EXPECT_EQ(exact["options"]["flat_tolerance_rel"], "auto");
    EXPECT_EQ(exact["max_deviation"], 0);
    EXPECT_GT(exact["splits"], 10);
    EXPECT_EQ(exact["growth"]["lower_bound"], exact["lower_bound"]);
    EXPECT_EQ(exact["growth"]["lower_bound_if_flat"], 0);
    const std::string as_it_was = bytes("b.ply");
    delmesh("remesh a.ply b.ply --flat-tolerance 0");
    EXPECT_EQ(bytes("b.ply"), as_it_was);
    const nlohmann::json flat = delmesh("remesh a.ply b.ply --json --flat-tolerance stored").json();
    EXPECT_EQ(flat["splits"], 0);
    EXPECT_GT(flat["max_deviation"], 0);
    EXPECT_LE(flat["max_deviation"], flat["flat_tolerance"]);
    EXPECT_EQ(delmesh("remesh a.ply b.ply --json --flat-tolerance 1e-7").json()["options"]["flat_tolerance_rel"], 1e-7);
    for (const char* wrong : {"often", "-1", "0.5", "nan"})
        EXPECT_EQ(delmesh(std::string("remesh a.ply b.ply --flat-tolerance ") + wrong).exit_code, 2) << wrong;
}

TEST_F(Contract, DamagedFilesAreReadInPartOnRequest) {
    write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 x\n");
    const test::Ran refused = delmesh("check a.obj");
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_TRUE(refused.tells_one_sentence());
    EXPECT_NE(refused.err.find("line 5"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("--repair"), std::string::npos) << refused.err;
    const test::Ran mended = delmesh("repair a.obj b.ply --json");
    EXPECT_EQ(mended.exit_code, 0);
    EXPECT_EQ(mended.json()["damaged"]["count"], 1);
    EXPECT_EQ(mended.json()["changed"], true);
    EXPECT_EQ(mended.json()["faces"], 1);
    const test::Ran told = delmesh("repair a.obj b.ply");
    EXPECT_NE((told.out + told.err).find("left out: line 5"), std::string::npos) << told.err;
    EXPECT_EQ(delmesh("check a.obj --repair").exit_code, 0);
    EXPECT_EQ(delmesh("remesh a.obj c.ply --repair --json").json()["repair"]["damaged"]["count"], 1);
    EXPECT_FALSE(delmesh("repair b.ply c.ply --json").json().contains("damaged"));
    write("none.obj", "v 0 0 0\nf 1 2 x\n");
    const test::Ran none = delmesh("repair none.obj c.ply");
    EXPECT_EQ(none.exit_code, 3);
    EXPECT_TRUE(none.tells_one_sentence());
}

TEST_F(Contract, InputsThatCanNotBeUsedAre3) {
    write("fan.off", fan);
    write("cut.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
    write("empty.obj", "");
    for (const char* file : {"fan.off", "cut.ply", "empty.obj", "missing.ply", "."}) {
        for (const char* command : {"check ", "stats "}) {
            const test::Ran ran = delmesh(command + std::string(file));
            EXPECT_EQ(ran.exit_code, 3) << file;
            EXPECT_TRUE(ran.tells_one_sentence()) << file;
            EXPECT_EQ(ran.out, "") << file;
        }
        const test::Ran ran = delmesh("remesh --json " + std::string(file) + " out.ply");
        EXPECT_EQ(ran.exit_code, 3) << file;
        EXPECT_TRUE(ran.tells_one_sentence()) << file;
        EXPECT_TRUE(has(ran.json()["error"], {"code", "message"})) << file;
    }
    EXPECT_EQ(files(), (Keys{"cut.ply", "empty.obj", "fan.off"}));
    EXPECT_EQ(delmesh("remesh fan.off out.ply --repair --quiet").exit_code, 0);
}

TEST_F(Contract, InputsWithoutASurfaceAre3) {
    write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    write("lines.off", "OFF 3 1 0\n0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n");
    for (const char* command :
         {"check points.obj", "stats points.obj", "remesh points.obj out.ply",
          "simplify points.obj out.ply --ratio 0.5", "repair points.obj out.ply", "check lines.off --repair",
          "repair lines.off out.ply", "distance points.obj lines.off", "remesh lines.off out.ply --repair"}) {
        const test::Ran ran = delmesh(command);
        EXPECT_EQ(ran.exit_code, 3) << command;
        EXPECT_TRUE(ran.tells_one_sentence()) << command;
        EXPECT_EQ(ran.out, "") << command;
    }
    EXPECT_NE(delmesh("check points.obj").err.find("found 3 vertices and no face"), std::string::npos);
    const std::string of_lines = delmesh("repair lines.off out.ply").err;
    EXPECT_NE(of_lines.find("1 face has no area"), std::string::npos) << of_lines;
    EXPECT_EQ(files(), (Keys{"lines.off", "points.obj"}));
}

TEST_F(Contract, StoppingShortIs5AndWritesOnlyWhatIsAskedFor) {
    ASSERT_EQ(delmesh("sample plate a.ply --faces 200").exit_code, 0);
    const test::Ran ran = delmesh("remesh a.ply b.ply --effort 0 --max-vertices 1");
    EXPECT_EQ(ran.exit_code, 5);
    EXPECT_TRUE(ran.tells_one_sentence());
    EXPECT_EQ(files(), Keys{"a.ply"});
    EXPECT_EQ(delmesh("remesh a.ply b.ply --effort 0 --max-vertices 1 --keep-partial").exit_code, 5);
    EXPECT_EQ(delmesh("check b.ply").exit_code, 1);
}

TEST_F(Contract, StoppingShortNamesTheModesThatNeedFewerVertices) {
    ASSERT_EQ(delmesh("sample plate a.ply --faces 200").exit_code, 0);
    const auto error = [&](const std::string& mode) {
        return delmesh("remesh a.ply b.ply --effort 0 --max-vertices 1 --mode " + mode).err;
    };
    EXPECT_NE(error("preserve").find("--mode feature or --mode flip"), std::string::npos);
    const std::string of_feature = error("feature");
    EXPECT_NE(of_feature.find("--mode flip"), std::string::npos) << of_feature;
    EXPECT_EQ(of_feature.find("--mode feature"), std::string::npos);
}

/// Two bodies at one place, each with vertices of its own: STL would join them, and the points that are put into both.
TEST_F(Contract, StlTellsVerticesAtOnePlaceApart) {
    ASSERT_EQ(delmesh("sample plate a.obj --faces 200").exit_code, 0);
    std::istringstream lines(bytes("a.obj"));
    std::string points;
    std::string faces;
    std::string faces_again;
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("v ") && ++count > 0) points += line + "\n";
        if (line.starts_with("f ")) faces += line + "\n";
    }
    std::istringstream corners(faces);
    for (std::string word; corners >> word;)
        faces_again += word == "f" ? "\nf" : " " + std::to_string(std::stoul(word) + count);
    write("twice.obj", points + points + faces + faces_again + "\n");
    for (const std::string mode : {"preserve", "flip", "feature"}) {
        const test::Ran ran = delmesh("remesh twice.obj out.stl --effort 0 --json --mode " + mode);
        ASSERT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_GE(ran.json()["parted"], count) << mode;
        const nlohmann::json of_file = delmesh("check out.stl --json").json();
        EXPECT_EQ(of_file["delaunay"]["certified"], true);
        EXPECT_EQ(of_file["mesh"], ran.json()["output"]["mesh"]) << mode;
    }
}

}  // namespace
}  // namespace delmesh
