// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/work_steps.h"

#include "tests/instructions/bolted_lid.h"

namespace dismantle {
namespace {

std::vector<WorkStep> steps_of(const Assembly& a, const Path& path, PathDirection direction = PathDirection::Forward) {
  return work_steps(a, scenes::timeline_of(a, path), direction);
}

TEST(WorkSteps, JoinEqualComponentsWithEqualMotionsInOneStep) {
  const std::vector<WorkStep> steps = steps_of(scenes::bolted_lid(), scenes::bolted_lid_path());
  ASSERT_EQ(steps.size(), 2u);
  ASSERT_EQ(steps[0].removals.size(), 2u);
  EXPECT_EQ(steps[0].removals[1].components, std::vector<ComponentId>{ComponentId(3)});
  EXPECT_EQ(steps[1].before[2].position, (Vec3{0, 0, 60}));
}

TEST(WorkSteps, SeparateEqualComponentsWithDifferentMotions) {
  Path path = scenes::bolted_lid_path();
  path.moves[1].frames.back().pose.position = {75, 0, 75};
  EXPECT_EQ(steps_of(scenes::bolted_lid(), path).size(), 3u);
}

TEST(WorkSteps, JoinMovesOfOneSetThatFollowEachOther) {
  Path path = scenes::bolted_lid_path();
  const Pose there{{0, 0, 60}, {}}, aside{{100, 0, 60}, {}};
  path.moves = {path.moves[0], {"on", {"bolt"}, {{0, there}, {1, aside}}}};
  const std::vector<WorkStep> steps = steps_of(scenes::bolted_lid(), path);
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].removals[0].poses, (std::vector<Pose>{{}, there, aside}));
}

TEST(WorkSteps, ComeInTheOtherOrderForTheAssemblyButStillLeadAway) {
  const std::vector<WorkStep> steps =
      steps_of(scenes::bolted_lid(), scenes::bolted_lid_path(), PathDirection::Reversed);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].removals[0].components, std::vector<ComponentId>{ComponentId(1)});
  EXPECT_EQ(steps[0].removals[0].poses.back().position, (Vec3{0, 0, 30}));
}

TEST(Surroundings, AreWhatStandsToASetAsAssembled) {
  const std::vector<WorkStep> steps = steps_of(scenes::bolted_lid(), scenes::bolted_lid_path());
  EXPECT_EQ(surroundings(steps[1], steps[1].removals[0]), std::vector<ComponentId>{ComponentId(0)})
      << "the bolts are elsewhere";
  WorkStep alone = steps[1];
  alone.removals[0].poses = {{{5, 0, 0}, {}}, {{9, 0, 0}, {}}};
  EXPECT_EQ(surroundings(alone, alone.removals[0]).size(), 3u) << "it keeps its relative pose to nothing";
}

TEST(PlacesAlong, BeginAtHomeEndAtTheEndAndHaveAllEndsOfScrews) {
  const RemovalMove removal{{ComponentId(0)}, {{}, {{3, 0, 0}, {}}, {{3, 4, 0}, {}}}};
  const std::vector<PathPose> poses = poses_along(removal, {}, 5);
  ASSERT_EQ(poses.size(), 11u);
  EXPECT_EQ(poses.front().pose, Pose{});
  EXPECT_EQ(poses[5].pose, removal.poses[1]);
  EXPECT_EQ(poses.back().pose, removal.poses[2]);
  EXPECT_NEAR(poses.back().distance, 7, 1e-12);
  EXPECT_LT(poses[1].distance, 3.0 / 5) << "positions are dense at the beginning";
}

}  // namespace
}  // namespace dismantle
