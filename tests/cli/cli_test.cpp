// SPDX-License-Identifier: Apache-2.0
// Runs the program as a user does, and checks its exit code, its output and its files.
#include "tests/cli/cli_fixture.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

namespace dismantle {
namespace {

using Json = nlohmann::json;

TEST_F(Cli, ListsItsCommandsInTheHelp) {
  const Outcome o = run("--help");
  EXPECT_EQ(o.exit_code, 0);
  for (const char* command :
       {"info", "check", "move", "audit", "convert", "simplify", "render", "plan", "why", "export", "sample"})
    EXPECT_NE(o.out.find(command), std::string::npos) << command;
}

TEST_F(Cli, ExitsWith2OnWrongUsage) {
  EXPECT_EQ(run("").exit_code, 2);
  EXPECT_EQ(run("dance").exit_code, 2);
  EXPECT_EQ(run("info").exit_code, 2);
  EXPECT_EQ(run("info parts --units parsec").exit_code, 2);
  EXPECT_EQ(run("info parts --tolerance -1").exit_code, 2);
  EXPECT_EQ(run("check parts --device abacus").exit_code, 2);
}

TEST_F(Cli, ListsItsCommandsWithoutACommand) {
  const Outcome o = run("");
  EXPECT_EQ(o.exit_code, 2);
  EXPECT_EQ(o.out, "");
  for (const char* text : {"Usage: dismantle", "info", "check", "view"})
    EXPECT_NE(o.err.find(text), std::string::npos) << text;
}

TEST_F(Cli, SuggestsCommandsOptionsAndComponents) {
  expect_error("inf parts", 2, "did you mean 'info'?");
  expect_error("parts", 2, "'dismantle view parts' opens it");
  expect_error("info parts --tolerence 3", 2, "there is no option '--tolerence'; did you mean '--tolerance'?");
  expect_error("why parts blok", 2, "did you mean 'block'?");
  expect_error("render parts -o x.png --ghost wal", 2, "did you mean 'wall'?");
}

TEST_F(Cli, SaysWhatIsWrongWithArgumentsWithoutBraces) {
  expect_error("info", 2, "ASSEMBLY is missing");
  expect_error("info parts extra", 2, "too many arguments: extra");
  expect_error("info parts --units parsec", 2, "'parsec' is not one of mm, cm, m, um, in or ft");
  expect_error("plan parts -o x.path.json --prefer gravity", 2, "'gravity' is not one of");
  expect_error("plan parts -o", 2, "--output needs FILE");
  expect_error("check parts --tolerance -1", 2, "'-1' is not a number above 0");
  expect_error("check parts --threads 0", 2, "'0' is not a number from 1 to 1024");
  for (const char* command : {"info", "check", "move", "audit", "convert", "simplify", "render", "plan", "why",
                              "export", "sample", "batch", "view"}) {
    const Outcome help = run(std::string(command) + " --help");
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_EQ(help.out.find('{'), std::string::npos) << help.out;
  }
}

TEST_F(Cli, PrintsErrorsAsOneObjectWithJson) {
  for (const auto& [arguments, kind, code] :
       {std::tuple("info missing.step --json", "unreadable", 3), std::tuple("why parts blok --json", "usage", 2),
        std::tuple("inf parts --json", "usage", 2), std::tuple("info parts --units parsec --json", "usage", 2),
        std::tuple("convert parts --json -o nowhere/x.stl", "failed", 4)}) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.exit_code, code) << arguments;
    const Json error = Json::parse(o.out);
    EXPECT_EQ(error["format"], "dismantle-error");
    EXPECT_EQ(error["version"], 1);
    EXPECT_EQ(error["kind"], kind);
    EXPECT_EQ(error["exit_code"], code);
    EXPECT_EQ("dismantle: " + error["message"].get<std::string>() + "\n", o.err);
  }
}

