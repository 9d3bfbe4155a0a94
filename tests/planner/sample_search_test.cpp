// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/sample_search.h"

#include "dismantle/audit/audit_path.h"
#include "dismantle/geometry/adjacency.h"
#include "dismantle/planner/plan_path.h"
#include "tests/planner/plan_scenes.h"
#include "tests/support/puzzle_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Plan plan_by_chance(const scenes::PlanScene& scene, std::size_t effort) {
  PlanOptions options;
  options.slide_effort = 0;
  options.sample_effort = effort;
  const auto count = static_cast<std::uint32_t>(scene.assembly.components.size());
  for (std::uint32_t c = 0; c + 1 < count; ++c) options.fixed.emplace_back(c);
  return plan_disassembly(scene.assembly, scene.pairs, options);
}

TEST(SampleSearch, LeadsARingThroughTheGapOfAnother) {
  // Chance decides: one in ten of such rings is not led out. Through some gaps, a ring goes straight.
  int out = 0, sampled = 0;
  for (const double gap : {4.7, 4.8, 5.0, 5.3, 5.5, 5.6, 5.7, 5.9}) {
    SCOPED_TRACE(gap);
    const std::vector<Component> rings = scenes::open_rings(gap);
    for (const Component& c : rings) EXPECT_EQ(edge_faults(*c.mesh).open, 0u);
    const scenes::PlanScene scene = scenes::plan_scene(scenes::assembly(rings));
    const Plan plan = plan_by_chance(scene, 400'000);
    if (!plan.complete()) continue;
    ++out;
    ASSERT_EQ(plan.steps.size(), 1u);
    sampled += plan.steps[0].tier == PlanTier::Sampled ? 1 : 0;
    EXPECT_TRUE(audit_path(scene.assembly, plan_path(scene.assembly, scene.pairs, plan), {}).holds());
  }
  EXPECT_GE(out, 6);
  EXPECT_GE(sampled, 3);
}

TEST(SampleSearch, GivesTheSamePathForTheSameInput) {
  const scenes::PlanScene scene = scenes::plan_scene(scenes::assembly(scenes::open_rings(6.1)));
  const Plan first = plan_by_chance(scene, 400'000), second = plan_by_chance(scene, 400'000);
  ASSERT_EQ(first.steps.size(), 1u);
  EXPECT_EQ(first.steps[0].tier, PlanTier::Sampled);
  ASSERT_EQ(second.steps.size(), 1u);
  EXPECT_EQ(first.steps[0].poses, second.steps[0].poses);
}

TEST(SampleSearch, FindsNoExitFromAClosedShellAndEnds) {
  const scenes::PlanScene scene = scenes::plan_scene(scenes::closed_shell());
  EXPECT_TRUE(plan_by_chance(scene, 20'000).steps.empty());
  const scenes::PlanScene links = scenes::plan_scene(scenes::assembly(scenes::chain_links()));
  EXPECT_TRUE(plan_by_chance(links, 20'000).steps.empty());
}

TEST(SampleSearch, SaysWhetherMoreEffortMayFindMore) {
  const scenes::PlanScene rings = scenes::plan_scene(scenes::assembly(scenes::open_rings(6.1)));
  const Plan early = plan_by_chance(rings, 100);
  ASSERT_FALSE(early.staying.empty());
  EXPECT_TRUE(early.effort_spent);
  EXPECT_FALSE(plan_by_chance(rings, 400'000).effort_spent);  // nothing stays

  // A component that only rattles in a closed shell is given up, whatever the effort.
  const scenes::PlanScene shell = scenes::plan_scene(scenes::closed_shell());
  const Plan locked = plan_disassembly(shell.assembly, shell.pairs, {});
  ASSERT_FALSE(locked.staying.empty());
  EXPECT_FALSE(locked.effort_spent);
}

}  // namespace
}  // namespace dismantle
