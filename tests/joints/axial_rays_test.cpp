// SPDX-License-Identifier: Apache-2.0
#include "dismantle/joints/axial_rays.h"

#include "tests/support/joint_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

constexpr std::size_t kAll = AxialRays::kRays;
const AxisFrame kUpright({0, 0, 0}, {0, 0, 1});

TEST(AxialRays, MeasureATubeWhereverItStands) {
  Component tube = scenes::component("tube", scenes::bored(scenes::circle(5), 3, 0, 10));
  tube.assembly_from_mesh.translation = {7, -4, 2};
  const AxisFrame frame({7, -4, 0}, {0, 0, 1});
  const AxialRays rays(tube, frame, std::vector<double>{1, 3, 11.5, 12.5});
  EXPECT_FALSE(rays.empty());
  for (const std::size_t plane : {1u, 2u}) {
    EXPECT_NEAR(rays.outer(plane), 5, 0.02);
    EXPECT_NEAR(rays.hole(plane), 3, 0.02);
    EXPECT_EQ(rays.inside_at(plane, 4), kAll);
    EXPECT_EQ(rays.inside_at(plane, 2), 0u);
    EXPECT_EQ(rays.inside_at(plane, 6), 0u);
    EXPECT_EQ(rays.surrounding(plane, 3.1, 1), kAll);
    EXPECT_EQ(rays.surrounding(plane, 2.9, 1), 0u);
  }
  for (const std::size_t plane : {0u, 3u}) EXPECT_EQ(rays.outer(plane), 0);
}

TEST(AxialRays, BeginInsideASolidWithoutHole) {
  const Component block = scenes::component("block", scenes::box({-5, -5, 0}, {5, 5, 10}));
  const AxialRays rays(block, kUpright, std::vector<double>{5});
  EXPECT_EQ(rays.hole(0), 0);
  EXPECT_EQ(rays.surrounding(0, 1, 4), kAll);
  EXPECT_LT(rays.surrounding(0, 1, 6), kAll) << "the solid ends before";
}

TEST(AxialRays, MeetAWallBesideTheAxisOnFewRays) {
  const Component wall = scenes::component("wall", scenes::box({2.6, -50, 0}, {9, 50, 10}));
  const AxialRays rays(wall, kUpright, std::vector<double>{5});
  EXPECT_LT(rays.surrounding(0, 1.35 * 2.5, 2), kAll / 2);
  EXPECT_TRUE(AxialRays(wall, kUpright, std::vector<double>{20}).empty());
}

}  // namespace
}  // namespace dismantle
