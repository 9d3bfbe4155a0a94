// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/path_file.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/loading/write_assembly.h"
#include "dismantle/planner/plan_disassembly.h"
#include "dismantle/planner/plan_path.h"
#include "tests/cli/cli_fixture.h"
#include "tests/support/joint_scenes.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace dismantle {
namespace {

using Json = nlohmann::json;

/// With a drawer of two boxes, one behind the other, that opens along +X: five walls around it.
class CliPlan : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    fs::remove(in("parts/block.obj"));
    fs::remove(in("parts/wall.obj"));
    write_box("back", 0, 0, 0, 10, 10, 10);
    write_box("front", 10, 0, 0, 20, 10, 10);
    write_box("floor", -5, -5, -5, 20, 15, 0);
    write_box("roof", -5, -5, 10, 20, 15, 15);
    write_box("left", -5, -5, 0, 20, 0, 10);
    write_box("right", -5, 10, 0, 20, 15, 10);
    write_box("end", -5, 0, 0, 0, 10, 10);
  }
};

TEST_F(CliPlan, DisassemblesEverythingOnAPathThatPassesTheAudit) {
  const Outcome o = run("plan parts -o all.path.json --json");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json plan = Json::parse(o.out);
  EXPECT_EQ(plan["complete"], true);
  EXPECT_EQ(plan["steps"].size(), 6u);
  EXPECT_EQ(plan["tiers"]["straight"], 6);
  EXPECT_EQ(plan["removed"].size(), 6u);
  EXPECT_EQ(run("audit parts all.path.json").exit_code, 0);
}

TEST_F(CliPlan, TreatsWhatBelongsTogetherAsOnePart) {
  const Outcome o = run("plan parts -o all.path.json --json --together back front --together 'r*'");
  ASSERT_EQ(o.exit_code, 2) << "back is one component";
  EXPECT_NE(o.err.find("'back' cannot be treated as one part"), std::string::npos) << o.err;
  const Outcome together = run("plan parts -o all.path.json --json --together '[bf][ar][co][kn]*'");
  ASSERT_EQ(together.exit_code, 0) << together.err;
  const Json plan = Json::parse(together.out);
  EXPECT_EQ(plan["together"], Json::parse(R"([["back", "front"]])"));
  EXPECT_EQ(plan["steps"].size(), 5u);
  EXPECT_EQ(plan["removed"].size(), 6u);
  EXPECT_EQ(run("audit parts all.path.json").exit_code, 0);
  EXPECT_NE(run("plan parts -o all.path.json --together '[bf][ar][co][kn]*'").out.find("one part: back, front\n"),
            std::string::npos);
  EXPECT_NE(run("why parts back --together '[bf][ar][co][kn]*'").out.find("more of its group"), std::string::npos);
  EXPECT_EQ(run("check parts --together '*'").out.find("back "), std::string::npos);
}

/// A base, three housings on it, and in these 13 bearings and 13 shafts, all in one row: one OBJ file each, in the
/// frame of the product, with numbers for names. Equal parts are turned about their axes by different angles.
void write_shafts(const fs::path& folder) {
  fs::create_directories(folder);
  int number = 0;
  const auto write = [&](const TriangleMesh& mesh) {
    const std::string name = std::to_string(++number);
    ASSERT_TRUE(write_assembly(folder / (name + ".obj"), scenes::assembly({scenes::component(name, mesh)})).ok());
  };
  write(scenes::box({-20, -20, -10}, {40 * 13, 20, 0}));
  double x = 0;
  for (const int places : {5, 4, 4}) {
    std::vector<TriangleMesh> housing;
    for (int k = 0; k < places; ++k, x += 40) {
      const auto turned = [&](const TriangleMesh& mesh, double angle) {
        return scenes::moved(mesh, {{x, 0, 0}, quat_about({0, 0, 1}, angle)});
      };
      housing.push_back(turned(scenes::bored(scenes::square(20), 8.05, 0, 15), 0));
      write(turned(scenes::bored(scenes::circle(8), 5, 0, 10), 0.1 * x));
      write(turned(scenes::tube(4.95, 0, 0, 60, 48), 0.07 * x));
    }
    write(scenes::joined(housing));
  }
}

