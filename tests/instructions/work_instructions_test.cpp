// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/work_instructions.h"

#include "tests/fasteners/turned_meshes.h"
#include "tests/instructions/bolted_lid.h"
#include "tests/support/joint_scenes.h"

#include <algorithm>

namespace dismantle {
namespace {

WorkInstructionsOptions small(PathDirection direction = PathDirection::Forward) {
  WorkInstructionsOptions options;
  options.direction = direction;
  options.picture_width = 64;
  options.picture_height = 48;
  return options;
}

WorkInstructions written(const Assembly& a, const PairStates& pairs, const Path& path,
                         const WorkInstructionsOptions& options = small()) {
  Result<WorkInstructions> made = work_instructions(a, pairs, scenes::timeline_of(a, path), options);
  EXPECT_TRUE(made.ok()) << made.error().message;
  return std::move(*made);
}

/// The step's sentences of a kind, joined.
std::string said(const Instruction& step, InstructionNote::Kind kind) {
  std::string text;
  for (const InstructionNote& note : step.notes)
    if (note.kind == kind) text += note.text + "\n";
  return text;
}

TEST(WorkInstructions, CountEqualComponentsNameToolsAndListTheParts) {
  const WorkInstructions made = written(scenes::bolted_lid(), scenes::bolted_lid_pairs(), scenes::bolted_lid_path());
  ASSERT_EQ(made.steps.size(), 2u);
  EXPECT_EQ(made.steps[0].title, "Remove 2 \u00d7 bolt");
  EXPECT_EQ(said(made.steps[0], InstructionNote::Kind::Motion),
            "Straight up. Remove one at a time, all in the same direction.\n");
  EXPECT_EQ(said(made.steps[0], InstructionNote::Kind::Tool), "7 mm spanner (wrench)\n");
  EXPECT_EQ(said(made.steps[0], InstructionNote::Kind::Clearance).substr(0, 25), "Touches lid at the start.");
  EXPECT_EQ(made.tools, std::vector<std::string>{"7 mm spanner (wrench)"});
  EXPECT_EQ(made.stationary, std::vector<std::string>{"base"});
  ASSERT_EQ(made.parts.size(), 3u);
  EXPECT_EQ(made.parts[2].count, 2u);
  EXPECT_EQ(made.parts[2].steps, std::vector<std::size_t>{1});
  EXPECT_EQ(part_text(made, made.steps[0].parts[0]), "2 \u00d7 bolt (item 3)");
  EXPECT_EQ(summary_text(made).substr(0, 55), "2 steps, 4 components of 3 kinds; 1 base part. Source: ");
}

TEST(WorkInstructions, NameFastenersTheirToolsAndThreads) {
  Assembly a = scenes::bolted_lid();
  TriangleMesh head = scenes::screw(5, 16, scenes::circle(4.25), 5, scenes::hexagon(4), 2.5);
  for (Vec3& p : head.vertices) p.z += 5;
  for (std::size_t c = 2; c < 4; ++c) a.components[c].mesh = std::make_shared<const TriangleMesh>(head);
  a.components[2].name = "part 7";
  a.components[3].name = "part 7#2";
  Path path = scenes::bolted_lid_path();
  path.components = {"base", "lid", "part 7", "part 7#2"};
  path.moves[0].components = {"part 7"};
  path.moves[1].components = {"part 7#2"};
  const WorkInstructions made = written(a, scenes::bolted_lid_pairs(), path);
  EXPECT_EQ(made.steps[0].title, "Unscrew 2 \u00d7 part 7 (socket head screw M5x16)");
  EXPECT_EQ(said(made.steps[0], InstructionNote::Kind::Tool), "4 mm hex key\n");
  EXPECT_EQ(said(made.steps[0], InstructionNote::Kind::Warning), "") << "the motion tells the turns";
  const std::string motion = said(made.steps[0], InstructionNote::Kind::Motion);
  EXPECT_EQ(motion.substr(0, 8), "Unscrew ");
  EXPECT_NE(motion.find(" turns anticlockwise, 11"), std::string::npos) << motion;
  EXPECT_EQ(made.tools, std::vector<std::string>{"4 mm hex key"});
  EXPECT_EQ(part_name_text(made.parts[2]), "part 7, socket head screw M5x16");
}

TEST(WorkInstructions, TakeNoHexagonOfAWidePartForADrive) {
  Assembly a = scenes::bolted_lid();
  const TriangleMesh wide = scenes::joined({*a.components[2].mesh, scenes::box({40, 0, 20}, {90, 20, 30})});
  for (std::size_t c = 2; c < 4; ++c) a.components[c].mesh = std::make_shared<const TriangleMesh>(wide);
  const WorkInstructions made = written(a, scenes::bolted_lid_pairs(), scenes::bolted_lid_path());
  EXPECT_EQ(said(made.steps[0], InstructionNote::Kind::Tool), "");
  EXPECT_TRUE(made.tools.empty());
}

/// A path that moves sets of components up or down, one after another.
Path path_of(const Assembly& a, const std::vector<std::pair<std::vector<std::string>, double>>& moves) {
  Path path;
  for (const Component& c : a.components) path.components.push_back(c.name);
  for (const auto& [components, height] : moves)
    path.moves.push_back({"remove", components, {{0, {}}, {1, {{0, 0, height}, {}}}}});
  return path;
}

TEST(WorkInstructions, SayHowAThreadIsUndone) {
  const Assembly a = scenes::covered_case();
  const Path path =
      path_of(a, {{{"screw"}, 60}, {{"screw#2"}, 70}, {{"screw#3"}, 80}, {{"screw#4"}, 90}, {{"cover"}, 50}});
  const WorkInstructions out = written(a, {0.05, {}}, path);
  ASSERT_EQ(out.steps.size(), 2u);
  EXPECT_EQ(out.steps[0].title, "Unscrew 4 \u00d7 screw (socket head screw M5x16)");
  EXPECT_EQ(said(out.steps[0], InstructionNote::Kind::Motion).substr(0, 36), "Unscrew 15 turns anticlockwise, 12 m");
  EXPECT_EQ(said(out.steps[0], InstructionNote::Kind::Warning).find("The rotation is not shown"), std::string::npos);
  EXPECT_EQ(said(out.steps[1], InstructionNote::Kind::Warning).find("Still held"), std::string::npos);
  const WorkInstructions back = written(a, {0.05, {}}, path, small(PathDirection::Reversed));
  EXPECT_NE(said(back.steps[1], InstructionNote::Kind::Motion).find(" Screw in 15 turns clockwise, 12"),
            std::string::npos);
}

TEST(WorkInstructions, NameTheFastenersThatStillHoldAPart) {
  const Assembly a = scenes::covered_case();
  const WorkInstructions out = written(a, {0.05, {}}, path_of(a, {{{"screw"}, 60}, {{"cover"}, 50}}));
  ASSERT_EQ(out.steps.size(), 2u);
  EXPECT_NE(said(out.steps[1], InstructionNote::Kind::Warning)
                .find("Still held by screw#2, screw#3 and screw#4: loosen that first, if you can."),
            std::string::npos)
      << said(out.steps[1], InstructionNote::Kind::Warning);
}

TEST(WorkInstructions, TakeAScrewAndItsWasherForOne) {
  const Assembly a = scenes::bolted_plates();
  const WorkInstructions out =
      written(a, {0.05, {}}, path_of(a, {{{"nut", "washer#2"}, -40}, {{"bolt", "washer"}, 50}, {{"upper"}, 40}}));
  ASSERT_EQ(out.steps.size(), 3u);
  EXPECT_EQ(out.steps[0].title.substr(0, 8), "Unscrew ");
  EXPECT_EQ(out.steps[0].title.find("together"), std::string::npos) << out.steps[0].title;
  EXPECT_EQ(said(out.steps[0], InstructionNote::Kind::Motion).substr(0, 8), "Unscrew ");
  EXPECT_EQ(said(out.steps[0], InstructionNote::Kind::Warning).find("as a unit"), std::string::npos);
  EXPECT_EQ(said(out.steps[0], InstructionNote::Kind::Tool), "8 mm spanner (wrench)\n");
  // Its nut is gone.
  EXPECT_EQ(out.steps[1].title.substr(0, 7), "Remove ") << out.steps[1].title;
  EXPECT_EQ(said(out.steps[1], InstructionNote::Kind::Motion), "Straight up.\n");
  EXPECT_EQ(said(out.steps[1], InstructionNote::Kind::Tool), "");
  EXPECT_EQ(said(out.steps[1], InstructionNote::Kind::Warning).find("thread"), std::string::npos);
}

TEST(WorkInstructions, AreReversedForAssembly) {
  const WorkInstructions made = written(scenes::bolted_lid(), scenes::bolted_lid_pairs(), scenes::bolted_lid_path(),
                                        small(PathDirection::Reversed));
  ASSERT_EQ(made.steps.size(), 2u);
  EXPECT_EQ(made.title.substr(0, 9), "Assembly ");
  EXPECT_EQ(made.steps[0].title, "Mount lid");
  EXPECT_EQ(said(made.steps[0], InstructionNote::Kind::Motion), "Straight down.\n");
  EXPECT_EQ(made.steps[1].title, "Mount 2 \u00d7 bolt");
}

TEST(WorkInstructions, WarnOfSeveralAtOnceAndDeclareOverlaps) {
  Path path = scenes::bolted_lid_path();
  path.moves = {{"all", {"lid", "bolt", "bolt#2"}, {{0, {}}, {1, {{0, 0, 60}, {}}}}}};
  PairStates pairs = scenes::bolted_lid_pairs();
  pairs.pairs[0] = {ComponentId(0), ComponentId(1), PairState::Overlapping, 0, 0.05, 0.06};
  const WorkInstructions made = written(scenes::bolted_lid(), pairs, path);
  EXPECT_EQ(made.steps[0].title, "Remove lid and 2 \u00d7 bolt together");
  EXPECT_EQ(said(made.steps[0], InstructionNote::Kind::Warning), "Remove these 3 parts as a unit.\n");
  EXPECT_EQ(said(made.steps[0], InstructionNote::Kind::Overlap),
            "lid overlaps base by 0.05 mm: press fit, thread, or an error of the model.\n");

  pairs.pairs[0].state = PairState::Free;
  EXPECT_EQ(said(written(scenes::bolted_lid(), pairs, path).steps[0], InstructionNote::Kind::Overlap),
            "lid and base: collision is not checked until they are apart.\n");
}

TEST(WorkInstructions, CountEqualOverlapsAndNameTheProduct) {
  PairStates pairs = scenes::bolted_lid_pairs();
  for (const std::size_t k : {1, 2})
    pairs.pairs[k] = {
        ComponentId(1), ComponentId(static_cast<std::uint32_t>(k + 1)), PairState::Overlapping, 0, 0.05, 0.06};
  WorkInstructionsOptions options = small();
  options.product = "vice";
  const WorkInstructions made = written(scenes::bolted_lid(), pairs, scenes::bolted_lid_path(), options);
  EXPECT_EQ(made.title, "Disassembly of vice");
  EXPECT_EQ(said(made.steps[0], InstructionNote::Kind::Overlap),
            "2 \u00d7 bolt overlap lid by 0.05 mm: press fit, thread, or an error of the model.\n");
  pairs.pairs[2].depth = 0.06;
  EXPECT_EQ(
      said(written(scenes::bolted_lid(), pairs, scenes::bolted_lid_path()).steps[0], InstructionNote::Kind::Overlap),
      "2 \u00d7 bolt overlap lid by up to 0.06 mm: press fit, thread, or an error of the model.\n");
}

TEST(WorkInstructions, CountWhatIsUnsupported) {
  // A shelf on a wall, with equal cups and a jug on it.
  const Assembly a = scenes::assembly({scenes::component("wall", scenes::box({-10, -50, -50}, {0, 50, 50})),
                                       scenes::component("shelf", scenes::box({0, -30, -2}, {20, 30, 0})),
                                       scenes::component("cup", scenes::box({5, -3, 0}, {12, 3, 9})),
                                       scenes::component("cup#2", scenes::box({5, 7, 0}, {12, 13, 9})),
                                       scenes::component("jug", scenes::box({5, 17, 0}, {14, 25, 12}))});
  PairStates pairs{0.01, {}};
  for (const std::uint32_t c : {0, 2, 3, 4})
    pairs.pairs.push_back({ComponentId(std::min(c, 1u)), ComponentId(std::max(c, 1u)), PairState::Contact, 0, 0, 0.01});
  Path path = scenes::bolted_lid_path();
  path.moves = {{"shelf", {"shelf"}, {{0, {}}, {1, {{100, 0, 0}, {}}}}}};
  EXPECT_EQ(said(written(a, pairs, path).steps[0], InstructionNote::Kind::Warning),
            "2 \u00d7 cup and jug are unsupported after this step. Support them first.\n");
}

TEST(WorkInstructions, CallABodyByItsNameInTheProductTree) {
  Assembly a = scenes::bolted_lid();
  a.tree.push_back({"cover assembly", 0});
  for (const std::size_t c : {1, 2, 3}) a.tree[a.components[c].tree_node].parent = 5;
  Path path = scenes::bolted_lid_path();
  path.moves = {{"all", {"lid", "bolt", "bolt#2"}, {{0, {}}, {1, {{0, 0, 60}, {}}}}}};
  EXPECT_EQ(written(a, scenes::bolted_lid_pairs(), path).steps[0].title, "Remove cover assembly");
}

TEST(WorkInstructions, SayWhatMovesWithoutLeaving) {
  Path path = scenes::bolted_lid_path();
  path.moves = {{"shift", {"bolt"}, {{0, {}}, {1, {{3, 0, 0}, {}}}}}};
  const WorkInstructions made = written(scenes::bolted_lid(), scenes::bolted_lid_pairs(), path);
  EXPECT_EQ(made.steps[0].title, "Move bolt");
  EXPECT_EQ(said(made.steps[0], InstructionNote::Kind::Clearance), "Slides along lid for about the first 3 mm.\n");
}

TEST(WorkInstructions, HaveSomethingToTell) {
  const Assembly a = scenes::bolted_lid();
  const auto none = work_instructions(a, scenes::bolted_lid_pairs(), Timeline(), small());
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().kind, ErrorKind::Usage);

  WorkInstructionsOptions cancelled = small();
  cancelled.progress = [](std::string_view, double) { return false; };
  const auto half =
      work_instructions(a, scenes::bolted_lid_pairs(), scenes::timeline_of(a, scenes::bolted_lid_path()), cancelled);
  ASSERT_FALSE(half.ok());
  EXPECT_EQ(half.error().kind, ErrorKind::Failed);
}

}  // namespace
}  // namespace dismantle
