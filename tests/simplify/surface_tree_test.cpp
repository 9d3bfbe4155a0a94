// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/surface_tree.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

TEST(ClosestPointOfTriangle, IsTheCornerTheSideOrTheInside) {
  //   2
  //   | .
  //   0---1
  const Triangle t{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  EXPECT_EQ(closest_point_of_triangle(t, {-1, -1, 3}), (Vec3{0, 0, 0}));
  EXPECT_EQ(closest_point_of_triangle(t, {9, -1, 0}), (Vec3{4, 0, 0}));
  EXPECT_EQ(closest_point_of_triangle(t, {2, -1, 5}), (Vec3{2, 0, 0}));
  EXPECT_EQ(closest_point_of_triangle(t, {3, 3, -1}), (Vec3{2, 2, 0}));
  EXPECT_EQ(closest_point_of_triangle(t, {1, 1, 7}), (Vec3{1, 1, 0}));
}

TEST(ClosestPointOfTriangle, OfADegenerateTriangleIsOnItsLongestSide) {
  const Triangle needle{{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}};
  EXPECT_EQ(closest_point_of_triangle(needle, {3, 1, 0}), (Vec3{3, 0, 0}));
  const Triangle point{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}};
  EXPECT_EQ(closest_point_of_triangle(point, {0, 0, 0}), (Vec3{1, 2, 3}));
}

TEST(ClosestPointOfTriangle, NoSampledPointIsNearer) {
  std::mt19937 random(3);
  std::normal_distribution<double> at(0, 1);
  const auto point = [&] { return Vec3{at(random), at(random), at(random)}; };
  for (int i = 0; i < 2000; ++i) {
    Triangle t{{point(), point(), point()}};
    if (i % 3 == 0) t[2] = t[0] + 0.4 * (t[1] - t[0]) + std::pow(10.0, -(i % 14)) * point();  // a sliver
    const Vec3 p = point();
    const double found = length(p - closest_point_of_triangle(t, p));
    for (int a = 0; a <= 12; ++a)
      for (int b = 0; a + b <= 12; ++b)
        EXPECT_LE(found, length(p - (t[0] + a / 12.0 * (t[1] - t[0]) + b / 12.0 * (t[2] - t[0]))) + 1e-14);
  }
}

TEST(SurfaceTree, FindsTheSameDistanceAsBruteForce) {
  const TriangleMesh mesh = scenes::tube(5, 3, -4, 9, 37, 5);
  const SurfaceTree tree(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-15, 15);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p{at(random), at(random), at(random)};
    double least = 1e300;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      least = std::min(least, length(p - closest_point_of_triangle(mesh.triangle(f), p)));
    const MeshDistance found = tree.distance(p);
    EXPECT_EQ(found.distance, least);
    EXPECT_EQ(tree.distance_to_face(p, found.face), least);
  }
}

}  // namespace
}  // namespace dismantle
