// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/moves_table.h"

#include "dismantle/engine/classify_pairs.h"
#include "tests/export/export_scene.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <sstream>

namespace dismantle {
namespace {

/// The rows by column name. The scene's names contain no commas.
std::vector<std::map<std::string, std::string>> parse(const std::string& csv) {
  const auto split = [](const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line) c == ',' ? void(fields.emplace_back()) : fields.back().push_back(c);
    return fields;
  };
  std::istringstream in(csv);
  std::string line;
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(in, line)) {
    EXPECT_EQ(line.back(), '\r');
    line.pop_back();
    const std::vector<std::string> fields = split(line);
    if (names.empty()) {
      names = fields;
      continue;
    }
    EXPECT_EQ(fields.size(), names.size());
    rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) rows.back()[names[i]] = fields[i];
  }
  return rows;
}

TEST(MovesTable, ListsWhatMovesWhenAndHowFar) {
  const Assembly a = scenes::knob_on_block();
  const auto rows = parse(moves_csv(a, scenes::timeline_of(a, scenes::knob_path())));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("move"), "1");
  EXPECT_EQ(rows[0].at("label"), "screw off knob");
  EXPECT_EQ(rows[0].at("components"), "knob");
  EXPECT_EQ(rows[0].at("start_s"), "0");
  EXPECT_EQ(rows[0].at("end_s"), "0.75");
  EXPECT_EQ(rows[0].at("frames"), "3");
  EXPECT_EQ(rows[1].at("start_s"), "0.75");
  EXPECT_EQ(rows[2].at("end_s"), "3.75");
  EXPECT_EQ(rows[2].at("length_mm"), "60");
  EXPECT_EQ(rows[2].at("displacement_mm"), "60");
  EXPECT_EQ(rows[2].at("angle_rad"), "0");
  EXPECT_EQ(rows[2].at("to_y_mm"), "60");
  EXPECT_EQ(rows[0].at("least_clearance_mm"), "") << "it was not measured";
}

TEST(MovesTable, MeasuresThePathLengthAlongTheScrew) {
  const Assembly a = scenes::knob_on_block();
  const auto rows = parse(moves_csv(a, scenes::timeline_of(a, scenes::knob_path())));
  // The knob's centre is 3 mm from the axis: a helix of 6 mm rise over 2.5 rad, then 24 mm straight.
  EXPECT_NEAR(std::stod(rows[0].at("length_mm")), std::hypot(2.5 * 3, 6) + 24, 1e-6);
  EXPECT_NEAR(std::stod(rows[0].at("angle_rad")), 2.5, 1e-9);
  EXPECT_NEAR(std::stod(rows[0].at("displacement_mm")), std::hypot(2 * 3 * std::sin(1.25), 30), 1e-6);
}

TEST(MovesTable, HasTheReversedMovesForAssembly) {
  const Assembly a = scenes::knob_on_block();
  const auto rows = parse(moves_csv(a, scenes::timeline_of(a, scenes::knob_path()), {PathDirection::Reversed, {}}));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("label"), "block aside");
  EXPECT_EQ(rows[0].at("start_s"), "0");
  EXPECT_EQ(rows[0].at("end_s"), "2");
  EXPECT_EQ(rows[0].at("from_y_mm"), "60");
  EXPECT_EQ(rows[0].at("to_y_mm"), "0");
  EXPECT_EQ(rows[2].at("end_s"), "3.75");
}