TEST_F(Cli, ComputesOnTheCpuAndSaysWhyWithoutADeviceOrAUseForOne) {
  const Outcome check = run("check parts --device cuda");
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_NE(check.err.find("note: computing on the CPU"), std::string::npos) << check.err;
  EXPECT_EQ(run("check parts --device auto").err, "");
  for (const std::string method : {"streams", "certificates"}) {
    const std::string move = "move parts pull.motion.json --method " + method + " --response touch --json -o ";
    const Outcome cuda = run(move + "cuda.path.json --device cuda");
    ASSERT_EQ(cuda.exit_code, 0) << cuda.err;
    const bool on_cpu = Json::parse(cuda.out)["device"] == "cpu";
    EXPECT_EQ(cuda.err.find("note: computing on the CPU") != std::string::npos, on_cpu) << cuda.err;
    const Outcome cpu = run(move + "cpu.path.json --device cpu");
    ASSERT_EQ(cpu.exit_code, 0) << cpu.err;
    EXPECT_EQ(cpu.err, "");
    EXPECT_EQ(Json::parse(cpu.out)["device"], "cpu");
    EXPECT_EQ(read_all(in("cuda.path.json")), read_all(in("cpu.path.json")));
  }
}

TEST_F(Cli, ExitsWith3AndOneSentenceOnUnreadableInput) {
  expect_error("info missing.step", 3, "missing.step");
  write("broken.obj", "v 0 0 0\nf 1 2 3\n");
  expect_error("info broken.obj", 3, "broken.obj");
  write("empty.stl", "");
  expect_error("info empty.stl", 3, "empty.stl");
  write("drawing.dwg", "x");
  expect_error("info drawing.dwg", 3, "dwg");
  write("bad.motion.json", "{\"format\": \"dismantle-motion\", \"version\": 7}");
  expect_error("move parts bad.motion.json -o out.path.json", 3, "version");
  EXPECT_FALSE(fs::exists(in("out.path.json")));
}

TEST_F(Cli, NotesSizesThatAssembliesDoNotHave) {
  EXPECT_EQ(run("info parts").err, "");
  EXPECT_NE(run("info parts --units m").err.find("note: the assembly is 100 m long (read in m)"), std::string::npos);
  EXPECT_NE(run("info parts --units um").err.find("the assembly is 0.1 mm long (read in um)"), std::string::npos);
}

TEST_F(Cli, DescribesAnAssembly) {
  const Outcome o = run("info parts --json");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json info = Json::parse(o.out);
  EXPECT_EQ(info["assembly"]["components"], 2);
  EXPECT_EQ(info["assembly"]["triangles"], 24);
  EXPECT_EQ(info["assembly"]["shapes"], 2);
  EXPECT_TRUE(info["components"][1]["same_shape_as"].is_null());
  EXPECT_TRUE(info["fasteners"].empty());
  EXPECT_EQ(info["components"][0]["name"], "block");
  EXPECT_EQ(info["components"][0]["closed"], true);
  EXPECT_NE(run("info parts").out.find("block"), std::string::npos);
}

TEST_F(Cli, SplitsOrJoinsTheVisualsOfALink) {
  const std::string visual = "<visual><geometry><box size='1 1 1'/></geometry></visual>";
  write("arm.urdf", "<robot name='arm'><link name='base'>" + visual + visual + "</link><link name='tool'>" + visual +
                        "</link></robot>");
  const Outcome split = run("info arm.urdf"), joined = run("info arm.urdf --solids join");
  EXPECT_NE(split.out.find("arm.urdf: 3 components"), std::string::npos) << split.out << split.err;
  EXPECT_NE(split.out.find("1 link with several visuals: 2 components, one for each visual (--solids join: one for "
                           "each link)"),
            std::string::npos)
      << split.out;
  EXPECT_NE(joined.out.find("arm.urdf: 2 components"), std::string::npos) << joined.out << joined.err;
  EXPECT_EQ(joined.out.find("several"), std::string::npos) << joined.out;
}

TEST_F(Cli, ChecksPairs) {
  write_box("shelf", 2, 2, 10, 8, 8, 12);
  const Outcome o = run("check parts --json --tolerance 0.01");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json report = Json::parse(o.out);
  EXPECT_EQ(report["format"], "dismantle-check");
  ASSERT_EQ(report["pairs"].size(), 1u);
  EXPECT_EQ(report["pairs"][0]["a"], "block");
  EXPECT_EQ(report["pairs"][0]["b"], "shelf");
  EXPECT_EQ(report["pairs"][0]["state"], "contact");
  EXPECT_EQ(report["pairs"][0]["distance_mm"], 0.0);
}