TEST_F(CliPlan, GroupsEqualShaftsAndBearingsOfMeshesInFewSteps) {
  write_shafts(in("shafts"));
  ASSERT_EQ(run("plan shafts -o shafts.path.json").exit_code, 0);
  EXPECT_EQ(run("audit shafts shafts.path.json").exit_code, 0);
  ASSERT_EQ(run("export shafts shafts.path.json -o shafts-instructions.html").exit_code, 0);
  const std::string page = read_all(in("shafts-instructions.html"));
  const std::size_t at = page.find(" steps, 30 components of 5 kinds; 1 base part");
  ASSERT_NE(at, std::string::npos) << page.substr(page.find(" components of ") - 20, 60);
  EXPECT_LE(std::stoi(page.substr(page.rfind('>', at) + 1)), 10);
  EXPECT_NE(page.find("Remove 13 \u00d7 "), std::string::npos);
}

TEST_F(CliPlan, SaysHowScrewsAreTurnedAndWhatTheyHold) {
  ASSERT_TRUE(write_assembly(in("case.glb"), scenes::covered_case()).ok());
  const Outcome o = run("plan case.glb -o case.path.json --json");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json plan = Json::parse(o.out);
  ASSERT_EQ(plan["joints"].size(), 4u);
  EXPECT_EQ(plan["joints"][0]["held"], Json::parse(R"(["case", "cover"])"));
  EXPECT_EQ(plan["joints"][0]["thread_in"], "case");
  ASSERT_EQ(plan["steps"].size(), 6u);
  EXPECT_EQ(plan["steps"][4]["components"][0], "cover");
  EXPECT_FALSE(plan["steps"][4].contains("unscrew"));
  EXPECT_FALSE(plan["steps"][4].contains("still_held_by"));
  const Json& unscrew = plan["steps"][0]["unscrew"];
  EXPECT_NEAR(unscrew["turns"].get<double>(), 15, 1);
  EXPECT_EQ(unscrew["pitch_mm"], 0.8);
  EXPECT_EQ(unscrew["nominal"], true);
  EXPECT_EQ(run("audit case.glb case.path.json").exit_code, 0);
  EXPECT_NE(run("plan case.glb -o case.path.json").out.find("turns anticlockwise, 1"), std::string::npos);

  const Outcome any = run("plan case.glb -o any.path.json --json --fasteners any");
  ASSERT_EQ(any.exit_code, 0) << any.err;
  EXPECT_EQ(Json::parse(any.out)["joints"].size(), 0u);
  for (const Json& step : Json::parse(any.out)["steps"]) EXPECT_FALSE(step.contains("unscrew"));
  EXPECT_EQ(run("plan case.glb -o any.path.json --fasteners last").exit_code, 2);
}

TEST_F(CliPlan, ProposesWhatGivesAndTakesIt) {
  write_box("cable", 20, 3, 3, 24, 6, 6);  // touches the front
  const Outcome proposed = run("plan parts -o all.path.json");
  EXPECT_NE(proposed.out.find("Proposals (--accept-proposals takes them):\n  cable gives by "), std::string::npos)
      << proposed.out;
  EXPECT_NE(proposed.out.find("(its name says 'cable')"), std::string::npos);
  EXPECT_NE(run("check parts").out.find("cable gives by "), std::string::npos);
  EXPECT_EQ(run("plan parts -o all.path.json --no-proposals").out.find("ropos"), std::string::npos);
  const auto declared = [&] {
    std::size_t count = 0;
    const Json path = Json::parse(read_all(in("all.path.json")));
    for (const Json& pair : path["pairs"]) count += pair["state"] == "declared";
    return count;
  };
  EXPECT_EQ(declared(), 0u);

  const Outcome taken = run("plan parts -o all.path.json --accept-proposals --json");
  ASSERT_EQ(taken.exit_code, 0) << taken.err;
  const Json plan = Json::parse(taken.out);
  ASSERT_EQ(plan["proposals"].size(), 1u);
  EXPECT_EQ(plan["proposals"][0]["kind"], "flexible");
  EXPECT_EQ(plan["proposals"][0]["accepted"], true);
  EXPECT_EQ(plan["flexible"][0]["component"], "cable");
  EXPECT_EQ(declared(), 1u);
  EXPECT_EQ(run("audit parts all.path.json").exit_code, 0);

  ASSERT_EQ(run("plan parts -o all.path.json --flexible cable=0.25").exit_code, 0);
  EXPECT_EQ(declared(), 1u);
  EXPECT_NE(read_all(in("all.path.json")).find("0.25"), std::string::npos);
  expect_error("plan parts -o all.path.json --flexible cord", 2, "'cord' is unknown");
  expect_error("plan parts -o all.path.json --flexible cable=much", 2, "no number above 0");
  EXPECT_EQ(run("plan parts -o all.path.json --accept-proposals --no-proposals").exit_code, 2);
}

