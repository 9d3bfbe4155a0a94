// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/plan_disassembly.h"

#include "dismantle/audit/audit_path.h"
#include "dismantle/planner/plan_path.h"
#include "tests/planner/plan_scenes.h"
#include "tests/support/disassembly_cases.h"

#include <gtest/gtest.h>

#include <set>

namespace dismantle {
namespace {

using scenes::plan_scene;
using scenes::PlanScene;

Plan plan_of(const Assembly& assembly, PlanOptions options = {}) {
  const PlanScene scene = plan_scene(assembly);
  options.slide_effort = scenes::kSlideEffort;
  options.sample_effort = 0;
  return plan_disassembly(scene.assembly, scene.pairs, options);
}

/// The components that a step removes individually.
std::set<std::uint32_t> taken_out(const Plan& plan) {
  std::set<std::uint32_t> found;
  for (const PlanStep& step : plan.steps)
    if (step.components.size() == 1) found.insert(step.components[0].value);
  return found;
}

TEST(PlanDisassembly, TakesOutWhatGoesStraight) {
  for (const Assembly& assembly : {scenes::peg_in_hole(24, 0).assembly, scenes::peg_in_hole(64, 0.05).assembly,
                                   scenes::press_fit_pin(24, 0.02).assembly, scenes::key_in_slot(0, {0, 1, 0}).assembly,
                                   scenes::plate_in_slot(0.01).assembly, scenes::dovetail(0.01).assembly,
                                   scenes::part_in_corner().assembly, scenes::stack_in_tube(5)}) {
    const Plan plan = plan_of(assembly);
    EXPECT_TRUE(plan.complete()) << assembly.components[1].name;
    EXPECT_EQ(plan.steps.size(), assembly.components.size() - 1);
  }
}

std::vector<ComponentId> ids(const Assembly& assembly, const std::vector<std::string>& names) {
  std::vector<ComponentId> found;
  found.reserve(names.size());
  for (const std::string& name : names) found.push_back(*assembly.find(name));
  std::sort(found.begin(), found.end());
  return found;
}

TEST(PlanDisassembly, TakesGroupsOutAsOnePart) {
  const Assembly stack = scenes::stack_in_tube(5);
  PlanOptions options;
  options.together = {ids(stack, {"box 1", "box 2"}), ids(stack, {"box 4", "box 3"})};
  const Plan plan = plan_of(stack, options);
  EXPECT_TRUE(plan.complete());
  ASSERT_EQ(plan.steps.size(), 3u);
  std::set<std::vector<ComponentId>> moved;
  for (const PlanStep& step : plan.steps) {
    EXPECT_EQ(step.part_of, PlanStep::kWhole);
    moved.insert(step.components);
  }
  EXPECT_TRUE(moved.count(options.together[0]) == 1 && moved.count(ids(stack, {"box 3", "box 4"})) == 1);
  const PlanScene scene = plan_scene(stack);
  EXPECT_TRUE(audit_path(stack, plan_path(stack, scene.pairs, plan), {}).holds());

  options.targets = ids(stack, {"box 2"});
  const Plan one = plan_of(stack, options);
  EXPECT_TRUE(one.complete());
  EXPECT_EQ(one.steps.back().components, options.together[0]);
}

TEST(PlanDisassembly, KeepsTheGroupOfWhatStays) {
  const Assembly stack = scenes::stack_in_tube(3);
  PlanOptions options;
  options.together = {ids(stack, {"tube", "box 1"})};
  const Plan plan = plan_of(stack, options);
  EXPECT_TRUE(plan.complete());
  EXPECT_EQ(plan.steps.size(), 2u);
  options.together = {ids(stack, {"tube", "box 0", "box 2"})};
  const Plan held = plan_of(stack, options);  // the box between the other two cannot get out
  EXPECT_TRUE(held.steps.empty());
  ASSERT_EQ(held.staying.size(), 1u);
  EXPECT_EQ(held.staying[0].component, *stack.find("box 1"));
}

TEST(PlanDisassembly, SlidesGroupsOut) {
  // Around a corner: the pin of the slot, and the hook, each with a core that fills a half of it.
  for (std::vector<Component> components : {scenes::l_slot(0.1), scenes::hook(0.1)}) {
    TriangleMesh core = assembled_mesh(components.back());
    const Vec3 corner = core.vertices.front();
    for (Vec3& p : core.vertices) p = corner + 0.5 * (p - corner);
    components.push_back(scenes::component("core", core));
    const Assembly assembly = scenes::assembly(components);
    const std::string mover = components[components.size() - 2].name;
    PlanOptions options;
    options.together = {ids(assembly, {mover, "core"})};
    options.targets = ids(assembly, {mover});
    options.fixed = ids(assembly, {components[0].name});
    const Plan plan = plan_of(assembly, options);
    EXPECT_TRUE(plan.complete()) << mover;
    ASSERT_FALSE(plan.steps.empty()) << mover;
    EXPECT_EQ(plan.steps.back().components, options.together[0]) << mover;
    const PlanScene scene = plan_scene(assembly);
    EXPECT_TRUE(audit_path(assembly, plan_path(assembly, scene.pairs, plan), {}).holds()) << mover;
  }
}

TEST(PlanDisassembly, SlidesAGroupWhereNoneOfItsPartsMoves) {
  std::vector<Component> components = scenes::l_slot(0.1);
  const Plan alone = plan_of(scenes::assembly(components));
  ASSERT_TRUE(alone.complete());
  EXPECT_EQ(alone.steps.back().tier, PlanTier::Sliding);
  components.push_back(scenes::component("core", scenes::box({2, 2, 2}, {4, 4, 4})));
  const Assembly assembly = scenes::assembly(components);
  PlanOptions options;
  options.together = {ids(assembly, {"pin", "core"})};
  const Plan plan = plan_of(assembly, options);
  ASSERT_EQ(plan.steps.size(), 1u);
  EXPECT_EQ(plan.steps[0].tier, PlanTier::Sliding);
  EXPECT_EQ(plan.steps[0].components, options.together[0]);
}

TEST(PlanDisassembly, IsTheSameInAnyOrientation) {
  std::mt19937_64 random(3);
  std::vector<Component> chain = scenes::chain_links();
  chain.push_back(scenes::component("cube", scenes::box({20, 20, -8}, {24, 24, -4})));
  for (const Assembly& assembly : {scenes::peg_in_hole(24, 0.01).assembly, scenes::dovetail(0.01).assembly,
                                   scenes::stack_in_tube(4), scenes::closed_shell(), scenes::assembly(chain)}) {
    const Plan plan = plan_of(assembly);
    for (int round = 0; round < 3; ++round) {
      const Pose pose = scenes::random_pose(random, 50, 3);
      const Plan turned = plan_of(scenes::placed(assembly, pose));
      EXPECT_EQ(taken_out(plan), taken_out(turned)) << assembly.components[0].name << ' ' << round;
      EXPECT_EQ(plan.complete(), turned.complete());
    }
  }
}

TEST(PlanDisassembly, IsTheSameHoweverSurfacesAreCut) {
  std::mt19937_64 random(6);
  for (const Assembly& assembly : {scenes::dovetail(0.01).assembly, scenes::peg_in_hole(24, 0.01).assembly}) {
    const Plan plan = plan_of(assembly);
    for (int round = 0; round < 8; ++round)
      EXPECT_EQ(taken_out(plan), taken_out(plan_of(scenes::refined(assembly, random)))) << round;
  }
}

TEST(PlanDisassembly, TakesNothingOutOfWhatIsLocked) {
  const Plan shell = plan_of(scenes::closed_shell());
  EXPECT_TRUE(shell.steps.empty());
  ASSERT_EQ(shell.staying.size(), 1u);
  EXPECT_EQ(shell.staying[0].blockers.size(), 1u);
  EXPECT_FALSE(shell.complete());
  const Plan chain = plan_of(scenes::assembly(scenes::chain_links()));
  EXPECT_TRUE(chain.steps.empty());
  EXPECT_FALSE(chain.complete());
}

TEST(PlanDisassembly, GivesReasonsWhereTheyAreWanted) {
  std::vector<Component> components = scenes::chain_links();
  components.push_back(scenes::component("loose", scenes::box({100, 0, 0}, {110, 10, 10})));
  const scenes::PlanScene scene = scenes::plan_scene(scenes::assembly(std::move(components)));
  for (const bool wanted : {false, true}) {
    PlanOptions options;
    std::size_t asked = 0;
    options.wants_reasons = [&](const Plan& plan) {
      ++asked;
      EXPECT_EQ(plan.steps.size(), 1u);
      EXPECT_TRUE(plan.staying.empty());
      return wanted;
    };
    const Plan plan = plan_disassembly(scene.assembly, scene.pairs, options);
    EXPECT_EQ(asked, 1u);
    EXPECT_EQ(plan.steps.size(), 1u);
    ASSERT_EQ(plan.staying.size(), 1u);
    EXPECT_EQ(plan.staying[0].blockers.empty(), !wanted);
    EXPECT_FALSE(plan.complete());
  }
}

TEST(PlanDisassembly, TakesOutTogetherWhatIsLocked) {
  std::vector<Component> components = scenes::chain_links();
  components.push_back(scenes::component("plate", scenes::box({-40, -40, -20}, {40, 40, -8})));
  const Plan plan = plan_of(scenes::assembly(std::move(components)));
  ASSERT_EQ(plan.steps.size(), 1u);
  EXPECT_EQ(plan.steps[0].tier, PlanTier::StraightTogether);
  EXPECT_EQ(plan.steps[0].components, (std::vector{ComponentId(0), ComponentId(1)}));
  ASSERT_EQ(plan.staying.size(), 1u) << "one of the links stays in the other";
}

TEST(PlanDisassembly, TakesApartWhatCameOutAsOne) {
  const Plan plan = plan_of(scenes::framed_dovetail());
  EXPECT_TRUE(plan.complete());
  ASSERT_EQ(plan.steps.size(), 2u);
  EXPECT_EQ(plan.steps[0].tier, PlanTier::StraightTogether);
  EXPECT_NEAR(std::abs(plan.steps[0].exit.y), 1, 1e-9);
  EXPECT_EQ(plan.steps[1].part_of, 0u);
  EXPECT_NEAR(std::abs(plan.steps[1].exit.z), 1, 1e-9);
}

TEST(PlanDisassembly, TakesTheAssemblyApartBeforeWhatCameOutAsOne) {
  std::vector<Component> components = scenes::framed_dovetail(20).components;
  components.push_back(scenes::component("back", scenes::box({-25, 20, -10}, {25, 22, 40})));
  components.push_back(scenes::component("hidden", scenes::box({-15, 10, 0}, {15, 18, 30})));
  PlanOptions options;
  const Assembly assembly = scenes::assembly(std::move(components));
  options.fixed = {*assembly.find("frame"), *assembly.find("back")};
  const Plan plan = plan_of(assembly, options);
  EXPECT_TRUE(plan.complete());
  ASSERT_EQ(plan.steps.size(), 3u);
  EXPECT_EQ(plan.steps[0].tier, PlanTier::StraightTogether);
  EXPECT_EQ(plan.steps[1].components, (std::vector{*assembly.find("hidden")}));
  EXPECT_EQ(plan.steps[1].part_of, PlanStep::kWhole);
  EXPECT_EQ(plan.steps[2].part_of, 0u);
  const PlanScene scene = plan_scene(assembly);
  EXPECT_TRUE(audit_path(assembly, plan_path(assembly, scene.pairs, plan), {}).holds());
}

TEST(PlanDisassembly, TakesTheFewestOutForATarget) {
  const int count = 7;
  const Assembly stack = scenes::stack_in_tube(count);
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(count); ++k) {
    PlanOptions options;
    options.targets = {ComponentId(1 + k)};
    options.fixed = {ComponentId(0)};
    const Plan plan = plan_of(stack, options);
    EXPECT_TRUE(plan.complete());
    const std::size_t optimum = 1 + std::min<std::size_t>(k, count - 1 - k);
    EXPECT_EQ(plan.steps.size(), optimum) << k;
    EXPECT_TRUE(taken_out(plan).count(1 + k) == 1);
  }
}

TEST(PlanDisassembly, LeavesFixedComponents) {
  PlanOptions options;
  options.fixed = {ComponentId(1)};
  const Plan plan = plan_of(scenes::peg_in_hole(24, 0.01).assembly, options);
  ASSERT_EQ(plan.steps.size(), 1u);
  EXPECT_EQ(plan.steps[0].components[0], ComponentId(0));
}

TEST(PlanDisassembly, ReturnsThePartialPlanWhenCancelled) {
  PlanOptions options;
  options.progress = [](std::string_view, double done) { return done < 0.4; };
  const Plan plan = plan_of(scenes::stack_in_tube(8), options);
  EXPECT_TRUE(plan.out_of_time);
  EXPECT_FALSE(plan.complete());
  EXPECT_GE(plan.steps.size(), 3u);
  EXPECT_LT(plan.steps.size(), 8u);
}

TEST(PlanDisassembly, GivesTheSameForAnyNumberOfThreads) {
  const PlanScene scene = plan_scene(scenes::stack_in_tube(6));
  PlanOptions serial, threads;
  threads.engine.executor = Executor(ExecutorKind::Threads, 2);
  const Plan a = plan_disassembly(scene.assembly, scene.pairs, serial);
  const Plan b = plan_disassembly(scene.assembly, scene.pairs, threads);
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t k = 0; k < a.steps.size(); ++k) {
    EXPECT_EQ(a.steps[k].components, b.steps[k].components);
    EXPECT_EQ(a.steps[k].exit, b.steps[k].exit);
  }
}

