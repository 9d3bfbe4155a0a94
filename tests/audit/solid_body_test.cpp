// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/solid_body.h"

#include "tests/audit/depth_scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

using audit::SolidBody;
using depth_scenes::cracked;
using depth_scenes::inside_out;
using depth_scenes::sheet;
using depth_scenes::without;

/// The winding number as the sum of the solid angles of all triangles.
double winding_by_definition(const TriangleMesh& mesh, Vec3 p) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

SolidBody body_of(const TriangleMesh& mesh) {
  return SolidBody(scenes::component("c", mesh));
}

TEST(SolidBody, HasTheWindingNumberOfTheDefinition) {
  constexpr std::uint64_t kSeed = 81;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> uniform(-2, 2);
  const TriangleMesh box = scenes::box({-1, -1, -1}, {1, 1, 1});
  for (const TriangleMesh& mesh : {box, inside_out(box), cracked(box, 4), without(box, 3), without(without(box, 3), 7),
                                   sheet(1, 0), without(depth_scenes::ball(16, 8, 1, {}), 20)}) {
    const SolidBody body = body_of(mesh);
    for (int i = 0; i < 300; ++i) {
      const Vec3 p{uniform(random), uniform(random), uniform(random)};
      const double expected = winding_by_definition(mesh, p);
      EXPECT_NEAR(body.winding(p - body.surface().center()), expected, 1e-9) << "seed " << kSeed;
      if (!body.solid() || std::fabs(std::fabs(expected) - 0.5) < 1e-6) continue;
      EXPECT_EQ(body.inside(p - body.surface().center()), std::fabs(expected) > 0.5);
    }
  }
}

TEST(SolidBody, TellsTheInsideFromTheLastPoint) {
  constexpr std::uint64_t kSeed = 83;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> uniform(-2, 2);
  const TriangleMesh box = scenes::box({-1, -1, -1}, {1, 1, 1}), ball = depth_scenes::ball(16, 8, 1, {});
  int inside = 0, outside = 0, told = 0;
  for (const TriangleMesh& mesh : {box, inside_out(box), cracked(box, 4), without(box, 3), ball, cracked(ball, 20)}) {
    const SolidBody body = body_of(mesh);
    SolidBody::LastPoint last;
    Vec3 p;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 before = p;
      // Steps of several lengths; some end on the surface.
      p = i % 7 == 0 ? Vec3{uniform(random), uniform(random), uniform(random)}
                     : p + 0.2 * Vec3{uniform(random), uniform(random), uniform(random)};
      if (i % 11 == 0) p.x = 1;
      if (body.surface().closed() && body.surface().closest(p).distance > 1e-6) {
        const std::optional<int> between = body.surface().crossings_between(before, p);
        told += between ? 1 : 0;
        if (between) {
          EXPECT_EQ(body.surface().ray_crossings(before).number, body.surface().ray_crossings(p).number + *between);
        }
      }
      const bool found = body.inside(p, last);
      if (body.surface().closest(p).distance < 1e-6) continue;  // undefined on the surface
      EXPECT_EQ(found, body.inside(p)) << "point " << i << ", seed " << kSeed;
      (found ? inside : outside) += 1;
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
  EXPECT_GT(told, 500);
}

TEST(SolidBody, TellsSolidsFromSheets) {
  const TriangleMesh box = scenes::box({-1, -1, -1}, {1, 1, 1});
  EXPECT_TRUE(body_of(box).closed());
  EXPECT_TRUE(body_of(inside_out(box)).closed());
  EXPECT_EQ(body_of(inside_out(box)).orientation(), -1);
  EXPECT_TRUE(body_of(cracked(box, 4)).closed());
  EXPECT_FALSE(body_of(without(box, 3)).closed());
  EXPECT_TRUE(body_of(without(box, 3)).solid());
  EXPECT_FALSE(body_of(sheet(1, 0)).solid());
  TriangleMesh bowl = depth_scenes::ball(32, 16, 1, {});
  std::erase_if(bowl.faces, [&](const Face& f) {
    return std::max({bowl.vertices[f.v[0]].z, bowl.vertices[f.v[1]].z, bowl.vertices[f.v[2]].z}) > 1e-9;
  });
  EXPECT_FALSE(body_of(bowl).solid());
}

/// A crack as it is between rounded vertices, and points from which the first ray passes through it.
TEST(SolidBody, IsClosedAcrossCracksAlsoWhereARayPassesThroughOne) {
  TriangleMesh box = scenes::box({-1, -1, -1}, {1, 1, 1});
  box = cracked(box, 4);
  const Vec3 middle = box.vertices.back();
  box.vertices.back() = 0.9999 * middle;
  const SolidBody body = body_of(box);
  ASSERT_TRUE(body.closed());
  ASSERT_FALSE(body.surface().closed());
  int through = 0;
  for (int direction = 0; direction < audit::AuditBody::kRayDirections; ++direction)
    for (int i = 0; i < 200; ++i) {
      const Vec3 crack = (0.9999 + 0.0001 * i / 200.0) * middle;
      for (const double way : {0.3, 3.0}) {
        const Vec3 p = crack - way * body.surface().ray_crossings(crack, direction).direction;
        const double expected = winding_by_definition(box, p);
        through += std::fabs(body.surface().ray_crossings(p, direction).number - expected) > 0.5;
        EXPECT_NEAR(body.winding(p), expected, 1e-3);
      }
    }
  EXPECT_GT(through, 10);
}

/// Points that can be reached from a point outside without crossing the surface, within the radius, are outside.
TEST(SolidBody, BoundsWhereTheOutsideOfAnOpenSolidEnds) {
  constexpr std::uint64_t kSeed = 82;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> uniform(-2, 2), unit(0, 1);
  const TriangleMesh open = without(scenes::box({-1, -1, -1}, {1, 1, 1}), 4);
  const SolidBody body = body_of(open);
  int certain = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{uniform(random), uniform(random), uniform(random)},
        q{uniform(random), uniform(random), uniform(random)};
    const double radius = std::pow(10, -2 * unit(random));
    const double gap = body.surface().closest(p).distance - radius;
    SolidBody::LastPoint none;
    if (!(gap > 0) || !body.outside_throughout(p, radius, 0, none)) continue;
    ++certain;
    EXPECT_FALSE(body.inside(p + radius * unit(random) * normalized(q))) << "seed " << kSeed;
  }
  EXPECT_GT(certain, 500);
}

