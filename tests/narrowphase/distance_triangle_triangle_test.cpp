// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/distance_triangle_triangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dismantle {
namespace {

const Triangle kFace{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

TEST(DistanceTriangleTriangle, IsThatOfACornerAboveTheFace) {
  const TriangleDistance d = distance_triangle_triangle(kFace, {{{1, 1, 0.5}, {1, 1, 9}, {2, 1, 9}}});
  EXPECT_EQ(d.distance, 0.5);
  EXPECT_EQ(d.point_a, (Vec3{1, 1, 0}));
  EXPECT_EQ(d.point_b, (Vec3{1, 1, 0.5}));
}

TEST(DistanceTriangleTriangle, IsThatOfTwoEdgesThatPass) {
  const TriangleDistance d = distance_triangle_triangle(kFace, {{{1, -0.25, -1}, {1, -0.25, 1}, {1, -9, 0}}});
  EXPECT_EQ(d.distance, 0.25);
  EXPECT_EQ(d.point_a, (Vec3{1, 0, 0}));
  EXPECT_EQ(d.point_b, (Vec3{1, -0.25, 0}));
}

TEST(DistanceTriangleTriangle, GivesACommonPointIfTheTrianglesIntersect) {
  const TriangleDistance d = distance_triangle_triangle(kFace, {{{1, 1, -1}, {1, 1, 1}, {9, 9, 1}}});
  EXPECT_EQ(d.distance, 0);
  EXPECT_EQ(d.point_a, d.point_b);
  EXPECT_EQ(d.point_a.z, 0);
  const TriangleDistance inside = distance_triangle_triangle(kFace, {{{1, 1, 0}, {1.5, 1, 0}, {1, 1.5, 0}}});
  EXPECT_EQ(inside.distance, 0);
  EXPECT_EQ(inside.point_a, inside.point_b);
}

TEST(DistanceTriangleTriangle, TakesTrianglesWithoutAreaAsSegmentsAndPoints) {
  EXPECT_EQ(distance_triangle_triangle(kFace, {{{1, 1, 2}, {1, 1, 2}, {1, 1, 2}}}).distance, 2);
  EXPECT_EQ(distance_triangle_triangle(kFace, {{{1, 1, 2}, {1, 1, 3}, {1, 1, 4}}}).distance, 2);
  EXPECT_EQ(
      distance_triangle_triangle({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}, {{{1, 3, -1}, {1, 3, 1}, {1, 3, 0}}}).distance,
      3);
  EXPECT_EQ(
      distance_triangle_triangle({{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}}, {{{1, 3, 4}, {1, 3, 4}, {1, 3, 4}}}).distance, 5);
}

TEST(DistanceTriangleTriangle, KeepsItsAccuracyForNearlyParallelEdges) {
  for (int k = 1; k <= 60; ++k) {
    // Two edges along x that cross above each other's midpoint at height 1e-6, at the angle `tilt`.
    const double tilt = std::ldexp(1, -k);
    const TriangleDistance d =
        distance_triangle_triangle({{{-1, -tilt, 0}, {1.5, 1.5 * tilt, 0}, {0.1, 0.3, -4}}},
                                   {{{-1.25, 1.25 * tilt, 1e-6}, {1, -tilt, 1e-6}, {0, -0.1, 5}}});
    EXPECT_NEAR(d.distance, 1e-6, 9 * kDistanceRelativeError) << "tilt 2^-" << k;
  }
}

TEST(TrianglesWithin, AgreesWithTheDistanceOnBothSidesOfIt) {
  // Random triangles of any shape, also flat ones, coplanar ones and ones that share corners.
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::uniform_int_distribution<int> coarse(-2, 2), kind(0, 3);
  int apart = 0, intersecting = 0;
  for (int i = 0; i < 20000; ++i) {
    Triangle a, b;
    const bool on_grid = kind(random) == 0;
    for (Triangle* t : {&a, &b})
      for (int k = 0; k < 3; ++k)
        for (double* x : {&(*t)[k].x, &(*t)[k].y, &(*t)[k].z}) *x = on_grid ? coarse(random) : coordinate(random);
    if (kind(random) == 0) b[1] = a[2];
    if (kind(random) == 0)
      for (int k = 0; k < 3; ++k) a[k].z = b[k].z = 0;
    const double distance = distance_triangle_triangle(a, b).distance;
    EXPECT_TRUE(triangles_within(a, b, distance)) << i;
    EXPECT_TRUE(triangles_within(a, b, distance + 0.1)) << i;
    EXPECT_FALSE(triangles_within(a, b, distance - 1e-9)) << i;
    (distance > 0 ? apart : intersecting) += 1;
  }
  EXPECT_GT(apart, 2000);
  EXPECT_GT(intersecting, 2000);
}

}  // namespace
}  // namespace dismantle
