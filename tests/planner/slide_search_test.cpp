// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/slide_search.h"

#include "dismantle/audit/audit_path.h"
#include "dismantle/geometry/adjacency.h"
#include "dismantle/planner/plan_path.h"
#include "tests/planner/plan_scenes.h"
#include "tests/support/puzzle_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

struct Puzzle {
  const char* name;
  std::vector<Component> components;
};

std::vector<Puzzle> puzzles() {
  return {{"L-slot", scenes::l_slot(0.1)}, {"hook", scenes::hook(0.1)}, {"bayonet", scenes::bayonet(0.1)}};
}

/// The plan for the last component.
Plan plan_for_last(const scenes::PlanScene& scene) {
  PlanOptions options;
  options.slide_effort = scenes::kSlideEffort;
  options.sample_effort = 0;
  const auto count = static_cast<std::uint32_t>(scene.assembly.components.size());
  for (std::uint32_t c = 0; c + 1 < count; ++c) options.fixed.emplace_back(c);
  return plan_disassembly(scene.assembly, scene.pairs, options);
}

TEST(SlideSearch, FindsThePathAroundCornersAndOutOfLocks) {
  for (const Puzzle& puzzle : puzzles()) {
    for (const Component& c : puzzle.components) EXPECT_EQ(edge_faults(*c.mesh).open, 0u) << puzzle.name;
    const scenes::PlanScene scene = scenes::plan_scene(scenes::assembly(puzzle.components));
    const Plan plan = plan_for_last(scene);
    ASSERT_EQ(plan.steps.size(), 1u) << puzzle.name;
    EXPECT_EQ(plan.steps[0].tier, PlanTier::Sliding) << puzzle.name;
    EXPECT_FALSE(plan.steps[0].poses.empty()) << puzzle.name;
    EXPECT_TRUE(plan.complete()) << puzzle.name;
  }
}

TEST(SlideSearch, TakesATargetOutThatDoesNotGoStraight) {
  const scenes::PlanScene scene = scenes::plan_scene(scenes::assembly(scenes::l_slot(0.1)));
  PlanOptions options;
  options.targets = {ComponentId(1)};
  const Plan plan = plan_disassembly(scene.assembly, scene.pairs, options);
  EXPECT_TRUE(plan.complete());
  ASSERT_EQ(plan.steps.size(), 1u);
  EXPECT_EQ(plan.steps[0].components, std::vector{ComponentId(1)});
}

TEST(SlideSearch, GivesPathsThatPassTheAudit) {
  for (const Puzzle& puzzle : puzzles()) {
    const scenes::PlanScene scene = scenes::plan_scene(scenes::assembly(puzzle.components));
    const Path path = plan_path(scene.assembly, scene.pairs, plan_for_last(scene));
    const AuditReport report = audit_path(scene.assembly, path, {});
    EXPECT_TRUE(report.holds()) << puzzle.name << ": "
                                << (report.violations.empty() ? "" : report.violations[0].message);
    EXPECT_EQ(path.removed.size(), 1u) << puzzle.name;
  }
}

TEST(SlideSearch, FindsThemInAnyOrientationAndSize) {
  std::mt19937_64 random(11);
  for (const Puzzle& puzzle : puzzles())
    for (const double scale : {0.01, 1000.0}) {
      const Pose pose = scenes::random_pose(random, 20, 3);
      const Assembly assembly = scenes::placed(scenes::assembly(puzzle.components), pose, scale);
      const Plan plan = plan_for_last(scenes::plan_scene(assembly, 0.01 * scale));
      ASSERT_EQ(plan.steps.size(), 1u) << puzzle.name << " at " << scale;
      EXPECT_EQ(plan.steps[0].tier, PlanTier::Sliding) << puzzle.name;
    }
}

TEST(SlideSearch, FindsNoExitFromAClosedTunnelOrALockWithoutSlots) {
  // The same tunnel with its mouth closed, the same socket with a lid that leaves room only for the plug's stem.
  std::vector<Component> slot = scenes::l_slot(0.1);
  slot.push_back(scenes::component("lid", scenes::box({-10, 20, -5}, {26, 24, 12})));
  std::vector<Component> lock = scenes::bayonet(0.1);
  lock.push_back(scenes::component("ring", scenes::tube(10, 5.1, 10, 12, 48)));
  std::swap(slot[1], slot[2]);
  std::swap(lock[1], lock[2]);
  for (const std::vector<Component>& locked : {slot, lock}) {
    const Plan plan = plan_for_last(scenes::plan_scene(scenes::assembly(locked)));
    EXPECT_TRUE(plan.steps.empty());
    EXPECT_FALSE(plan.complete());
  }
}

}  // namespace
}  // namespace dismantle
