// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/motion/profile_tree.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace dismantle::audit {
namespace {

constexpr std::uint64_t kSeed = 84;

/// The coordinate of a point along direction k, up to whole turns.
double along(const ProfileFrame& frame, int k, Vec3 p) {
  return frame.of_r[k] * std::hypot(p.x, p.y) + frame.of_u[k] * (p.z - frame.pitch * std::atan2(p.y, p.x));
}

TEST(ProfileFrame, BoundsTheDifferenceOfPointsThatAreNearEachOther) {
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto power = [&](double low, double high) { return std::pow(10, low + (high - low) * uniform(random)); };
  double closest = 0;
  int tested = 0;
  for (int i = 0; i < 40000; ++i) {
    std::array<double, ProfileFrame::kDirections - 1> angles;
    for (double& angle : angles) angle = std::numbers::pi * uniform(random);
    const double pitch = i % 8 == 0 ? 0 : (i % 2 == 0 ? 1 : -1) * power(-1, 1);
    const ProfileFrame frame(pitch, angles);
    const double radius = power(-2, 1), distance = radius * power(-3, 0.5), r = radius * (1 + power(-6, 0));
    const double theta = 7 * uniform(random);
    const Vec3 out{std::cos(theta), std::sin(theta), 0}, around{-std::sin(theta), std::cos(theta), 0}, up{0, 0, 1};
    const Vec3 p = r * out + normal(random) * up;
    for (int k = 0; k < ProfileFrame::kDirections; ++k) {
      // Half of the points are where the coordinate differs most.
      const Vec3 steepest = frame.of_r[k] * out + frame.of_u[k] * (up - pitch / r * around);
      const Vec3 any{normal(random), normal(random), normal(random)};
      const Vec3 q = p + distance * normalized(uniform(random) < 0.5 ? steepest : any);
      if (std::hypot(q.x, q.y) < radius) continue;
      ++tested;
      const double apart = along(frame, k, q) - along(frame, k, p), turn = frame.circumference[k];
      const double difference = std::fabs(turn > 0 ? std::remainder(apart, turn) : apart);
      const double bound = frame.max_difference(k, distance, radius);
      EXPECT_LE(difference, bound * (1 + 1e-9) + 1e-12) << "seed " << kSeed << ", direction " << k << ", case " << i;
      closest = std::max(closest, difference / bound);
    }
  }
  EXPECT_GT(tested, 100000);
  EXPECT_GT(closest, 0.95);
}

}  // namespace
}  // namespace dismantle::audit