TEST_F(CliPlan, TakesProposalsBackThatKeepSomethingIn) {
  fs::remove_all(in("parts"));
  fs::create_directories(in("parts"));
  write_box("sheet", 0, 0, 0, 100, 60, 2);
  write_box("floor", -5, -5, -5, 105, 65, 0);
  write_box("left", -5, -5, 0, 0, 65, 10);
  write_box("right", 100, -5, 0, 105, 65, 10);
  write_box("front", 0, -5, 0, 100, 0, 10);
  write_box("back", 0, 60, 0, 100, 65, 10);
  for (int k = 0; k < 10; ++k) write_box("chip" + std::to_string(k), 9.0 * k + 2, 30, 2, 9.0 * k + 7, 35, 4);
  write_box("held", 20, 5, 2, 25, 10, 4);  // under the bar, and on the sheet
  write_box("bar", 0, 5, 4, 100, 10, 10);
  const std::string plan = "plan parts -o all.path.json --effort 0 --fixed floor left right front back bar --json ";
  const Json without = Json::parse(run(plan + "--no-proposals").out);
  EXPECT_EQ(without["removed"].size(), 10u);
  EXPECT_EQ(without["effort_spent"], true);
  const Json with = Json::parse(run(plan + "--accept-proposals").out);
  EXPECT_EQ(with["removed"].size(), 10u);
  ASSERT_EQ(with["proposals"].size(), 1u);
  EXPECT_EQ(with["proposals"][0]["name"], "sheet");
  EXPECT_EQ(with["proposals"][0]["accepted"], false);
  EXPECT_TRUE(with["together"].empty());
  // What the user names is not taken back.
  EXPECT_EQ(Json::parse(run(plan + "--together '[sc]h*'").out)["removed"].size(), 0u);
}

/// A servo of three parts in a pocket of the base, open above. Its arm reaches under a rod, and before the rod's end;
/// the rod can only slide out towards the arm, which can only slide the same way.
Assembly servo_with_rod() {
  using scenes::box;
  const auto part = [](const char* name, const TriangleMesh& mesh) { return scenes::component(name, mesh); };
  Assembly a = scenes::assembly(
      {part("base", scenes::joined({box({-50, -5, -30}, {35, 15, -20}), box({-50, -5, -20}, {-40, 15, 0}),
                                    box({-30, -5, -20}, {35, 15, 0}), box({-40, -5, -20}, {-30, 0, 0}),
                                    box({-40, 10, -20}, {-30, 15, 0})})),
       part("left", box({-28, -5, 0}, {30, 0, 20})), part("right", box({-28, 10, 0}, {30, 15, 20})),
       part("end", box({30, -5, 0}, {35, 15, 20})), part("roof", box({-28, 0, 15}, {30, 10, 20})),
       part("rod", box({-35, 0, 10}, {30, 10, 15})), part("gears", box({-40, 0, -20}, {-30, 10, -10})),
       part("body", box({-40, 0, -10}, {-30, 10, 0})),
       part("arm", scenes::joined({box({-40, 0, 0}, {-10, 10, 10}), box({-40, 0, 10}, {-35, 10, 15})}))});
  a.tree = {{"product", 0}, {"servo", 0}};
  for (std::uint32_t c = 0; c < a.components.size(); ++c) {
    a.components[c].tree_node = static_cast<std::uint32_t>(a.tree.size());
    a.tree.push_back({a.components[c].name, c < 6 ? 0u : 1u});
  }
  return a;
}

