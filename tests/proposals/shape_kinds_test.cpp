// SPDX-License-Identifier: Apache-2.0
#include "dismantle/proposals/shape_kinds.h"

#include "tests/proposals/ring_scenes.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

TEST(RingShape, IsFoundInAnyPose) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20; ++i) {
    const Pose pose = scenes::random_pose(random, 50, 3);
    const RigidTransform at = transform_from_pose(pose);
    const auto ring = ring_shape(scenes::moved(scenes::o_ring(20, 3, 4), pose));
    ASSERT_TRUE(ring);
    EXPECT_TRUE(ring->is_torus);
    EXPECT_NEAR(ring->outer, 21.5, 0.05);
    EXPECT_NEAR(ring->inner, 18.5, 0.05);
    EXPECT_NEAR(std::abs(dot(ring->axis, at.rotation * Vec3{0, 0, 1})), 1, 1e-4);
    EXPECT_LT(length(ring->center - at * Vec3{0, 0, 4}), 0.1);
  }
}

TEST(RingShape, TellsTheGapOfAnOpenRing) {
  const auto ring = ring_shape(scenes::open_ring(9, 11, 1, 0.8));
  ASSERT_TRUE(ring);
  EXPECT_FALSE(ring->is_torus);
  EXPECT_NEAR(ring->gap, 0.8, 0.2);
  EXPECT_NEAR(ring->height, 1, 1e-3);
}

TEST(RingShape, IsNoneOfPlatesFramesAndShafts) {
  EXPECT_FALSE(ring_shape(scenes::box({0, 0, 0}, {30, 20, 1})));
  EXPECT_FALSE(ring_shape(scenes::revolved({{0, 0}, {10, 0}, {10, 1}, {0, 1}}, 48)));
  EXPECT_FALSE(ring_shape(scenes::tube(10, 2, 0, 1, 48)));
  // A square frame with a vertex every millimetre.
  scenes::Profile outer = scenes::subdivided({{-20, -20}, {20, -20}, {20, 20}, {-20, 20}}, 1, true), inner = outer;
  for (scenes::ProfilePoint& p : inner) p.x *= 0.7, p.y *= 0.7;
  EXPECT_FALSE(ring_shape(scenes::extruded_band(outer, inner, true, 0, 1)));
  EXPECT_FALSE(ring_shape({}));
}

TEST(BallShape, IsNoCylinderWhoseRimsAreOnABall) {
  const auto found = ball_shape(scenes::ball(4, {1, 2, 3}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->radius, 4, 0.1);
  EXPECT_LT(length(found->center - Vec3{1, 2, 3}), 1e-6);
  EXPECT_FALSE(ball_shape(scenes::tube(4, 0, -3, 3, 24)));
  EXPECT_FALSE(ball_shape(scenes::box({0, 0, 0}, {1, 1, 1})));
}

TEST(SectionOf, IsTheDiameterOfAWire) {
  EXPECT_NEAR(section_of(scenes::o_ring(30, 2, 0)), 2, 0.08);
  EXPECT_NEAR(section_of(scenes::tube(1, 0, 0, 100, 48)), 2, 0.05);
  EXPECT_EQ(section_of({}), 0);
}

}  // namespace
}  // namespace dismantle
