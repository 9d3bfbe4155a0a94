// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace dismantle {

namespace {

std::vector<Face> triangulate(const std::vector<Vec3>& points) {
  std::vector<std::uint32_t> corners(points.size());
  std::iota(corners.begin(), corners.end(), 0u);
  std::vector<Face> faces;
  PolygonTriangulator().append(corners, points, faces);
  return faces;
}

/// Expects that the triangles cover a polygon in a plane of normal `n` once: same orientation, and areas that add up.
void expect_cover(const std::vector<Vec3>& points, Vec3 n, double area) {
  const std::vector<Face> faces = triangulate(points);
  EXPECT_EQ(faces.size(), points.size() - 2);
  double sum = 0;
  for (const Face& f : faces) {
    const double part = dot(normal_unscaled({{points[f.v[0]], points[f.v[1]], points[f.v[2]]}}), n) / 2;
    EXPECT_GT(part, 0);
    sum += part;
  }
  EXPECT_NEAR(sum, area, 1e-12 * area);
}

/// The same polygon, starting at each of its corners, in each coordinate plane, in both orientations.
void expect_cover_everywhere(const std::vector<Vec3>& xy, double area) {
  for (std::size_t start = 0; start < xy.size(); ++start)
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Vec3> points, reversed;
      for (std::size_t i = 0; i < xy.size(); ++i) {
        const Vec3 p = xy[(start + i) % xy.size()];
        Vec3 q;
        q[axis] = 5;
        q[(axis + 1) % 3] = p.x;
        q[(axis + 2) % 3] = p.y;
        points.push_back(q);
      }
      Vec3 n;
      n[axis] = 1;
      expect_cover(points, n, area);
      reversed.assign(points.rbegin(), points.rend());
      expect_cover(reversed, -n, area);
    }
}

}  // namespace

TEST(PolygonTriangulator, CutsASquare) {
  expect_cover_everywhere({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1);
}

//  3-------2
//   \     /      the dart's corner 1 points in
//    \ 1 /
//     / \        (a fan from corner 0 would leave it)
//    0   ...
TEST(PolygonTriangulator, CutsADart) {
  expect_cover_everywhere({{0, 0, 0}, {4, -2, 0}, {1, 0, 0}, {4, 2, 0}}, 2);
}

//  5--4
//  |  |
//  |  3--2
//  0-----1
TEST(PolygonTriangulator, CutsAnL) {
  expect_cover_everywhere({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 3);
}

TEST(PolygonTriangulator, LeavesNoCornerInTheMiddleOfAnEdge) {
  expect_cover_everywhere({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}}, 4);
}

TEST(PolygonTriangulator, CutsACombOf200Teeth) {
  std::vector<Vec3> comb;
  for (int i = 0; i < 200; ++i) {
    comb.push_back({1.0 * i, 0, 0});
    comb.push_back({i + 0.5, 9, 0});
  }
  comb.push_back({200, 10, 0});
  comb.push_back({-1, 10, 0});
  double area = 0;
  for (std::size_t i = 0; i < comb.size(); ++i) {
    const Vec3 p = comb[i], q = comb[(i + 1) % comb.size()];
    area += (p.x * q.y - p.y * q.x) / 2;
  }
  expect_cover(comb, {0, 0, area > 0 ? 1.0 : -1.0}, std::abs(area));
}

TEST(PolygonTriangulator, GivesNMinusTwoTrianglesForDegeneratePolygons) {
  const unsigned seed = 7;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int i = 0; i < 200; ++i) {
    std::vector<Vec3> points;
    for (int k = 0; k < 4 + i % 20; ++k) points.push_back({coordinate(random), coordinate(random), coordinate(random)});
    EXPECT_EQ(triangulate(points).size(), points.size() - 2);
  }
  EXPECT_EQ(triangulate(std::vector<Vec3>(9, {1, 2, 3})).size(), 7u);
  EXPECT_EQ(triangulate({{0, 0, 0}}).size(), 1u);
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}}).size(), 1u);
}

}  // namespace dismantle