TEST_F(CliPlan, TakesOnlyWhatBlocksOutOfAProposal) {
  ASSERT_TRUE(write_assembly(in("servo.glb"), servo_with_rod()).ok());
  const std::string plan = "plan servo.glb -o all.path.json --effort 0 --fixed base left right end roof ";
  const Outcome named = run(plan + "--json --together servo");
  EXPECT_EQ(Json::parse(named.out)["removed"].size(), 0u) << "the servo and the rod hold each other";
  const Outcome o = run(plan + "--json --accept-proposals");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json made = Json::parse(o.out);
  EXPECT_EQ(made["removed"].size(), 4u);
  EXPECT_EQ(made["together"], Json::parse(R"([["gears", "body"]])"));
  ASSERT_EQ(made["proposals"].size(), 1u);
  EXPECT_EQ(made["proposals"][0]["accepted"], true);
  EXPECT_EQ(made["steps"].back()["components"], Json::parse(R"(["gears", "body"])"));
  EXPECT_EQ(run("audit servo.glb all.path.json").exit_code, 0);
  EXPECT_NE(run(plan + "--accept-proposals").out.find("without 1 of its components, which block what would stay"),
            std::string::npos);
}

TEST_F(CliPlan, WritesThePrecedenceGraph) {
  const std::string open = "plan parts -o one.path.json --target back --fixed floor roof left right end --graph ";
  ASSERT_EQ(run(open + "order.json").exit_code, 0);
  const Json graph = Json::parse(read_all(in("order.json")));
  EXPECT_EQ(graph["ranks"], Json({{1}, {2}}));
  EXPECT_EQ(graph["steps"][1]["before"], Json({1}));
  ASSERT_EQ(run(open + "order.svg").exit_code, 0);
  EXPECT_EQ(read_all(in("order.svg")).substr(0, 4), "<svg");
  ASSERT_EQ(run(open + "order.dot").exit_code, 0);
  EXPECT_NE(read_all(in("order.dot")).find("s1 -> s2;"), std::string::npos);
  expect_error(open + "order.txt", 2, "its extension is not a known format");
}

TEST_F(CliPlan, RemovesAsFewAsPossibleForATarget) {
  const std::string walls = " --fixed floor roof left right end";
  const Outcome o = run("plan parts -o one.path.json --json --target back" + walls);
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json plan = Json::parse(o.out);
  ASSERT_EQ(plan["steps"].size(), 2u);
  EXPECT_EQ(plan["steps"][0]["components"], Json::array({"front"}));
  EXPECT_EQ(plan["steps"][1]["components"], Json::array({"back"}));
  EXPECT_EQ(run("audit parts one.path.json").exit_code, 0);
}

TEST_F(CliPlan, WritesThePlainPlanWithoutPreferences) {
  ASSERT_EQ(run("plan parts -o all.path.json").exit_code, 0);
  const Assembly assembly = load_assembly(in("parts").string()).value();
  const PairStates pairs = classify_pairs(assembly, {}).value();
  const Plan plain = plan_disassembly(assembly, pairs, {});
  EXPECT_EQ(read_all(in("all.path.json")), path_text(plan_path(assembly, pairs, plain)));
  // Preferences can change the path, so that the test above means something.
  ASSERT_EQ(run("plan parts -o upright.path.json --prefer upright").exit_code, 0);
  EXPECT_NE(read_all(in("all.path.json")), read_all(in("upright.path.json")));
}

