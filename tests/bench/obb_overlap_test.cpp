// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/obb_overlap.h"

#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Obb box_of(Vec3f half) {
  Obb box;
  box.half = half;
  return box;
}

bool surfaces_intersect(const TriangleMesh& a, const TriangleMesh& b) {
  for (std::size_t f = 0; f < a.faces.size(); ++f)
    for (std::size_t g = 0; g < b.faces.size(); ++g)
      if (intersect_triangle_triangle(a.triangle(f), b.triangle(g))) return true;
  return false;
}

TEST(BoxesOverlap, IsWhatTheBoxesTrianglesSayForRandomPlacesOfTwoBoxes) {
  const Obb a = box_of({3, 2, 1}), b = box_of({2, 2.5f, 1.5f});
  const TriangleMesh mesh_a = scenes::box({-3, -2, -1}, {3, 2, 1});
  std::mt19937_64 random(5);
  int overlapping = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Pose pose = scenes::random_pose(random, 5, 3);
    const TriangleMesh mesh_b = scenes::moved(scenes::box({-2, -2.5, -1.5}, {2, 2.5, 1.5}), pose);
    const bool expected = surfaces_intersect(mesh_a, mesh_b);
    ASSERT_EQ(boxes_overlap(a, b, transform_from_pose(pose)), expected) << trial;
    overlapping += expected ? 1 : 0;
  }
  EXPECT_GT(overlapping, 300);
  EXPECT_LT(overlapping, 1700);
}

TEST(BoxesOverlap, HoldsForABoxInsideAnother) {
  EXPECT_TRUE(boxes_overlap(box_of({3, 3, 3}), box_of({1, 1, 1}), {}));
}

}  // namespace
}  // namespace dismantle
