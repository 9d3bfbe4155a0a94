// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/solid_tree_query.h"

#include "dismantle/narrowphase/closest_points.h"
#include "tests/support/random_scenes.h"
#include "tests/support/solid_scene.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using scenes::Solid;

double brute_distance(const SolidTree& solid, Vec3 p) {
  double best = std::numeric_limits<double>::infinity();
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    const ClosestPoints c = closest_points_vertex_face(p, solid.triangle(f));
    best = std::min(best, length(c.point_b - c.point_a));
  }
  return best;
}

/// Squares and slivers, fans and strips, rotated.
std::vector<TriangleMesh> meshes(std::mt19937_64& random, double offset) {
  std::vector<TriangleMesh> made;
  for (const TriangleMesh& mesh : {scenes::tube(3, 1, -2, 2, 32, 5), scenes::tube(3, 0, -20, 20, 300, 1)})
    made.push_back(scenes::moved(mesh, scenes::random_pose(random, offset, 3)));
  return made;
}

TEST(NearestFace, AgreesWithAllFacesWhateverItBeginsWith) {
  std::mt19937_64 random(11);
  for (const double offset : {1.0, 1e3, 1e5})
    for (const TriangleMesh& mesh : meshes(random, offset)) {
      const Solid solid(mesh);
      const Vec3 at = assembled_bounds(solid.assembly.components[0]).center();
      for (int i = 0; i < 300; ++i) {
        // Also arbitrarily near to the surface.
        Vec3 p = at + scenes::random_vector(random, 5);
        if (i % 3 == 0) p = mesh.vertices[random() % mesh.vertices.size()] + scenes::random_vector(random, 1e-6);
        const std::uint32_t hint =
            i % 2 == 0 ? NearestFace::kNone : static_cast<std::uint32_t>(random() % mesh.faces.size());
        const NearestFace nearest = nearest_face(solid.tree, p, hint);
        ASSERT_EQ(nearest.distance, brute_distance(solid.tree, p)) << offset;
        const double to_bounds = distance_to_bounds(solid.tree, p);
        ASSERT_LE(to_bounds, nearest.distance);
        const NearestFace near = nearest_face(solid.tree, p, hint, 1);
        ASSERT_TRUE(near.distance == nearest.distance || near.distance < 1);
      }
    }
}

TEST(NearestFace, FindsNothingInAnEmptyTree) {
  EXPECT_EQ(nearest_face(SolidTree{}, {1, 2, 3}, NearestFace::kNone).face, NearestFace::kNone);
}

TEST(PointInSolid, TellsInsideFromOutsideOfTurnedTubes) {
  std::mt19937_64 random(4);
  for (const double offset : {5.0, 1e4}) {
    const Pose pose = scenes::random_pose(random, offset, 3);
    const Solid coarse(scenes::moved(scenes::tube(3, 1, -2, 2, 64, 5), pose));
    const Solid slivers(scenes::moved(scenes::tube(3, 1, -2, 2, 900, 1), pose));
    const RigidTransform t = transform_from_pose(pose);
    for (int i = 0; i < 5000; ++i) {
      const Vec3 p = scenes::random_vector(random, 4);
      const double r = std::hypot(p.x, p.y);
      if (std::abs(r - 3) < 0.01 || std::abs(r - 1) < 0.01 || std::abs(std::abs(p.z) - 2) < 1e-9) continue;
      const bool inside = r < 3 && r > 1 && std::abs(p.z) < 2;
      ASSERT_EQ(point_in_solid(coarse.tree, t * p), inside);
      ASSERT_EQ(point_in_solid(slivers.tree, t * p), inside);
    }
  }
}

TEST(PointInSolid, DecidesPointsThatRaysLeaveThroughVerticesAndEdges) {
  const Solid box(scenes::box({0, 0, 0}, {2, 2, 2}));
  for (int i = -2; i <= 10; ++i)
    for (int j = -2; j <= 10; ++j) {
      const Vec3 p{0.25 * i, 0.25 * j, 1};
      if (i == 0 || j == 0 || i == 8 || j == 8) continue;
      ASSERT_EQ(point_in_solid(box.tree, p), i > 0 && i < 8 && j > 0 && j < 8);
    }
}

}  // namespace
}  // namespace dismantle
