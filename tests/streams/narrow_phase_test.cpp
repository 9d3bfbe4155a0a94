// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/narrow_phase.h"

#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Kdop16 kdop_of(const TriangleMesh& mesh) {
  KdopOfPoints points;
  for (const Vec3& p : mesh.vertices) points.extend(p);
  return points.rounded_outward(0);
}

TEST(WithinAllowance, HoldsForASmallerOverlapAlongAnyAxis) {
  const Kdop16 a = kdop_of(scenes::box({0, 0, 0}, {1, 1, 1}));
  const Kdop16 b = kdop_of(scenes::box({0.99, 0.2, 0.2}, {2, 0.8, 0.8}));
  EXPECT_TRUE(within_allowance(a, b, 0.011));
  EXPECT_FALSE(within_allowance(a, b, 0.009));
  EXPECT_TRUE(within_allowance(b, a, 0.011));
  EXPECT_FALSE(within_allowance(b, a, 0.009));
}

TEST(WithinAllowance, HoldsAlongDiagonalsByTheirTrueLength) {
  TriangleMesh first, second;  // they overlap along (1, 1, 0) by 0.01, along all other axes by 1 and more
  first.vertices = {{0, 0, 1}, {0, 0, -1}, {-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
  second.vertices = {{-0.00707, -0.00707, 1}, {-0.00707, -0.00707, -1}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}};
  EXPECT_TRUE(within_allowance(kdop_of(first), kdop_of(second), 0.0103));
  EXPECT_FALSE(within_allowance(kdop_of(first), kdop_of(second), 0.0097));
}

TEST(WithinAllowance, CountsTouchingAsContactWithoutAnAllowance) {
  const Kdop16 a = kdop_of(scenes::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(within_allowance(a, kdop_of(scenes::box({1, 0, 0}, {2, 1, 1})), 0));
}

TEST(AllowedOnChords, TakesOffADeviationForEachComponentThatMoves) {
  EXPECT_DOUBLE_EQ(allowed_on_chords(0.01, 0.001, 1), 0.009);
  EXPECT_DOUBLE_EQ(allowed_on_chords(0.01, 0.001, 2), 0.008);
  EXPECT_DOUBLE_EQ(allowed_on_chords(0.01, 0.02, 2), 0);
}

TEST(PartOf, IsTheMotionBetweenTwoTimes) {
  TriangleMotion whole;
  whole.t0 = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  whole.t1 = {{{4, 0, 0}, {5, 0, 8}, {4, 1, 0}}};
  EXPECT_EQ(part_of(whole, 0, 1).t0, whole.t0);
  EXPECT_EQ(part_of(whole, 0, 1).t1, whole.t1);
  const TriangleMotion part = part_of(whole, 0.25, 0.75);
  EXPECT_EQ(part.t0[1], (Vec3{2, 0, 2}));
  EXPECT_EQ(part.t1[1], (Vec3{4, 0, 6}));
}

}  // namespace
}  // namespace dismantle
