// SPDX-License-Identifier: Apache-2.0
#include "dismantle/math/screw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dismantle {
namespace {

Pose random_pose(std::mt19937_64& random, double reach) {
  std::normal_distribution<double> normal;
  return {reach * Vec3{normal(random), normal(random), normal(random)},
          normalized(Quat{normal(random), normal(random), normal(random), normal(random)})};
}

double distance(const Pose& a, const Pose& b, Vec3 point) {
  return length(transform_from_pose(a) * point - transform_from_pose(b) * point);
}

TEST(Screw, ReachesTheEndPoseFromTheStartPose) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Pose start = random_pose(random, 100), end = random_pose(random, 100);
    const Pose moved = screw_at(screw_between(start, end), 1) * start;
    EXPECT_LT(distance(moved, end, {10, -20, 30}), 1e-9);
    EXPECT_EQ(pose_between(start, end, 0), start);
    EXPECT_EQ(pose_between(start, end, 1), end);
  }
}

TEST(Screw, KeepsItsTwistWhenCutInTwo) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 1000; ++i) {
    const Pose start = random_pose(random, 100), end = random_pose(random, 100);
    const Pose middle = pose_between(start, end, 0.5);
    EXPECT_LT(distance(pose_between(start, middle, 0.5), pose_between(start, end, 0.25), {1, 2, 3}), 1e-9);
    EXPECT_LT(distance(pose_between(middle, end, 0.5), pose_between(start, end, 0.75), {1, 2, 3}), 1e-9);
  }
}

TEST(Screw, KeepsItsDigitsWhenTheRotationIsTiny) {
  const Pose start{{1, 2, 3}, {}};
  for (const double angle : {1e-3, 1e-6, 1e-9, 1e-11, 1e-13}) {
    const Pose end{{4, 6, 3}, quat_about({0, 0, 1}, angle)};
    const Pose middle = pose_between(start, end, 0.5);
    EXPECT_LT(length(middle.position - Vec3{2.5, 4, 3}), 5 * angle + 1e-14);
  }
}

TEST(Screw, TurnsByAtMostHalfATurn) {
  const Screw screw = screw_between({}, {{}, Quat{-0.9999, 0, 0, -0.014141782}});
  EXPECT_LT(screw.angle, 0.1);
  EXPECT_NEAR(screw_between({}, {{}, Quat{0, 0, 0, 1}}).angle, std::acos(-1.0), 1e-12);
}

TEST(Screw, BoundsPathLengthAndChordDeviation) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    const Pose start = random_pose(random, 10), end = random_pose(random, 10);
    const Screw screw = screw_between(start, end);
    const Vec3 point{3, -2, 5};
    const Vec3 from = transform_from_pose(start) * point, to = transform_from_pose(end) * point;
    const double rho = screw_radius(screw, from, 0);
    double travelled = 0;
    Vec3 last = from;
    for (int k = 1; k <= 100; ++k) {
      const double s = k / 100.0;
      const Vec3 now = transform_from_pose(pose_between(start, end, s)) * point;
      travelled += length(now - last);
      last = now;
      EXPECT_LE(length(now - (from + s * (to - from))), screw_chord_deviation(screw, rho) + 1e-9);
    }
    EXPECT_LE(travelled, screw_path_length(screw, rho) + 1e-9);
    EXPECT_GE(travelled, 0.999 * screw_path_length(screw, rho));
  }
}

TEST(ScrewMotion, HasThePosesAndTheBoundsOfItsScrewBitForBit) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 50; ++i) {
    const Pose start = random_pose(random, 10), end = random_pose(random, 10);
    const Vec3 center{3, -2, 5};
    const ScrewMotion motion = screw_motion(start, end, center, 2);
    const Screw screw = screw_between(start, end);
    EXPECT_EQ(motion.deviation, screw_chord_deviation(screw, screw_radius(screw, center, 2)));
    EXPECT_EQ(motion.path_length, screw_path_length(screw, screw_radius(screw, center, 2)));
    for (const double s : {-0.5, 0.0, 0.3, 0.9, 1.0, 1.5}) EXPECT_EQ(motion.at(s), pose_between(start, end, s));
  }
}

}  // namespace
}  // namespace dismantle
