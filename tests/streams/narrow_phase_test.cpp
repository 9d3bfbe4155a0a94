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

TEST(OverlapByLess, HoldsForASmallerOverlapAlongAnyAxis) {
  const Kdop16 a = kdop_of(scenes::box({0, 0, 0}, {1, 1, 1}));
  const Kdop16 b = kdop_of(scenes::box({0.99, 0.2, 0.2}, {2, 0.8, 0.8}));
  EXPECT_TRUE(overlap_by_less(a, b, 0.011));
  EXPECT_FALSE(overlap_by_less(a, b, 0.009));
  EXPECT_TRUE(overlap_by_less(b, a, 0.011));
  EXPECT_FALSE(overlap_by_less(b, a, 0.009));
}

TEST(OverlapByLess, HoldsAlongDiagonalsByTheirTrueLength) {
  TriangleMesh first, second;  // they overlap along (1, 1, 0) by 0.01, along all other axes by 1 and more
  first.vertices = {{0, 0, 1}, {0, 0, -1}, {-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
  second.vertices = {{-0.00707, -0.00707, 1}, {-0.00707, -0.00707, -1}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}};
  EXPECT_TRUE(overlap_by_less(kdop_of(first), kdop_of(second), 0.0103));
  EXPECT_FALSE(overlap_by_less(kdop_of(first), kdop_of(second), 0.0097));
}

TEST(OverlapByLess, CountsTouchingAsAnOverlap) {
  const Kdop16 a = kdop_of(scenes::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(overlap_by_less(a, kdop_of(scenes::box({1, 0, 0}, {2, 1, 1})), 0));
}

/// A triangle at rest, and one above it that moves along z, with ghosts that are displaced by `displaced` into them.
CcdResult swept(double from, double to, double displaced) {
  const auto at = [](double z) { return Triangle{{{0, 0, z}, {1, 0, z}, {0, 1, z}}}; };
  const GhostMotion below{{at(0), at(0)}, {at(-displaced), at(-displaced)}};
  const GhostMotion above{{at(from), at(to)}, {at(from + displaced), at(to + displaced)}};
  return ccd_with_ghosts(above, below);
}

TEST(CcdWithGhosts, StopsWhereTheFirstGhostMeetsATriangle) {
  EXPECT_EQ(swept(1, -0.4, 0.5).status, CcdStatus::Free);
  EXPECT_EQ(swept(1, -0.6, 0.5).status, CcdStatus::Contact);
  EXPECT_LE(swept(1, -1, 0.5).toi, 0.75);
  EXPECT_NEAR(swept(1, -1, 0.5).toi, 0.75, 1e-4);
  EXPECT_NEAR(swept(1, -1, 0).toi, 0.5, 1e-4);
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