TEST(PlanDisassembly, TakesProductsOfManyEqualPartsApart) {
  const scenes::PlanScene scene = scenes::plan_scene(scenes::stations(22));
  PlanOptions options;
  options.fixed = {ComponentId(0)};
  const Plan plan = plan_disassembly(scene.assembly, scene.pairs, options);
  EXPECT_EQ(plan.steps.size(), scene.assembly.components.size() - 1);
  EXPECT_TRUE(plan.staying.empty());
  ASSERT_FALSE(plan.steps.empty());
  EXPECT_EQ(plan.steps[0].components, std::vector{ComponentId(1)}) << "the cover is on all others";
  EXPECT_TRUE(audit_path(scene.assembly, plan_path(scene.assembly, scene.pairs, plan)).holds());
}

/// Each step of a motion may bound little of a depth, and the next goes on.
TEST(PlanDisassembly, TakesAPartOutInStepsThatEndBeforeTheDepthIsBounded) {
  const TriangleMesh rod = scenes::tube(1, 0, -10, 10, 48, 4);
  const Assembly rods = scenes::assembly(
      {scenes::component("rod", rod),
       scenes::component("across", scenes::moved(rod, {{0.2, 0, 0}, quat_about({1, 0, 0}, kTurn / 4)}))});
  const scenes::PlanScene scene = scenes::plan_scene(rods, 0.01);
  PlanOptions options;
  options.slide_effort = options.sample_effort = 0;
  options.engine.depth_tests = 300;
  EXPECT_TRUE(plan_disassembly(scene.assembly, scene.pairs, options).complete());
}

}  // namespace
}  // namespace dismantle