TEST(MovesTable, GivesTheMinimumClearanceAndItsComponents) {
  const Assembly a = scenes::assembly({scenes::component("post", scenes::box({0, 0, 0}, {10, 10, 10})),
                                       scenes::component("ball", scenes::box({30, 0, 0}, {40, 10, 10})),
                                       scenes::component("far", scenes::box({0, 500, 0}, {10, 510, 10}))});
  Path path;
  path.components = {"post", "ball", "far"};
  path.moves = {{"nearer", {"ball"}, {{0, {}}, {1, {{-18, 0, 0}, {}}}, {2, {{30, 0, 0}, {}}}}}};
  const Timeline timeline = scenes::timeline_of(a, path);
  const Result<PairStates> states = classify_pairs(a, {});
  const auto clearances = move_clearances(a, *states, timeline);
  ASSERT_TRUE(clearances.has_value());
  ASSERT_EQ(clearances->size(), 1u);
  EXPECT_NEAR(clearances->front().distance, 2, 1e-12);
  EXPECT_EQ(clearances->front().time, 1);
  EXPECT_EQ(clearances->front().neighbour, ComponentId(0));

  const auto forward = parse(moves_csv(a, timeline, {PathDirection::Forward, *clearances}));
  EXPECT_EQ(forward[0].at("least_clearance_mm"), "2");
  EXPECT_EQ(forward[0].at("nearest"), "post");
  const auto back = parse(moves_csv(a, timeline, {PathDirection::Reversed, *clearances}));
  EXPECT_EQ(back[0].at("least_clearance_s"), "1");
}

TEST(MovesTable, MissesNoFrameNearerThanThoseMeasured) {
  const Assembly a = scenes::assembly({scenes::component("bar", scenes::box({-20, -2, 0}, {20, 2, 4})),
                                       scenes::component("post", scenes::box({21, -3, 0}, {25, 3, 4})),
                                       scenes::component("stop", scenes::box({-8, 9, 0}, {8, 30, 4}))});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> step(-0.4, 0.4);
  Path path;
  path.components = {"bar", "post", "stop"};
  path.moves = {{"about", {"bar"}, {{0, {}}}}};
  Pose pose;
  for (int k = 1; k <= 200; ++k) {
    pose = Pose{{step(random), step(random) - 0.1, step(random)}, quat_about({0, 0, 1}, 0.02 * step(random))} * pose;
    path.moves[0].frames.push_back({0.1 * k, pose});
  }
  const Timeline timeline = scenes::timeline_of(a, path);
  const PairStates states = *classify_pairs(a, {});
  const auto found = move_clearances(a, states, timeline);

  MoveClearance minimum{1e30, 0, {}};
  CertificateEngine engine(a, states);
  for (const Frame& frame : path.moves[0].frames) {
    engine.jump(std::vector<Pose>{frame.pose, {}, {}});
    engine.grab(std::vector<ComponentId>{ComponentId(0)});
    const Clearance now = engine.clearance();
    if (now.distance < minimum.distance) minimum = {now.distance, frame.time, now.fixed};
  }
  EXPECT_GT(minimum.time, 0) << "otherwise the test is void";
  EXPECT_EQ(found->front().distance, minimum.distance);
  EXPECT_EQ(found->front().time, minimum.time);
  EXPECT_EQ(found->front().neighbour, minimum.neighbour);
}

TEST(MovesTable, GivesNoClearanceIfThereIsNothingElse) {
  const Assembly a = scenes::assembly({scenes::component("post", scenes::box({0, 0, 0}, {10, 10, 10}))});
  Path path;
  path.components = {"post"};
  path.moves = {{"away", {"post"}, {{0, {}}, {1, {{9, 0, 0}, {}}}}}};
  const Timeline timeline = scenes::timeline_of(a, path);
  const auto clearances = move_clearances(a, *classify_pairs(a, {}), timeline);
  ASSERT_TRUE(clearances.has_value());
  EXPECT_EQ(parse(moves_csv(a, timeline, {PathDirection::Forward, *clearances}))[0].at("least_clearance_mm"), "");
}

TEST(MovesTable, StopsMeasuringWhenCancelled) {
  const Assembly a = scenes::knob_on_block();
  const Timeline timeline = scenes::timeline_of(a, scenes::knob_path());
  EXPECT_FALSE(
      move_clearances(a, *classify_pairs(a, {}), timeline, {}, [](std::string_view, double) { return false; }));
}

}  // namespace
}  // namespace dismantle
