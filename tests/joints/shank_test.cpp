// SPDX-License-Identifier: Apache-2.0
#include "dismantle/joints/shank.h"

#include "tests/support/joint_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Fastener m5(Fastener::Kind kind, const Vec3& axis) {
  Fastener f;
  f.kind = kind;
  f.diameter = 5;
  f.axis = axis;
  return f;
}

TEST(Shank, EndsBelowTheHead) {
  const auto shank = shank_of(scenes::component("screw", scenes::m5_screw(16)), m5(Fastener::Kind::Screw, {0, 0, 1}));
  ASSERT_TRUE(shank);
  EXPECT_TRUE(shank->has_head);
  EXPECT_NEAR(shank->head_radius, 4.25, 0.05);
  EXPECT_NEAR(shank->from_tip(shank->end - 1), 16, 1.01 * shank->step);
}

TEST(Shank, IsAllOfASetScrew) {
  const TriangleMesh rod = scenes::turned({{0, scenes::circle(2.5)}, {12, scenes::circle(2.5)}});
  const auto shank = shank_of(scenes::component("rod", rod), m5(Fastener::Kind::Screw, {0, 0, 1}));
  ASSERT_TRUE(shank);
  EXPECT_FALSE(shank->has_head);
  EXPECT_EQ(shank->end, shank->positions.size());
}

TEST(Shank, IsTheStudOfAStandoff) {
  const TriangleMesh standoff = scenes::turned(
      {{0, scenes::hexagon(8)}, {10, scenes::hexagon(8)}, {10, scenes::circle(2.5)}, {16, scenes::circle(2.5)}});
  const auto shank = shank_of(scenes::component("standoff", standoff), m5(Fastener::Kind::Standoff, {0, 0, 1}));
  ASSERT_TRUE(shank);
  EXPECT_NEAR(shank->frame.direction.z, -1, 1e-12) << "from the tip of the stud to the body";
  EXPECT_NEAR(shank->from_tip(shank->end - 1), 6, 1.01 * shank->step);
  const TriangleMesh spacer = scenes::bored(scenes::hexagon(8), 2.5, 0, 10);
  EXPECT_FALSE(shank_of(scenes::component("spacer", spacer), m5(Fastener::Kind::Standoff, {0, 0, 1})));
}

TEST(Shank, IsTurnedOverWhereOnlyANameTellsTheAxis) {
  Fastener f = m5(Fastener::Kind::Screw, {0, 0, -1});
  f.by_name_only = true;
  const auto shank = shank_of(scenes::component("screw", scenes::m5_screw(10)), f);
  ASSERT_TRUE(shank);
  EXPECT_NEAR(shank->frame.direction.z, 1, 1e-12);
}

}  // namespace
}  // namespace dismantle
