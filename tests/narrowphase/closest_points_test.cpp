// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/closest_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dismantle {
namespace {

double distance(const ClosestPoints& c) {
  return length(c.point_a - c.point_b);
}

TEST(ClosestPoints, FindTheFaceTheEdgesAndTheCornersOfATriangle) {
  const Triangle t{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  const ClosestPoints inside = closest_points_vertex_face({1, 1, 3}, t);
  EXPECT_EQ(inside.point_b, (Vec3{1, 1, 0}));
  EXPECT_TRUE(inside.interior);
  EXPECT_EQ(closest_points_vertex_face({1, -2, 3}, t).point_b, (Vec3{1, 0, 0}));
  EXPECT_EQ(closest_points_vertex_face({-2, 1, 3}, t).point_b, (Vec3{0, 1, 0}));
  EXPECT_EQ(closest_points_vertex_face({4, 4, 0}, t).point_b, (Vec3{2, 2, 0}));
  EXPECT_EQ(closest_points_vertex_face({-1, -1, 1}, t).point_b, (Vec3{0, 0, 0}));
  EXPECT_EQ(closest_points_vertex_face({9, -1, 1}, t).point_b, (Vec3{4, 0, 0}));
  EXPECT_EQ(closest_points_vertex_face({-1, 9, 1}, t).point_b, (Vec3{0, 4, 0}));
  EXPECT_FALSE(closest_points_vertex_face({-1, 9, 1}, t).interior);
}

TEST(ClosestPoints, FindTheInteriorsAndTheEndsOfEdges) {
  const ClosestPoints crossing = closest_points_edge_edge({{-1, 0, 0}, {1, 0, 0}}, {{0, -1, 2}, {0, 1, 2}});
  EXPECT_EQ(crossing.point_a, (Vec3{0, 0, 0}));
  EXPECT_EQ(crossing.point_b, (Vec3{0, 0, 2}));
  EXPECT_TRUE(crossing.interior);
  const ClosestPoints ends = closest_points_edge_edge({{-1, 0, 0}, {1, 0, 0}}, {{2, 1, 0}, {3, 5, 0}});
  EXPECT_EQ(ends.point_a, (Vec3{1, 0, 0}));
  EXPECT_EQ(ends.point_b, (Vec3{2, 1, 0}));
  EXPECT_FALSE(ends.interior);
  EXPECT_DOUBLE_EQ(distance(closest_points_edge_edge({{0, 0, 0}, {4, 0, 0}}, {{1, 2, 0}, {2, 2, 0}})), 2);
}

TEST(ClosestPoints, TakeZeroLengthFeaturesAsPoints) {
  const Vec3 p{1, 2, 3};
  EXPECT_EQ(distance(closest_points_edge_edge({p, p}, {p, p})), 0);
  EXPECT_DOUBLE_EQ(distance(closest_points_edge_edge({p, p}, {{0, 2, 0}, {0, 2, 9}})), 1);
  EXPECT_DOUBLE_EQ(distance(closest_points_edge_edge({{0, 2, 0}, {0, 2, 9}}, {p, p})), 1);
  EXPECT_DOUBLE_EQ(distance(closest_points_vertex_face({0, 0, 5}, {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}})), 5);
  EXPECT_DOUBLE_EQ(distance(closest_points_vertex_face({0, 0, 5}, {{p, p, p}})), 3);
}

TEST(ClosestPoints, AreNoFurtherThanAnySampledPoints) {
  constexpr unsigned kSeed = 61;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  for (int k = 0; k < 3000; ++k) {
    const Triangle t{{vector(), vector(), vector()}};
    const Vec3 p = vector();
    const Vec3 a[2] = {vector(), vector()}, b[2] = {vector(), vector()};
    double to_face = 1e9, to_edge = 1e9;
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j <= 20; ++j) {
        const double u = i / 20.0, v = j / 20.0;
        to_edge = std::min(to_edge, length((1 - u) * a[0] + u * a[1] - (1 - v) * b[0] - v * b[1]));
        if (i + j <= 20) to_face = std::min(to_face, length((1 - u - v) * t[0] + u * t[1] + v * t[2] - p));
      }
    ASSERT_LE(distance(closest_points_vertex_face(p, t)), to_face + 1e-14) << "seed " << kSeed << " case " << k;
    ASSERT_LE(distance(closest_points_edge_edge(a, b)), to_edge + 1e-14) << "seed " << kSeed << " case " << k;
  }
}

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

}  // namespace
}  // namespace dismantle
