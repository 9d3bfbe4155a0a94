// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/order/plan_order.h"

#include "dismantle/planner/step_preference.h"
#include "tests/planner/planned.h"
#include "tests/support/joint_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

using scenes::Names;
using scenes::Planned;

/// A block with wells that are open upwards, in each of them a flat part, "low", under a taller one, "high": the
/// smaller one comes first wherever it is free.
Assembly wells(int count) {
  std::vector<double> x{-10};
  for (int k = 0; k < count; ++k) {
    x.push_back(20.0 * k - 5);
    x.push_back(20.0 * k + 5);
  }
  x.push_back(x.back() + 5);
  const auto block = scenes::box_block({{x, {-10, -5, 5, 10}, {-5, 0, 6}}},
                                       [](int i, int j, int k) { return k == 0 || j != 1 || i % 2 == 0; });
  std::vector<Component> components{scenes::component("block", block)};
  for (int k = 0; k < count; ++k) {
    const double at = 20 * k;
    const std::string number = " " + std::to_string(k);
    components.push_back(scenes::component("low" + number, scenes::box({at - 5, -5, 0}, {at + 5, 5, 5})));
    components.push_back(scenes::component("high" + number, scenes::box({at - 5, -5, 5}, {at + 5, 5, 15})));
  }
  return scenes::assembly(std::move(components));
}

TEST(PlanOrder, TakesEqualPartsOneAfterAnother) {
  const Planned planned(wells(4));
  EXPECT_TRUE(planned.plan.complete());
  EXPECT_TRUE(planned.holds());
  std::string kinds;
  for (const std::string& name : planned.steps()) kinds += name.front();
  EXPECT_EQ(kinds, "hhhhllll");
}

TEST(PlanOrder, IsThatOfTheUser) {
  PlanOptions options;
  options.preferences = {StepPreference::Direction};
  const Planned planned(wells(4), options);
  std::string kinds;
  for (const std::string& name : planned.steps()) kinds += name.front();
  EXPECT_NE(kinds, "hhhhllll") << "all steps have one direction, so no order is better";
  EXPECT_TRUE(planned.holds());
}

TEST(PlanOrder, WeighsCriteriaByTheirPlace) {
  const OrderWeights weights = order_weights({StepPreference::Support, StepPreference::Groups}, {});
  EXPECT_EQ(weights.support, 10);
  EXPECT_EQ(weights.groups, 1);
  EXPECT_EQ(weights.direction, 0);
  EXPECT_EQ(weights.loose, 0);
  EXPECT_EQ(order_weights({}, {}).groups, OrderWeights{}.groups);
  EXPECT_EQ(order_weights({StepPreference::Tools, StepPreference::Loose}, {3, 0.5}).loose, 0.5);
}

TEST(PlanOrder, TakesWhatIsInsideAfterTheCover) {
  // "chip" is equal to "plug", which is free outside: together they would make one step fewer, but the slot that lets
  // the chip out shows nothing of it.
  Assembly assembly = scenes::covered_case();
  const Component& chip = assembly[*assembly.find("chip")];
  Component plug = chip;
  plug.name = "plug";
  plug.assembly_from_mesh.translation += Vec3{0, 0, 200};
  assembly.components.push_back(plug);
  assembly.components.back().tree_node = chip.tree_node;
  const Planned planned(assembly);
  const Names steps = planned.steps();
  const auto place = [&](const char* name) { return std::find(steps.begin(), steps.end(), name) - steps.begin(); };
  EXPECT_LT(place("cover"), place("chip"));
  EXPECT_TRUE(planned.holds());
}

TEST(PlanOrder, GivesEachBodyASectionOfItsOwn) {
  Assembly assembly = scenes::framed_dovetail();
  const Planned planned(assembly);
  ASSERT_GE(planned.plan.steps.size(), 2u);
  EXPECT_TRUE(planned.holds());
  std::uint32_t section = PlanStep::kWhole;
  for (std::uint32_t k = 0; k < planned.plan.steps.size(); ++k) {
    const std::uint32_t part_of = planned.plan.steps[k].part_of;
    EXPECT_TRUE(part_of == PlanStep::kWhole || part_of < k);
    EXPECT_TRUE(part_of == section || part_of != PlanStep::kWhole) << "the assembly's own steps come first";
    section = part_of;
  }
}

TEST(PlanOrder, IsTheSameWithAnyNumberOfThreads) {
  PlanOptions threads;
  threads.engine.executor = Executor(ExecutorKind::Threads, 3);
  for (const Assembly& assembly : {wells(5), scenes::stations(30)})
    EXPECT_EQ(Planned(assembly).steps(), Planned(assembly, threads).steps());
}

}  // namespace
}  // namespace dismantle
