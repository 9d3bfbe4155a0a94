// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/surface_tree.h"

#include "dismantle/narrowphase/closest_points.h"
#include "tests/support/meshes.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace dismantle {
namespace {

/// The distance of a point, by looking at every face.
double brute_force_distance(const TriangleMesh& mesh, Vec3 p) {
  double minimum = 1e300;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    minimum = std::min(minimum, length(p - closest_point_of_triangle(mesh.triangle(f), p)));
  return minimum;
}

/// A plate with a round boss.
TriangleMesh plate() {
  TriangleMesh mesh = scenes::box({-20, -8, -1}, {20, 8, 1});
  const TriangleMesh boss = scenes::tube(5, 3, 1, 9, 37, 5);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), boss.vertices.begin(), boss.vertices.end());
  for (const Face& f : boss.faces) mesh.faces.push_back({{f.v[0] + first, f.v[1] + first, f.v[2] + first}});
  return mesh;
}

TEST(SurfaceTree, FindsTheSameDistanceAsBruteForce) {
  std::mt19937_64 random(5);
  for (int turn = 0; turn < 8; ++turn) {
    // On a grid, turned, and turned and far from the origin.
    const Pose pose = turn == 0 ? Pose{} : scenes::random_pose(random, turn < 4 ? 3 : 3000, 3);
    const TriangleMesh mesh = scenes::moved(plate(), pose);
    const SurfaceTree tree(mesh);
    EXPECT_EQ(tree.axes() == Mat3{}, turn == 0);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = tree.bounds().center() + scenes::random_vector(random, i % 2 == 0 ? 15 : 1);
      const double minimum = brute_force_distance(mesh, p);
      const MeshDistance found = tree.distance(p);
      EXPECT_EQ(found.distance, minimum);
      EXPECT_EQ(tree.distance_to_face(p, found.face), minimum);
      EXPECT_EQ(tree.distance(p, static_cast<std::uint32_t>(i) % 12).distance, minimum);
    }
  }
}

TEST(SurfaceTree, VisitsEveryTriangleThatIsNearOrHit) {
  std::mt19937_64 random(6);
  std::size_t near = 0, hit = 0;
  for (int turn = 0; turn < 6; ++turn) {
    const TriangleMesh mesh = scenes::moved(plate(), scenes::random_pose(random, 40, 3));
    const SurfaceTree tree(mesh);
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = tree.bounds().center() + scenes::random_vector(random, 15);
      const Vec3 along = scenes::random_vector(random, 1);
      const double reach = 2;
      std::vector<bool> visited(mesh.faces.size()), crossed(mesh.faces.size());
      tree.for_each_near({&p, 1}, reach, [&](std::uint32_t f) { return visited[f] = true; });
      tree.for_each_hit(p, along, [&](std::uint32_t f, RayHit) { return crossed[f] = true; });
      for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const Triangle t = mesh.triangle(f);
        if (length(p - closest_point_of_triangle(t, p)) <= reach) {
          EXPECT_TRUE(visited[f]);
          ++near;
        }
        if (ray_hit(along, {{t[0] - p, t[1] - p, t[2] - p}}) != RayHit::Miss) {
          EXPECT_TRUE(crossed[f]);
          ++hit;
        }
      }
    }
  }
  EXPECT_GT(near, 100u);
  EXPECT_GT(hit, 100u);
}

TEST(SurfaceTree, BoundsAPartThatStandsAtAnAngleAsTightlyAsOneThatDoesNot) {
  std::mt19937_64 random(7);
  const SurfaceTree straight(plate());
  double sum_of_straight = 0;
  for (NodeIndex node = 0; node < straight.bvh().node_count(); ++node) sum_of_straight += diagonal(straight.box(node));
  for (int turn = 0; turn < 5; ++turn) {
    const SurfaceTree turned(scenes::moved(plate(), scenes::random_pose(random, 100, 3)));
    double sum = 0;
    for (NodeIndex node = 0; node < turned.bvh().node_count(); ++node) sum += diagonal(turned.box(node));
    EXPECT_LT(sum, 1.1 * sum_of_straight);
    const Vec3 size = turned.box(turned.bvh().root()).size();
    EXPECT_NEAR(size.x * size.y * size.z, 40 * 16 * 10, 0.01);
  }
}

}  // namespace
}  // namespace dismantle