TEST_F(Cli, ChecksDepthPlaceAndVolume) {
  write_box("peg", 4, 4, 9, 6, 6, 12);  // 1 mm into the block
  const Outcome o = run("check parts --json --tolerance 0.01 --html peg.html");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json report = Json::parse(o.out);
  EXPECT_EQ(report["version"], 2);
  const Json pair = report["pairs"][0];
  EXPECT_EQ(pair["state"], "overlapping");
  EXPECT_NEAR(pair["depth_mm"].get<double>(), 1, 0.01);
  EXPECT_NEAR(pair["deepest_at"][2].get<double>(), 9, 0.02);
  EXPECT_NEAR(pair["volume_mm3"].get<double>(), 4, 0.2);
  EXPECT_NE(run("check parts").out.find("1 overlapping"), std::string::npos);
  EXPECT_NE(read_all(in("peg.html")).find("overlapping"), std::string::npos);
}

TEST_F(Cli, MovesTouchesAndPassesItsOwnAudit) {
  const Outcome o = run("move parts pull.motion.json -o pull.path.json --tolerance 0.01 --timing steps.csv");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json path = Json::parse(read_all(in("pull.path.json")));
  const Json frames = path["moves"][0]["frames"];
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[1]["position"][0], 7.0);
  EXPECT_NEAR(frames[2]["position"][0].get<double>(), 10.5, 0.01);
  EXPECT_NE(o.out.find("wall"), std::string::npos);
  EXPECT_NE(read_all(in("steps.csv")).find("bvh_refit_ms"), std::string::npos);
  EXPECT_EQ(run("audit parts pull.path.json").exit_code, 0);
}

TEST_F(Cli, ReportsHowFarTheCentreOfTheMovingSetWent) {
  // A quarter turn about an axis through its centre, and 3 mm back: the origin of its coordinates moves 7 mm.
  write("turn.motion.json", R"({"format": "dismantle-motion", "version": 1, "response": "slide", "moves": [
      {"components": ["block"], "targets": [
        {"t": 0.0, "position": [0, 0, 0], "rotation": [1, 0, 0, 0]},
        {"t": 0.1, "position": [7, 0, 0], "rotation": [0.7071067811865476, 0, 0, 0.7071067811865476]}]}]})");
  const Outcome o = run("move parts turn.motion.json -o turn.path.json --json");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json move = Json::parse(o.out)["moves"][0];
  EXPECT_NEAR(move["asked_mm"].get<double>(), 3, 1e-9);
  EXPECT_NEAR(move["got_mm"].get<double>(), 3, 1e-9);
}

TEST_F(Cli, FailsTheAuditOfATamperedPath) {
  ASSERT_EQ(run("move parts pull.motion.json -o pull.path.json --tolerance 0.01").exit_code, 0);
  Json path = Json::parse(read_all(in("pull.path.json")));
  path["moves"][0]["frames"][2]["position"][0] = 30.0;
  write("pull.path.json", path.dump());
  const Outcome o = run("audit parts pull.path.json");
  EXPECT_EQ(o.exit_code, 1);
  EXPECT_NE((o.out + o.err).find("wall"), std::string::npos);
}

/// Two blocks that are 1 mm deep in each other, and a motion that takes one away.
constexpr const char* kAway = R"({"format": "dismantle-motion", "version": 1, "response": "touch", "moves": [
    {"components": ["upper"], "targets": [{"t": 0.0, "position": [0, 0, 0.5], "rotation": [1, 0, 0, 0]},
                                          {"t": 0.1, "position": [0, 0, 5], "rotation": [1, 0, 0, 0]}]}]})";

class CliOverlap : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    std::filesystem::create_directories(in("overlap"));
    write("overlap/lower.obj", box_text(0, 10));
    write("overlap/upper.obj", box_text(9, 19));
    write("away.motion.json", kAway);
  }

  static std::string box_text(double z0, double z1) {
    std::string text;
    for (const double z : {z0, z1})
      for (const char* xy : {"0 0", "10 0", "10 10", "0 10"})
        text += std::string("v ") + xy + " " + std::to_string(z) + "\n";
    return text +
           "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 "
           "8\n";
  }

  Json read_json(const char* file) { return Json::parse(read_all(in(file))); }
};

