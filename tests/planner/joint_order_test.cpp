// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/precedence_graph.h"
#include "dismantle/planner/step_preference.h"
#include "tests/planner/planned.h"
#include "tests/support/joint_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

using scenes::Names;
using scenes::Planned;

PlanOptions with(FastenerOrder order) {
  PlanOptions options;
  options.fasteners = order;
  return options;
}

TEST(JointOrder, TakesTheScrewsThenTheCoverThenWhatIsInside) {
  const Planned planned(scenes::covered_case());
  EXPECT_TRUE(planned.plan.complete());
  ASSERT_EQ(planned.plan.steps.size(), 6u);
  EXPECT_EQ(planned.steps()[4], "cover");
  EXPECT_EQ(planned.steps()[5], "chip") << "the slot lets it out at any time";
  EXPECT_EQ(planned.torn(), 0u);
  for (std::size_t k = 0; k < 4; ++k) {
    ASSERT_TRUE(planned.plan.steps[k].unscrewing) << k;
    EXPECT_NEAR(planned.plan.steps[k].unscrewing->turns, 15, 1);
  }
  EXPECT_FALSE(planned.plan.steps[4].unscrewing);
}

TEST(JointOrder, MarksWhatComesOutOfAClosedCase) {
  for (const bool is_closed : {false, true}) {
    PlanOptions options;
    options.fixed = {ComponentId(0)};
    if (is_closed) options.fixed.push_back(ComponentId(1));
    const Planned planned(scenes::covered_case(), options);
    ASSERT_LT(planned.place("chip"), planned.plan.steps.size());
    for (std::size_t k = 0; k < planned.plan.steps.size(); ++k)
      EXPECT_EQ(planned.plan.steps[k].is_enclosed, is_closed && k == planned.place("chip")) << planned.steps()[k];
  }
}

TEST(JointOrder, OpensCasesWhereFastenersAreIgnored) {
  const Planned planned(scenes::covered_case(), with(FastenerOrder::Ignored));
  EXPECT_TRUE(planned.plan.complete());
  EXPECT_EQ(planned.place("chip"), planned.place("cover") + 1);
  EXPECT_TRUE(planned.plan.joints.empty());
  for (const PlanStep& step : planned.plan.steps) EXPECT_FALSE(step.unscrewing);
}

TEST(JointOrder, HoldsWithPreferencesToo) {
  PlanOptions options;
  options.preferences = {StepPreference::Upright};
  const Planned planned(scenes::covered_case(), options);
  EXPECT_TRUE(planned.plan.complete());
  EXPECT_EQ(planned.torn(), 0u);
  EXPECT_GT(planned.place("cover"), 3u);
}

TEST(JointOrder, TakesAStackInARowWithItsWashers) {
  const Planned planned(scenes::bolted_plates());
  EXPECT_TRUE(planned.plan.complete());
  EXPECT_EQ(planned.steps(), (Names{"nut+washer#2", "bolt+washer", "upper"}));
  EXPECT_TRUE(planned.plan.steps[0].unscrewing);
  EXPECT_FALSE(planned.plan.steps[1].unscrewing) << "the bolt is in no thread without its nut";
  EXPECT_EQ(planned.torn(), 0u);
}

TEST(JointOrder, TakesALockNutOffWithItsInsertFirst) {
  const Planned planned(scenes::bolted_plates_with_lock_nut());
  EXPECT_TRUE(planned.plan.complete());
  EXPECT_EQ(planned.steps(), (Names{"nut+ring+washer#2", "bolt+washer", "upper"}));
  EXPECT_TRUE(planned.plan.steps[0].unscrewing);
  EXPECT_EQ(planned.torn(), 0u);
}

TEST(JointOrder, UnscrewsAllThatAPlateHangsFromBeforeThePlate) {
  const Planned planned(scenes::hanging_plate());
  EXPECT_TRUE(planned.plan.complete());
  ASSERT_EQ(planned.plan.steps.size(), 7u);
  EXPECT_EQ(planned.steps().back(), "plate");
  for (std::size_t k = 0; k < 6; ++k) EXPECT_TRUE(planned.plan.steps[k].unscrewing);
}

TEST(JointOrder, RemovesTheFastenersOfATargetFirst) {
  PlanOptions options;
  options.targets = {ComponentId(1)};
  const Planned planned(scenes::covered_case(), options);
  ASSERT_EQ(planned.plan.steps.size(), 5u);
  EXPECT_EQ(planned.steps().back(), "cover");
  EXPECT_EQ(planned.torn(), 0u);
}

TEST(JointOrder, GoesOnWhereAFastenerCannotComeOutAndSaysSo) {
  // A roof over the head: the screw cannot come out, but what it holds by its open slot slides out sideways.
  const TriangleMesh slotted =
      scenes::joined({scenes::box({2.6, -8, 0}, {30, 8, 4}), scenes::box({-4, 2.6, 0}, {2.6, 8, 4}),
                      scenes::box({-4, -8, 0}, {2.6, -2.6, 4})});
  Assembly a = scenes::assembly({scenes::component("base", scenes::bored(scenes::square(20), scenes::kTapped, -20, 0)),
                                 scenes::component("slide", slotted), scenes::component("screw", scenes::m5_screw(16)),
                                 scenes::component("roof", scenes::box({-5, -5, 9.1}, {5, 5, 30}))});
  a.components[2].assembly_from_mesh.translation = {0, 0, 4};
  PlanOptions options;
  options.fixed = {ComponentId(0), ComponentId(3)};
  const Planned planned(a, options);
  ASSERT_FALSE(planned.plan.steps.empty());
  EXPECT_EQ(planned.steps()[0], "slide");
  EXPECT_EQ(planned.plan.steps[0].still_held_by, std::vector<ComponentId>{ComponentId(2)});
}

TEST(JointOrder, IsInThePrecedenceGraph) {
  const Planned planned(scenes::covered_case());
  const PrecedenceGraph graph =
      precedence_graph(planned.scene.assembly, planned.scene.pairs, planned.plan, {}, [] { return true; });
  const std::vector<std::uint32_t>& before = graph.before[planned.place("cover")];
  EXPECT_EQ(before, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(graph.ranks[0], 0u);
}

}  // namespace
}  // namespace dismantle
