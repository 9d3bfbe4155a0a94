// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/motion/relative_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dismantle::audit {
namespace {

Pose random_pose(std::mt19937_64& random, double reach) {
  std::normal_distribution<double> normal;
  return {reach * Vec3{normal(random), normal(random), normal(random)},
          normalized(Quat{normal(random), normal(random), normal(random), normal(random)})};
}

TEST(RelativeMotion, IsTheWorldScrewInTheFrameOfTheOtherBody) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    const Pose a = random_pose(random, 10), start = random_pose(random, 10), end = random_pose(random, 10);
    const RelativeMotion motion =
        relative_motion(transform_from_pose(a), transform_from_pose(start), screw_between(start, end));
    const RelativeMotion reversed = reversed_roles(motion);
    const Vec3 point{1, -2, 3};
    for (const double s : {0.0, 0.3, 0.7, 1.0}) {
      const Vec3 world = transform_from_pose(pose_between(start, end, s)) * point;
      const Vec3 seen_from_a = inverse(transform_from_pose(a)) * world;
      EXPECT_LT(length(motion.at(s) * point - seen_from_a), 1e-11);
      EXPECT_LT(length(reversed.at(s) * seen_from_a - point), 1e-11);
    }
  }
}

TEST(RelativeMotion, GivesVelocityAndAccelerationOfPoints) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 200; ++i) {
    const Pose start = random_pose(random, 10), end = random_pose(random, 10);
    const RelativeMotion motion = relative_motion({}, transform_from_pose(start), screw_between(start, end));
    const Vec3 point{1, -2, 3};
    const double h = 1e-4, s = 0.4;
    const Vec3 before = motion.at(s - h) * point, now = motion.at(s) * point, after = motion.at(s + h) * point;
    const Vec3 velocity = motion.velocity(now);
    EXPECT_LT(length((after - before) / (2 * h) - velocity), 1e-4);
    EXPECT_NEAR(length((after - 2.0 * now + before) / (h * h)), motion.acceleration(velocity), 1e-3);
  }
}

TEST(RelativeMotion, OfABodyAtRestIsZero) {
  EXPECT_TRUE(relative_motion({}, {}, screw_between({}, {})).still());
  EXPECT_FALSE(relative_motion({}, {}, screw_between({}, {{1, 0, 0}, {}})).still());
}

}  // namespace
}  // namespace dismantle::audit
