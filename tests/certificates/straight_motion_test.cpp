// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/straight_motion.h"

#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "tests/support/random_scenes.h"
#include "tests/support/solid_scene.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using scenes::Solid;

/// The minimum distance of all triangles at some positions of the motion.
double brute_distance(const StraightMover& moving, const SolidTree& fixed) {
  constexpr int kPlaces = 16;
  double minimum = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kPlaces; ++k)
    for (std::uint32_t a = 0; a < moving.solid.faces.size(); ++a) {
      Triangle moved = moving.solid.triangle(a);
      for (Vec3& p : moved.corner) p = moving.at * p + k / static_cast<double>(kPlaces) * moving.displacement;
      for (std::uint32_t b = 0; b < fixed.faces.size(); ++b)
        minimum = std::min(minimum, distance_triangle_triangle(moved, fixed.triangle(b)).distance);
    }
  return minimum;
}

TEST(StraightMotion, IsNeverFreeIfItMeets) {
  std::mt19937_64 random(5);
  int free = 0, unsettled = 0;
  for (const double offset : {1.0, 1e4})
    for (int i = 0; i < 100; ++i) {
      const Pose pose = scenes::random_pose(random, offset, 3);
      const Solid fixed(scenes::moved(scenes::tube(3, 1, -2, 2, 9, 1), pose));
      const Vec3 at = assembled_bounds(fixed.assembly.components[0]).center();
      // Assembled elsewhere, but moved near.
      const Pose own = scenes::random_pose(random, offset, 3);
      const Solid solid(scenes::moved(scenes::tube(0.8, 0.3, -1, 1, 7, 1), own));
      const Pose near{at + scenes::random_vector(random, 4), pose.rotation};
      const StraightMover moving{solid.tree, transform_from_pose(near * inverse(own)),
                                 scenes::random_vector(random, 8)};
      const bool passes = passes_by(moving, fixed.tree);
      free += passes;
      unsettled += !passes;
      if (passes) {
        ASSERT_GT(brute_distance(moving, fixed.tree), 0) << i;
      }
    }
  EXPECT_GT(free, 40);
  EXPECT_GT(unsettled, 40);
}

TEST(StraightMotion, PassesObstaclesBehindOrBesideItsShadow) {
  const Solid bar(scenes::box({-1, -1, 0}, {1, 1, 2})), plate(scenes::box({1.01, -500, 5}, {500, 500, 6})),
      behind(scenes::box({-5, -5, -2}, {5, 5, -0.01})), beyond(scenes::box({-5, -5, 12.01}, {5, 5, 13}));
  for (const Solid* other : {&plate, &behind, &beyond}) EXPECT_TRUE(passes_by({bar.tree, {}, {0, 0, 10}}, other->tree));
  EXPECT_FALSE(passes_by({bar.tree, {}, {0.1, 0, 10}}, plate.tree));
  EXPECT_FALSE(passes_by({bar.tree, {}, {0, 0, -10}}, behind.tree));
  EXPECT_FALSE(passes_by({bar.tree, {}, {0, 0, 10.2}}, beyond.tree));
}

}  // namespace
}  // namespace dismantle
