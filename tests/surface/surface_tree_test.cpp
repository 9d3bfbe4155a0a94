// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/surface_tree.h"

#include "dismantle/narrowphase/closest_points.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

TEST(SurfaceTree, FindsTheSameDistanceAsBruteForce) {
  const TriangleMesh mesh = scenes::tube(5, 3, -4, 9, 37, 5);
  const SurfaceTree tree(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-15, 15);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p{at(random), at(random), at(random)};
    double minimum = 1e300;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      minimum = std::min(minimum, length(p - closest_point_of_triangle(mesh.triangle(f), p)));
    const MeshDistance found = tree.distance(p);
    EXPECT_EQ(found.distance, minimum);
    EXPECT_EQ(tree.distance_to_face(p, found.face), minimum);
  }
}

}  // namespace
}  // namespace dismantle
