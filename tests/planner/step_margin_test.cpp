// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/step_margin.h"

#include "dismantle/planner/plan_disassembly.h"
#include "tests/planner/plan_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using scenes::plan_scene;
using scenes::PlanScene;

/// A drawer with 0.3 and 0.5 mm of room at its sides, and a post that it passes at 0.12 mm far out.
Assembly desk() {
  return scenes::assembly({scenes::component("base", scenes::box({-20, -2, -2}, {60, 30, 0})),
                           scenes::component("left", scenes::box({-20, -2, 0}, {20, -0.3, 10})),
                           scenes::component("right", scenes::box({-20, 20.5, 0}, {20, 22, 10})),
                           scenes::component("back", scenes::box({-22, -2, 0}, {-20, 22, 30})),
                           scenes::component("top", scenes::box({-22, -2, 10}, {20, 22, 12})),
                           scenes::component("post", scenes::box({40, 20.12, 0}, {40.05, 22, 10})),
                           scenes::component("drawer", scenes::box({-19, 0, 0}, {19, 20, 9}))});
}

/// Straight removals of single components of the desk: the drawer forwards, and others upwards.
Plan plan_of(const Assembly& assembly, const std::vector<std::string>& names) {
  Plan plan;
  for (const std::string& name : names) {
    PlanStep step;
    step.components = {*assembly.find(name)};
    step.exit = name == "drawer" ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    plan.steps.push_back(step);
  }
  return plan;
}

TEST(StepMargin, IsHalfTheSmallestDistanceToWhatIsStillThere) {
  const PlanScene scene = plan_scene(desk());
  const Assembly& a = scene.assembly;
  Plan drawer_first = plan_of(a, {"drawer", "post"}), post_first = plan_of(a, {"post", "drawer"});
  find_margins(a, scene.pairs, {}, {}, drawer_first);
  find_margins(a, scene.pairs, {}, {}, post_first);
  ASSERT_TRUE(drawer_first.steps[0].margin && post_first.steps[1].margin);
  EXPECT_NEAR(drawer_first.steps[0].margin->margin, 0.06, 0.01);
  EXPECT_EQ(drawer_first.steps[0].margin->nearest, *a.find("post"));
  EXPECT_NEAR(post_first.steps[1].margin->margin, 0.15, 0.01);
  EXPECT_EQ(post_first.steps[1].margin->nearest, *a.find("left"));
}

TEST(StepMargin, IsAmongTheComponentsOfTheBodyThatTheStepTakesApart) {
  const PlanScene scene = plan_scene(desk());
  const Assembly& a = scene.assembly;
  Plan plan = plan_of(a, {"top", "drawer"});
  plan.steps[0].components = {*a.find("drawer"), *a.find("left"), *a.find("top")};
  plan.steps[1].part_of = 0;
  find_margins(a, scene.pairs, {}, {}, plan);
  ASSERT_TRUE(plan.steps[1].margin);
  EXPECT_NEAR(plan.steps[1].margin->margin, 0.15, 0.01);  // the post was left behind
  EXPECT_EQ(plan.steps[1].margin->nearest, *a.find("left"));
}

TEST(StepMargin, IsABoundWhereNothingIsNear) {
  PlanScene scene = plan_scene(scenes::stack_in_tube(2));
  Plan plan = plan_disassembly(scene.assembly, scene.pairs, {});
  ASSERT_FALSE(plan.steps.empty());
  for (const PlanStep& step : plan.steps) EXPECT_FALSE(step.margin);
  find_margins(scene.assembly, scene.pairs, {}, {}, plan);
  for (const PlanStep& step : plan.steps) {  // touch all that is there
    ASSERT_TRUE(step.margin);
    EXPECT_FALSE(step.margin->nearest.valid());
    EXPECT_GT(step.margin->margin, 1);
  }
}

TEST(StepMargin, DoesNotDependOnTheThreads) {
  const PlanScene scene = plan_scene(desk());
  const std::vector<std::string> names{"post", "drawer", "top", "left", "right"};
  Plan alone = plan_of(scene.assembly, names), shared = alone;
  find_margins(scene.assembly, scene.pairs, {}, {}, alone);
  CertificateOptions options;
  options.executor = Executor(ExecutorKind::Threads, 3);
  find_margins(scene.assembly, scene.pairs, options, {}, shared);
  for (std::size_t k = 0; k < names.size(); ++k) {
    ASSERT_TRUE(alone.steps[k].margin && shared.steps[k].margin) << names[k];
    EXPECT_EQ(alone.steps[k].margin->margin, shared.steps[k].margin->margin) << names[k];
    EXPECT_EQ(alone.steps[k].margin->nearest, shared.steps[k].margin->nearest) << names[k];
  }
}

TEST(StepMargin, IsMissingAfterTheSearchWasCancelled) {
  const PlanScene scene = plan_scene(desk());
  Plan plan = plan_of(scene.assembly, {"post", "drawer"});
  const auto cancels_in_second = [](std::string_view, double share) { return share < 0.5; };
  find_margins(scene.assembly, scene.pairs, {}, cancels_in_second, plan);
  EXPECT_TRUE(plan.steps[0].margin);
  EXPECT_FALSE(plan.steps[1].margin);
}

}  // namespace
}  // namespace dismantle
