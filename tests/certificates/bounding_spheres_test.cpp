// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/sweep/bounding_spheres.h"

#include "dismantle/math/screw.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dismantle {
namespace {

constexpr std::uint64_t kSeed = 87;

double power(std::mt19937_64& random, double low, double high) {
  return std::pow(10, std::uniform_real_distribution<double>(low, high)(random));
}

/// The distance of the two spheres at many times of the screw, beyond what its chord is off.
TEST(BoundingSpheres, GapsAreNoMoreThanTheDistanceAtAnyTimeAndHardlyLess) {
  constexpr int kPlaces = 400;
  std::mt19937_64 random(kSeed);
  int on_the_way = 0;
  for (int i = 0; i < 2000; ++i) {
    BoundingSpheres spheres;
    for (int c = 0; c < 2; ++c) spheres.add(scenes::random_vector(random, 20), power(random, -1, 0.5));
    const Pose start = scenes::random_pose(random, 20, 3), fixed = scenes::random_pose(random, 20, 3);
    const Pose end = i % 2 == 0 ? Pose{start.position + scenes::random_vector(random, 30), start.rotation}
                                : start * scenes::random_pose(random, 10, 0.5);
    const BoundingSphere at_start = spheres.at(ComponentId(0), start), other = spheres.at(ComponentId(1), fixed);
    const ScrewMotion motion = screw_motion(start, end, at_start.center, at_start.radius);
    double minimum = 1e300;
    int nearest = 0;
    for (int k = 0; k <= kPlaces; ++k) {
      const Pose now = motion.at(k / static_cast<double>(kPlaces));
      const double distance =
          length(spheres.at(ComponentId(0), now).center - other.center) - at_start.radius - other.radius;
      if (distance < minimum) minimum = distance, nearest = k;
    }
    on_the_way += nearest > 0 && nearest < kPlaces ? 1 : 0;
    const double gap = spheres.gap(ComponentId(0), transform_from_pose(start), transform_from_pose(end),
                                   motion.deviation, ComponentId(1), fixed);
    EXPECT_LE(gap, minimum) << "seed " << kSeed << ", case " << i;
    EXPECT_GE(gap, minimum - 2 * motion.deviation - motion.path_length / kPlaces - 1e-5) << "case " << i;
  }
  EXPECT_GT(on_the_way, 500);
}

/// Spheres inside another one, those that touch it where the moving one comes nearest included.
TEST(BoundingSpheres, GapsToASphereAreNoMoreThanThoseToAnyInsideIt) {
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const SweptSphere moving{scenes::random_vector(random, power(random, -2, 2)),
                             scenes::random_vector(random, power(random, -2, 2)), power(random, -3, 1), 0};
    const BoundingSphere around{scenes::random_vector(random, power(random, -3, 2)), power(random, -2, 3)};
    const double whole = moving.gap_to_any(around);
    for (int k = 0; k < 6; ++k) {
      const double radius = around.radius * power(random, -4, 0), part = k / 5.0;
      const Vec3 off =
          k % 2 == 0 ? scenes::random_vector(random, 1) : moving.from + part * moving.displacement - around.center;
      const BoundingSphere inside{around.center + (around.radius - radius) * normalized(off), radius};
      EXPECT_LE(whole, moving.gap(inside)) << "seed " << kSeed << ", case " << i;
    }
  }
}

}  // namespace
}  // namespace dismantle
