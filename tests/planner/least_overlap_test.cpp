// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"
#include "dismantle/planner/explanation.h"
#include "dismantle/planner/plan_allowing_overlaps.h"
#include "dismantle/planner/plan_path.h"
#include "tests/planner/plan_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

constexpr double kTolerance = 0.01, kBottom = 0.05, kTop = 0.08;
/// The pin's corners get deepest in the lip.
const double kDepth = std::sqrt(2) * kBottom;

/// A pin that fills a square bore between two lips, which are kBottom and kTop wide.
Assembly pin_between_lips() {
  const std::vector<double> lines = {-4, -2, kBottom - 2, kTop - 2, 2 - kTop, 2 - kBottom, 2, 4};
  const TriangleMesh bore = scenes::box_block({{lines, lines, {0, 1, 9, 10}}}, [](int x, int y, int z) {
    const int from_wall = std::min({x, y, 6 - x, 6 - y});
    return from_wall == 0 || (z == 0 && from_wall <= 1) || (z == 2 && from_wall <= 2);
  });
  return scenes::assembly(
      {scenes::component("bore", bore), scenes::component("pin", scenes::box({-2, -2, 1}, {2, 2, 9}))});
}

PlanOptions up_to(double overlap) {
  PlanOptions options;
  options.slide_effort = scenes::kSlideEffort;
  options.sample_effort = 0;
  options.overlap_limit = overlap;
  return options;
}

TEST(LeastOverlap, IsThatOfTheNarrowerLip) {
  const scenes::PlanScene scene = scenes::plan_scene(pin_between_lips(), kTolerance);
  const Plan plan = plan_disassembly(scene.assembly, scene.pairs, up_to(1));
  ASSERT_EQ(plan.staying.size(), 1u);
  const std::optional<LeastOverlap>& found = plan.staying[0].overlap;
  ASSERT_TRUE(found);
  EXPECT_LT(length(found->direction - Vec3{0, 0, -1}), 1e-9);
  ASSERT_EQ(found->pairs.size(), 1u);
  const NeededOverlap& pair = found->pairs[0];
  EXPECT_GE(pair.depth, kDepth - 1e-9);
  EXPECT_LE(pair.depth, 1.1 * kDepth + 0.5 * kTolerance);
  EXPECT_NEAR(pair.more, pair.depth - kTolerance, 1e-12);
  EXPECT_EQ(found->more, pair.more);
  EXPECT_NEAR(pair.at.z, 1, 0.1);
  const std::string text = explanation_text(scene.assembly, plan.staying[0]);
  EXPECT_NE(text.find("; comes out along -Z if 0.06"), std::string::npos) << text;
}

TEST(LeastOverlap, IsNoMoreThanWasAskedFor) {
  const scenes::PlanScene scene = scenes::plan_scene(pin_between_lips(), kTolerance);
  const Plan little = plan_disassembly(scene.assembly, scene.pairs, up_to(0.9 * (kDepth - kTolerance)));
  ASSERT_EQ(little.staying.size(), 1u);
  EXPECT_FALSE(little.staying[0].overlap);
  EXPECT_FALSE(plan_disassembly(scene.assembly, scene.pairs, up_to(0)).staying[0].overlap);
}

TEST(LeastOverlap, IsNothingWhereWhatBlocksIsApart) {
  Assembly apart = pin_between_lips();
  apart.components[1] = scenes::component("pin", scenes::box({-1.98, -1.98, 2}, {1.98, 1.98, 8}));
  const scenes::PlanScene scene = scenes::plan_scene(apart, kTolerance);
  const Plan plan = plan_disassembly(scene.assembly, scene.pairs, up_to(1));
  ASSERT_EQ(plan.staying.size(), 1u);
  EXPECT_FALSE(plan.staying[0].overlap);
}

TEST(PlanAllowingOverlaps, DeclaresWhatIsNeededAndHoldsTheAudit) {
  const scenes::PlanScene scene = scenes::plan_scene(pin_between_lips(), kTolerance);
  const AllowingPlan found = plan_allowing_overlaps(scene.assembly, scene.pairs, up_to(0.08));
  EXPECT_TRUE(found.plan.complete());
  ASSERT_EQ(found.pairs.pairs.size(), 1u);
  const double declared = found.pairs.pairs[0].declared;
  EXPECT_GE(declared, kDepth - 1e-9);
  EXPECT_LE(declared, 1.1 * kDepth + 0.5 * kTolerance);
  const Path path = plan_path(scene.assembly, found.pairs, found.plan);
  ASSERT_EQ(path.pairs.size(), 1u);
  EXPECT_EQ(path.pairs[0].allowed_depth, declared);
  EXPECT_TRUE(audit_path(scene.assembly, path, {}).holds());
  Path undeclared = path;
  undeclared.pairs.clear();
  EXPECT_FALSE(audit_path(scene.assembly, undeclared, {}).holds());
}

TEST(PlanAllowingOverlaps, IsThePlainPlanWhereNothingHelps) {
  const scenes::PlanScene scene = scenes::plan_scene(pin_between_lips(), kTolerance);
  const AllowingPlan found = plan_allowing_overlaps(scene.assembly, scene.pairs, up_to(0.02));
  EXPECT_FALSE(found.plan.complete());
  EXPECT_EQ(found.pairs.pairs, scene.pairs.pairs);
}

}  // namespace
}  // namespace dismantle