TEST_F(CliPlan, OrdersStepsByThePreferencesGiven) {
  // A shelf in a slot of a wall, and a larger cup on it.
  fs::remove_all(in("parts"));
  fs::create_directory(in("parts"));
  write_box("over", -20, -30, 2, 0, 30, 40);
  write_box("under", -20, -30, -40, 0, 30, 0);
  write_box("shelf", -4, -3, 0, 10, 3, 2);
  write_box("cup", 0, -6, 2, 9, 6, 22);
  const auto order = [&](const std::string& preferences) {
    const Outcome o = run("plan parts -o all.path.json --json --fixed over under --prefer " + preferences);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(run("audit parts all.path.json").exit_code, 0);
    const Json plan = Json::parse(o.out);
    Json names = Json::array();
    for (const Json& step : plan["steps"]) names.push_back(step["components"]);
    return names.dump();
  };
  EXPECT_EQ(order("direction"), R"([["shelf"],["cup"]])");
  EXPECT_EQ(order("support groups"), R"([["cup"],["shelf"]])");
  expect_error("plan parts -o all.path.json --prefer beauty", 2, "beauty");
  EXPECT_EQ(order("groups=1 support=8 tools loose=0.1"), order("support groups tools loose"));
  expect_error("plan parts -o all.path.json --prefer beauty=2", 2, "'beauty' is not one of");
  expect_error("plan parts -o all.path.json --prefer groups=0", 2, "'0' is not a number above 0");
  expect_error("plan parts -o all.path.json --prefer groups tools groups=2", 2, "names a criterion twice");
}

TEST_F(CliPlan, ExitsWith1AndSaysWhatBlocksIfNotAllCanBeRemoved) {
  const Outcome o = run("plan parts -o none.path.json --target back --fixed floor roof left right end front");
  EXPECT_EQ(o.exit_code, 1);
  EXPECT_NE(o.out.find("back is blocked by"), std::string::npos) << o.out;
  EXPECT_EQ(run("audit parts none.path.json").exit_code, 0);
}

TEST_F(CliPlan, TellsWhatBlocksAComponent) {
  const Outcome blocked = run("why parts back --json");
  EXPECT_EQ(blocked.exit_code, 1);
  const Json why = Json::parse(blocked.out);
  ASSERT_EQ(why["blocked_by"].size(), 1u);
  fs::remove(in("parts/" + why["blocked_by"][0]["component"].get<std::string>() + ".obj"));
  const Outcome free = run("why parts back");
  EXPECT_EQ(free.exit_code, 0) << "its only blocker is gone";
  EXPECT_NE(free.out.find("back can be removed along"), std::string::npos);
}

TEST_F(CliPlan, RefusesInvalidArguments) {
  expect_error("plan parts -o x.path.json --target lid", 2, "'lid' is unknown");
  expect_error("plan parts -o x.path.json --target back --fixed back", 2, "it is both target and fixed");
  expect_error("why parts lid", 2, "'lid' is unknown");
  expect_error("plan missing.step -o x.path.json", 3, "missing.step");
  EXPECT_EQ(run("plan parts").exit_code, 2);
  EXPECT_EQ(run("plan parts -o x.path.json --time-limit 0").exit_code, 2);
  EXPECT_EQ(run("plan parts -o x.path.json --effort -1").exit_code, 2);
  EXPECT_FALSE(fs::exists(in("x.path.json")));
}

TEST_F(CliPlan, KeepsTheTimeLimit) {
  EXPECT_EQ(run("plan parts -o straight.path.json --effort 0").exit_code, 0);
  EXPECT_EQ(run("audit parts straight.path.json").exit_code, 0);
}

TEST_F(CliPlan, WritesThePartialPlanWhenTimeIsUp) {
  const Outcome o = run("plan parts -o early.path.json --json --time-limit 1e-6");
  EXPECT_EQ(o.exit_code, 1) << o.err;
  EXPECT_EQ(Json::parse(o.out)["out_of_time"], true);
  EXPECT_EQ(run("audit parts early.path.json").exit_code, 0);
}

}  // namespace
}  // namespace dismantle
