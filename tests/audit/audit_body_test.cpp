// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_body.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dismantle::audit {
namespace {

Vec3 random_point(std::mt19937_64& random, double reach) {
  std::uniform_real_distribution<double> uniform(-reach, reach);
  return {uniform(random), uniform(random), uniform(random)};
}

TEST(DistanceToTriangle, IsTheMinimumOverItsPoints) {
  std::mt19937_64 random(21);
  for (int i = 0; i < 200; ++i) {
    const Triangle t{{random_point(random, 1), random_point(random, 1), random_point(random, 1)}};
    const Vec3 point = random_point(random, 2);
    double minimum = 1e300;
    constexpr int kSteps = 100;
    for (int j = 0; j <= kSteps; ++j)
      for (int k = 0; j + k <= kSteps; ++k)
        minimum = std::min(minimum, length(point - (t[0] + (double(j) / kSteps) * (t[1] - t[0]) +
                                                    (double(k) / kSteps) * (t[2] - t[0]))));
    const double distance = distance_to_triangle(t, point);
    EXPECT_LE(distance, minimum + 1e-12);
    EXPECT_GE(distance, minimum - 0.05);
  }
}

TEST(DistanceToTriangle, WorksForTrianglesWithoutArea) {
  const Triangle needle{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}};
  EXPECT_DOUBLE_EQ(distance_to_triangle(needle, {1.5, 3, 0}), 3);
  const Triangle point{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
  EXPECT_DOUBLE_EQ(distance_to_triangle(point, {1, 1, 4}), 3);
}

TEST(AuditBody, FindsTheSameClosestTriangleAsBruteForce) {
  std::mt19937_64 random(22);
  const AuditBody body(scenes::component("tube", scenes::tube(5, 3, -4, 4, 40, 6)));
  for (int i = 0; i < 500; ++i) {
    const Vec3 point = random_point(random, 8);
    double minimum = 1e300;
    for (std::uint32_t f = 0; f < 40 * 6 * 4 + 160; ++f)
      minimum = std::min(minimum, distance_to_triangle(body.triangle(f), point));
    const SurfacePoint closest = body.closest(point);
    EXPECT_EQ(closest.distance, minimum);
    EXPECT_EQ(distance_to_triangle(body.triangle(closest.face), point), minimum);
  }
}

TEST(AuditBody, FindsTheClosestTriangleAmongSlivers) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 20; ++i) {
    TriangleMesh mesh;
    for (std::uint32_t f = 0; f < 40; ++f) {
      const Vec3 from = random_point(random, 10), to = random_point(random, 10);
      const Vec3 beside =
          from + uniform(random) * (to - from) + random_point(random, std::pow(10, -15 * uniform(random)));
      mesh.vertices.insert(mesh.vertices.end(), {from, to, beside});
      const std::uint32_t v = 3 * f;
      mesh.faces.push_back(f % 2 == 0 ? Face{{v, v + 1, v + 2}} : Face{{v + 2, v, v + 1}});
    }
    const AuditBody body(scenes::component("slivers", mesh));
    for (int k = 0; k < 200; ++k) {
      const Triangle t = body.triangle(static_cast<std::uint32_t>(k) % body.face_count());
      const Vec3 point =
          t[0] + uniform(random) * (t[1] - t[0]) + random_point(random, std::pow(10, -12 * uniform(random)));
      double minimum = 1e300;
      for (std::uint32_t f = 0; f < body.face_count(); ++f)
        minimum = std::min(minimum, distance_to_triangle(body.triangle(f), point));
      EXPECT_NEAR(body.closest(point).distance, minimum, 1e-13);
    }
  }
}

TEST(AuditBody, KnowsWhichPointsAreInsideATube) {
  std::mt19937_64 random(23);
  const AuditBody body(scenes::component("tube", scenes::moved(scenes::tube(5, 3, -4, 4, 200, 3), {{100, 0, 7}, {}})));
  const double facet = 1 - std::cos(std::acos(-1.0) / 200);
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = random_point(random, 6);
    const double radius = std::hypot(p.x, p.y);
    if (std::fabs(radius - 5) < 5 * facet || std::fabs(radius - 3) < 5 * facet) continue;
    const bool expected = radius > 3 && radius < 5 && std::fabs(p.z) < 4;
    EXPECT_EQ(body.contains(p), expected);
    inside += expected ? 1 : 0;
  }
  EXPECT_GT(inside, 500);
}

TEST(AuditBody, KnowsWhichPointsOfARegularGridAreInside) {
  const AuditBody body(scenes::component("box", scenes::box({-2, -2, -2}, {2, 2, 2})));
  for (int x = -5; x <= 5; ++x)
    for (int y = -5; y <= 5; ++y)
      for (int z = -5; z <= 5; ++z) {
        if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == 4) continue;
        const bool expected = std::max({std::abs(x), std::abs(y), std::abs(z)}) < 4;
        EXPECT_EQ(body.contains({x / 2.0, y / 2.0, z / 2.0}), expected);
      }
}

TEST(AuditBody, TreatsAnInsideOutMeshAsASolid) {
  TriangleMesh mesh = scenes::box({-2, -2, -2}, {2, 2, 2});
  for (Face& face : mesh.faces) std::swap(face.v[0], face.v[1]);
  const AuditBody body(scenes::component("box", mesh));
  EXPECT_TRUE(body.closed());
  EXPECT_TRUE(body.contains({0.1, 0.2, 0.3}));
  EXPECT_FALSE(body.contains({2.1, 0.2, 0.3}));
}

TEST(AuditBody, FindsAVertexOfEachConnectedPiece) {
  TriangleMesh mesh = scenes::box({0, 0, 0}, {1, 1, 1});
  const TriangleMesh other = scenes::box({3, 0, 0}, {4, 1, 1});
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (Face face : other.faces) {
    for (std::uint32_t& v : face.v) v += 8;
    mesh.faces.push_back(face);
  }
  const AuditBody body(scenes::component("two", mesh));
  ASSERT_EQ(body.piece_vertices().size(), 2u);
  EXPECT_NE(body.piece_vertices()[0] / 8, body.piece_vertices()[1] / 8);
}

TEST(AuditBody, OfNothingIsEmpty) {
  Component nothing;
  nothing.mesh = std::make_shared<const TriangleMesh>();
  EXPECT_TRUE(AuditBody(nothing).empty());
}

}  // namespace
}  // namespace dismantle::audit