TEST_F(CliOverlap, WritesThePairsOfAPathAndAuditsThem) {
  ASSERT_EQ(run("move overlap away.motion.json -o away.path.json --tolerance 0.01").exit_code, 0);
  Json path = read_json("away.path.json");
  EXPECT_EQ(path["version"], 2);
  ASSERT_EQ(path["pairs"].size(), 1u);
  EXPECT_EQ(path["pairs"][0]["state"], "overlapping");
  EXPECT_NEAR(path["pairs"][0]["initial_depth_mm"].get<double>(), 1, 0.01);
  EXPECT_NEAR(path["pairs"][0]["allowed_depth_mm"].get<double>(), 1.01, 0.01);
  const Outcome good = run("audit overlap away.path.json");
  EXPECT_EQ(good.exit_code, 0) << good.out;
  EXPECT_NE(good.out.find("the guarantee holds\n"), std::string::npos) << good.out;

  path["pairs"][0]["allowed_depth_mm"] = 3;
  write("licence.path.json", path.dump());
  const Outcome licence = run("audit overlap licence.path.json");
  EXPECT_EQ(licence.exit_code, 1);
  EXPECT_NE(licence.out.find("are allowed 3 mm, more than their depth at the start"), std::string::npos) << licence.out;
  path["pairs"][0]["state"] = "declared";
  write("declared.path.json", path.dump());
  const Outcome declared = run("audit overlap declared.path.json");
  EXPECT_EQ(declared.exit_code, 0) << declared.out;
  EXPECT_NE(declared.out.find("1 pair declared by the user to get deeper:"), std::string::npos) << declared.out;
  path["pairs"].clear();
  write("unlisted.path.json", path.dump());
  EXPECT_EQ(run("audit overlap unlisted.path.json").exit_code, 1);
  expect_error("audit overlap away.path.json --solids", 2, "--solids");
}

TEST_F(CliOverlap, LetsDeclaredPairsGetDeeperAndTellsTheAudit) {
  write("deeper.motion.json", R"({"format": "dismantle-motion", "version": 1, "response": "touch", "moves": [
    {"components": ["upper"], "targets": [{"t": 0.0, "position": [0, 0, -5], "rotation": [1, 0, 0, 0]}]}]})");
  const auto depth = [&](const std::string& options) {
    const Outcome move = run("move overlap deeper.motion.json -o deeper.path.json --tolerance 0.01 " + options);
    EXPECT_EQ(move.exit_code, 0) << move.err;
    const Outcome audit = run("audit overlap deeper.path.json");
    EXPECT_EQ(audit.exit_code, 0) << audit.out;
    return 1 - read_json("deeper.path.json")["moves"][0]["frames"].back()["position"][2].get<double>();
  };
  EXPECT_LE(depth(""), 1.03);
  const double declared = depth("--allow lower upper 1.5");
  EXPECT_GT(declared, 1.4);
  EXPECT_LE(declared, 1.5);
  EXPECT_EQ(read_json("deeper.path.json")["pairs"][0]["state"], "declared");
  EXPECT_EQ(read_json("deeper.path.json")["pairs"][0]["allowed_depth_mm"], 1.5);
  expect_error("move overlap deeper.motion.json -o no.path.json --allow lower nothing 1", 2,
               "no component of that name");
  expect_error("move parts pull.motion.json -o no.path.json --allow block wall 1", 2, "do not touch");
  EXPECT_EQ(run("move overlap deeper.motion.json -o no.path.json --allow lower upper deep").exit_code, 2);
}

