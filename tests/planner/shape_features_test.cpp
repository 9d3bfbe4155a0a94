// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/shape_features.h"

#include "tests/support/disassembly_cases.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(ShapeFeatures, FindsTheFacesOfABoxLargestFirst) {
  const ShapeFeatures features = shape_features(scenes::box({0, 0, 0}, {10, 20, 30}));
  ASSERT_EQ(features.normals.size(), 6u);
  EXPECT_EQ(std::abs(features.normals[0].direction.x), 1);
  EXPECT_DOUBLE_EQ(features.normals[0].weight, 600);
  EXPECT_EQ(features.axes.size(), 3u);
  EXPECT_NEAR(length(features.center - Vec3{5, 10, 15}), 0, 1e-12);
  EXPECT_NEAR(features.radius, std::sqrt(25 + 100 + 225), 1e-12);
}

TEST(ShapeFeatures, FindsTheAxisOfABoreInAnyOrientation) {
  for (const double angle : {0.0, 0.3, 1.1, 2.0}) {
    const Quat turn = quat_about(normalized(Vec3{1, 2, 3}), angle);
    const Vec3 axis = mat3_from_quat(turn) * Vec3{0, 0, 1};
    const ShapeFeatures features = shape_features(scenes::moved(scenes::tube(12, 10, 0, 30, 48), {{5, 6, 7}, turn}));
    ASSERT_FALSE(features.axes.empty());
    EXPECT_NEAR(std::abs(dot(features.axes[0].direction, axis)), 1, 1e-12) << angle;
  }
}

TEST(ShapeFeatures, FindsTheSameAreaHoweverTheSurfaceIsCut) {
  std::mt19937_64 random(5);
  const TriangleMesh block =
      scenes::box_block({{{0, 4, 10}, {0, 20}, {0, 5, 30}}}, [](int x, int, int z) { return x == 0 || z == 0; });
  EXPECT_NEAR(shape_features(block).area, 1900, 1e-9);
  EXPECT_NEAR(shape_features(scenes::refined(block, random)).area, 1900, 1e-9);
}

}  // namespace
}  // namespace dismantle
