// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/put_aside.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(PutAside, StaysNearHoweverManyScrewsALaterPathHas) {
  // A lid moves up first; then a nut, in 25 turns.
  const Assembly a = scenes::assembly({scenes::component("rod", scenes::box({-2, -2, 0}, {2, 2, 100})),
                                       scenes::component("nut", scenes::box({-8, -8, 0}, {8, 8, 10})),
                                       scenes::component("lid", scenes::box({-8, -8, 100}, {8, 8, 104}))});
  PlanStep nut{{ComponentId(1)}, PlanTier::Helical, PlanStep::kWhole, {}, {0, 0, 1}};
  for (int i = 1; i <= 600; ++i) nut.poses.push_back({{0, 0, i / 6.0}, quat_about({0, 0, 1}, 0.26 * i)});
  Plan plan;
  plan.steps = {{{ComponentId(2)}, PlanTier::Straight, PlanStep::kWhole, {}, {0, 0, 1}}, nut};
  const std::vector<double> distances = put_aside(a, plan);
  ASSERT_EQ(distances.size(), 2u);
  EXPECT_GT(distances[0], 10) << "the nut leaves through the place of the lid";
  EXPECT_LT(distances[0], 3 * diagonal(assembled_bounds(a)));
  EXPECT_LT(distances[1], diagonal(assembled_bounds(a)));
}

}  // namespace
}  // namespace dismantle