TEST(OpenBoundary, CancelsAtTJunctionsAndKeepsOpenings) {
  const TriangleMesh box = scenes::box({-1, -1, -1}, {1, 1, 1});
  EXPECT_TRUE(audit::open_boundary(box).empty());
  EXPECT_TRUE(audit::open_boundary(cracked(cracked(box, 4), 0)).empty());
  double around = 0;
  for (const audit::OpenEdge& edge : audit::open_boundary(without(box, 0)))
    around += edge.count * length(edge.to - edge.from);
  EXPECT_NEAR(around, 4 + std::sqrt(8.0), 1e-12);
}

TEST(OpenBoundary, SumsStripAnglesOverAnyNumberOfTurns) {
  std::mt19937_64 random(21);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  for (int i = 0; i < 2000; ++i) {
    std::vector<audit::OpenEdge> edges;
    Vec3 at = vector();
    for (int k = 0; k < 40; ++k) {
      const Vec3 next = i % 2 == 0 ? vector() : at + 0.1 * vector();
      edges.push_back({at, next, 1.0 + k % 3});
      at = next;
    }
    const Vec3 direction = normalized(vector()), point = 0.3 * vector();
    double sum = 0;
    for (const audit::OpenEdge& edge : edges) sum += audit::strip_angle(edge, direction, point);
    ASSERT_NEAR(audit::strip_angles(edges, direction, point), sum, 1e-9) << "case " << i;
  }
}

/// Around a square whose corners are seen at right angles, sums are exactly half a turn after some edges.
TEST(OpenBoundary, SumsStripAnglesThroughExactHalfTurns) {
  const Vec3 corner[4] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (const int step : {1, 3})
    for (const double up : {1.0, -1.0}) {
      std::vector<audit::OpenEdge> edges;
      double sum = 0;
      for (int k = 0; k < 40; ++k) {
        edges.push_back({corner[step * k % 4], corner[step * (k + 1) % 4], 1});
        sum += audit::strip_angle(edges.back(), {0, 0, up}, {});
        ASSERT_NEAR(audit::strip_angles(edges, {0, 0, up}, {}), sum, 1e-9) << step << " " << up << " " << k;
      }
      EXPECT_NEAR(std::fabs(sum), 20 * std::numbers::pi, 1e-9);  // ten half spheres
    }
}

}  // namespace
}  // namespace dismantle