TEST_F(CliOverlap, SaysThatFreePairsAreUnchecked) {
  for (const char* options : {"--pairs paper", "--pairs paper --method streams"}) {
    const Outcome move =
        run(std::string("move overlap away.motion.json -o free.path.json --tolerance 0.01 ") + options);
    ASSERT_EQ(move.exit_code, 0) << move.err;
    const Json pair = read_json("free.path.json")["pairs"][0];
    EXPECT_EQ(pair["state"], "free") << options;
    EXPECT_TRUE(pair["allowed_depth_mm"].is_null()) << options;
    const Outcome text = run("audit overlap free.path.json");
    EXPECT_EQ(text.exit_code, 0) << text.out;
    EXPECT_NE(text.out.find("1 pair unchecked until they have been apart:"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("the guarantee holds, except for the unchecked pairs"), std::string::npos) << text.out;
    const Json json = Json::parse(run("audit overlap free.path.json --json").out);
    EXPECT_EQ(json["version"], 2);
    EXPECT_EQ(json["holds"], true);
    EXPECT_EQ(json["unchecked_pairs"], 1);
    EXPECT_EQ(json["pairs"][0]["checked"], "once apart");
    EXPECT_EQ(json["pairs"][0]["parted"], true);
  }
}

TEST_F(Cli, StopsOneStepBeforeTheWall) {
  for (const char* ccd : {"certified", "elementary"}) {
    const Outcome o =
        run(std::string("move parts pull.motion.json -o pull.path.json --method streams --response stop --ccd ") + ccd);
    ASSERT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(Json::parse(read_all(in("pull.path.json")))["moves"][0]["frames"][2]["position"][0], 7.0);
  }
}

TEST_F(Cli, WritesTheSameBytesForEveryThreadCount) {
  ASSERT_EQ(run("move parts pull.motion.json -o one.path.json --threads 1").exit_code, 0);
  ASSERT_EQ(run("move parts pull.motion.json -o many.path.json --threads 7").exit_code, 0);
  EXPECT_EQ(read_all(in("one.path.json")), read_all(in("many.path.json")));
}

TEST_F(Cli, SaysWhatToDoIfStreamsShouldSlide) {
  expect_error("move parts pull.motion.json -o pull.path.json --method streams --response slide", 2, "certificates");
}

TEST_F(Cli, RefusesAContinuousTestThatTheMethodDoesNotUse) {
  expect_error("move parts pull.motion.json -o pull.path.json --ccd elementary", 2, "streams");
}

TEST_F(Cli, SlidesByDefault) {
  const Outcome o = run("move parts pull.motion.json -o pull.path.json --response slide --json");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  EXPECT_EQ(Json::parse(o.out)["method"], "certificates");
  EXPECT_EQ(run("audit parts pull.path.json").exit_code, 0);
}

TEST_F(Cli, LeavesNoPartialFileIfItCannotWrite) {
  expect_error("move parts pull.motion.json -o nowhere/pull.path.json", 4, "nowhere");
}

TEST_F(Cli, ReadsWhatConvertWrites) {
  for (const char* file : {"out.obj", "out.stl", "out.glb", "out.dasm"}) {
    ASSERT_EQ(run(std::string("convert parts -o ") + file).exit_code, 0) << file;
    const Outcome o = run(std::string("info ") + file + " --json");
    ASSERT_EQ(o.exit_code, 0) << file << o.err;
    EXPECT_EQ(Json::parse(o.out)["assembly"]["triangles"], 24) << file;
  }
}

TEST_F(Cli, KeepsMotionsInDasmFilesOnly) {
  EXPECT_EQ(run("convert parts -o out.dasm --motion pull.motion.json").exit_code, 0);
  EXPECT_GT(fs::file_size(in("out.dasm")), 1000u);
  expect_error("convert parts -o out.glb --motion pull.motion.json", 2, ".dasm");
  write("other.motion.json",
        R"({"format": "dismantle-motion", "version": 1, "moves": [{"components": ["ball"], "targets": [
    {"t": 0.0, "position": [0, 0, 0], "rotation": [1, 0, 0, 0]}]}]})");
  expect_error("convert parts -o other.dasm --motion other.motion.json", 3, "ball");
  EXPECT_FALSE(fs::exists(in("other.dasm")));
  write("cut.dasm", read_all(in("out.dasm")).substr(0, 700));
  expect_error("info cut.dasm", 3, "cannot be read as DASM");
}

}  // namespace
}  // namespace dismantle
