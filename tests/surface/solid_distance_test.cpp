// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/solid_distance.h"

#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Solid {
  Component component;
  SolidTree tree = make_solid_tree(component, {});
  explicit Solid(TriangleMesh mesh) : component(scenes::component("solid", std::move(mesh))) {}
};

double brute_distance(const PlacedSolid& a, const PlacedSolid& b) {
  const auto placed = [](const PlacedSolid& p, std::uint32_t face) {
    Triangle t = p.solid->triangle(face);
    for (Vec3& corner : t.corner) corner = p.world_from_assembled * corner;
    return t;
  };
  double minimum = kInfinite;
  for (std::uint32_t f = 0; f < a.solid->faces.size(); ++f)
    for (std::uint32_t g = 0; g < b.solid->faces.size(); ++g)
      minimum = std::min(minimum, distance_triangle_triangle(placed(a, f), placed(b, g)).distance);
  return minimum;
}

/// Expects the distance of brute force, and nothing at a limit that is not larger.
void expect_nearest(const PlacedSolid& a, const PlacedSolid& b) {
  const double minimum = brute_distance(a, b);
  const SolidDistance found = solid_distance(a, b);
  ASSERT_EQ(found.distance, minimum);
  EXPECT_NEAR(length(found.point_a - found.point_b), minimum, 1e-9);
  EXPECT_LE(bounds_distance(a, b), minimum);
  EXPECT_TRUE(std::isinf(solid_distance(a, b, minimum).distance));
  const SolidDistance limited = solid_distance(a, b, std::nextafter(minimum, kInfinite));
  EXPECT_EQ(limited.distance, minimum);
}

TEST(SolidDistance, IsThatOfAllPairsOfFacesWhereverTheyAre) {
  std::mt19937_64 random(4);
  for (const double offset : {1.0, 1e3, 1e5}) {
    const Solid wheel(scenes::moved(scenes::tube(3, 1, -2, 2, 12, 2), scenes::random_pose(random, offset, 3)));
    const Solid needle(scenes::moved(scenes::tube(0.3, 0, -20, 20, 24), scenes::random_pose(random, offset, 3)));
    const auto middle = [](const Solid& s) { return assembled_bounds(s.component).center(); };
    for (int round = 0; round < 12; ++round) {
      // From intersecting to far apart.
      const Pose turn = scenes::random_pose(random, 0, 3);
      const RigidTransform t = transform_from_pose(turn);
      const Vec3 apart = scenes::random_vector(random, round < 4 ? 0.5 : 5.0 * round);
      const Vec3 there = middle(wheel) + apart - t.rotation * middle(needle);
      expect_nearest({&wheel.tree, {}}, {&needle.tree, {t.rotation, there}});
    }
  }
}

TEST(SolidDistance, IsExactBetweenFacesThatAreAllEquallyNear) {
  const Solid plate(scenes::box({0, 0, 0}, {10, 10, 1}));
  const Solid ring(scenes::tube(4, 2, 0, 3, 24, 2));
  for (const double gap : {0.0, 1e-9, 0.01, 3.0})
    expect_nearest({&plate.tree, {}}, {&ring.tree, {{}, {5, 5, 1 + gap}}});
}

TEST(SolidDistance, NamesTheFacesThatAreNearest) {
  const Solid low(scenes::box({0, 0, 0}, {10, 10, 1})), high(scenes::box({20, 2, 0}, {22, 4, 5}));
  const SolidDistance found = solid_distance({&low.tree, {}}, {&high.tree, {}});
  EXPECT_EQ(found.distance, 10);
  EXPECT_EQ(distance_triangle_triangle(low.tree.triangle(found.face_a.value), high.tree.triangle(found.face_b.value))
                .distance,
            10);
  EXPECT_EQ(found.point_a.x, 10);
  EXPECT_EQ(found.point_b.x, 20);
}

}  // namespace
}  // namespace dismantle
