// SPDX-License-Identifier: Apache-2.0
// Runs the program as a user does, and looks at its exit code and what it prints and writes.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace dismantle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

std::string read_all(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A folder of its own for each test, with an assembly: a block in front of a wall.
class Cli : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        fs::temp_directory_path() / ("dismantle_cli_" + std::string(info->name()) + "_" + std::to_string(getpid()));
    fs::create_directories(folder_ / "parts");
    write_box("block", 0, 0, 0, 10, 10, 10);
    write_box("wall", 20.5, -50, -50, 21, 50, 50);
    write("pull.motion.json", R"({"format": "dismantle-motion", "version": 1, "response": "touch", "moves": [
      {"components": ["block"], "targets": [
        {"t": 0.0, "position": [0, 0, 0], "rotation": [1, 0, 0, 0]},
        {"t": 0.1, "position": [7, 0, 0], "rotation": [1, 0, 0, 0]},
        {"t": 0.2, "position": [30, 0, 0], "rotation": [1, 0, 0, 0]}]}]})");
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path in(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(in(name)) << text; }
  void write_box(const std::string& name, double x0, double y0, double z0, double x1, double y1, double z1) const {
    std::ofstream obj(in("parts/" + name + ".obj"));
    for (int i = 0; i < 8; ++i)
      obj << "v " << (i & 1 ? x1 : x0) << ' ' << (i & 2 ? y1 : y0) << ' ' << (i & 4 ? z1 : z0) << '\n';
    obj << "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\nf 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 "
           "6\n";
  }

  Outcome run(const std::string& arguments) const {
    const std::string command = std::string("cd '") + folder_.string() + "' && '" DISMANTLE_PROGRAM "' " + arguments +
                                " >'" + in("stdout").string() + "' 2>'" + in("stderr").string() + "' </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_all(in("stdout")),
            read_all(in("stderr"))};
  }

  /// One sentence on stderr, this exit code, nothing on stdout.
  void expect_error(const std::string& arguments, int exit_code, const std::string& part) const {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.exit_code, exit_code) << arguments << '\n' << o.err;
    EXPECT_EQ(o.out, "") << arguments;
    EXPECT_NE(o.err.find(part), std::string::npos) << arguments << '\n' << o.err;
  }

  fs::path folder_;
};

TEST_F(Cli, ListsItsCommandsInTheHelp) {
  const Outcome o = run("--help");
  EXPECT_EQ(o.exit_code, 0);
  for (const char* command : {"info", "check", "move", "audit", "convert", "simplify", "render", "sample"})
    EXPECT_NE(o.out.find(command), std::string::npos) << command;
}

TEST_F(Cli, AnswersWrongUsageWithTwo) {
  EXPECT_EQ(run("").exit_code, 2);
  EXPECT_EQ(run("dance").exit_code, 2);
  EXPECT_EQ(run("info").exit_code, 2);
  EXPECT_EQ(run("info parts --units parsec").exit_code, 2);
  EXPECT_EQ(run("info parts --tolerance -1").exit_code, 2);
  expect_error("check parts --device cuda", 2, "CUDA");
}

TEST_F(Cli, AnswersUnreadableInputWithThreeAndOneSentence) {
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

TEST_F(Cli, TellsAboutAnAssembly) {
  const Outcome o = run("info parts --json");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json info = Json::parse(o.out);
  EXPECT_EQ(info["assembly"]["components"], 2);
  EXPECT_EQ(info["assembly"]["triangles"], 24);
  EXPECT_EQ(info["components"][0]["name"], "block");
  EXPECT_EQ(info["components"][0]["closed"], true);
  EXPECT_NE(run("info parts").out.find("block"), std::string::npos);
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

TEST_F(Cli, FailsTheAuditOfATamperedPath) {
  ASSERT_EQ(run("move parts pull.motion.json -o pull.path.json --tolerance 0.01").exit_code, 0);
  Json path = Json::parse(read_all(in("pull.path.json")));
  path["moves"][0]["frames"][2]["position"][0] = 30.0;
  write("pull.path.json", path.dump());
  const Outcome o = run("audit parts pull.path.json");
  EXPECT_EQ(o.exit_code, 1);
  EXPECT_NE((o.out + o.err).find("wall"), std::string::npos);
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

TEST_F(Cli, SaysWhatToDoWhereStreamsShouldSlide) {
  expect_error("move parts pull.motion.json -o pull.path.json --method streams --response slide", 2, "certificates");
}

TEST_F(Cli, RefusesAContinuousTestThatTheMethodHasNoUseFor) {
  expect_error("move parts pull.motion.json -o pull.path.json --ccd elementary", 2, "streams");
}

TEST_F(Cli, SlidesByDefault) {
  const Outcome o = run("move parts pull.motion.json -o pull.path.json --response slide --json");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  EXPECT_EQ(Json::parse(o.out)["method"], "certificates");
  EXPECT_EQ(run("audit parts pull.path.json").exit_code, 0);
}

TEST_F(Cli, LeavesNoHalfWrittenFileWhereItCannotWrite) {
  expect_error("move parts pull.motion.json -o nowhere/pull.path.json", 4, "nowhere");
}

TEST_F(Cli, ReadsWhatConvertWrites) {
  for (const char* file : {"out.obj", "out.stl", "out.glb"}) {
    ASSERT_EQ(run(std::string("convert parts -o ") + file).exit_code, 0) << file;
    const Outcome o = run(std::string("info ") + file + " --json");
    ASSERT_EQ(o.exit_code, 0) << file << o.err;
    EXPECT_EQ(Json::parse(o.out)["assembly"]["triangles"], 24) << file;
  }
}

}  // namespace
}  // namespace dismantle
