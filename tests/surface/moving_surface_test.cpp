// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/moving_surface.h"

#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

/// One component at rest.
struct Solid {
  AssemblyTriangles triangles;
  std::vector<Kdop16> bounds;
  explicit Solid(TriangleMesh mesh)
      : triangles(make_assembly_triangles(scenes::assembly({scenes::component("solid", std::move(mesh))}), {})),
        bounds(bounds_at(triangles, triangles.vertices, 0, {})) {}
  MomentaryTriangles now() const {
    return {&triangles, {triangles.vertices, triangles.vertices, triangles.faces}, bounds, 0};
  }
  bool holds(Vec3 p) const { return point_in_component(now(), p, ComponentId(0)); }
};

TEST(PointInComponent, TellsInsideFromOutsideOfATurnedTube) {
  std::mt19937_64 random(4);
  const Pose pose = scenes::random_pose(random, 5, 3);
  const Solid tube(scenes::moved(scenes::tube(3, 1, -2, 2, 64, 5), pose));
  const RigidTransform t = transform_from_pose(pose);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = scenes::random_vector(random, 4);
    const double r = std::hypot(p.x, p.y);
    if (std::abs(r - 3) < 0.01 || std::abs(r - 1) < 0.01 || std::abs(std::abs(p.z) - 2) < 1e-9) continue;
    ASSERT_EQ(tube.holds(t * p), r < 3 && r > 1 && std::abs(p.z) < 2);
  }
}

TEST(PointInComponent, DecidesPointsThatRaysLeaveThroughVerticesAndEdges) {
  const Solid box(scenes::box({0, 0, 0}, {2, 2, 2}));
  for (int i = -2; i <= 10; ++i) {
    for (int j = -2; j <= 10; ++j) {
      const Vec3 p{0.25 * i, 0.25 * j, 1};
      if (i == 0 || j == 0 || i == 8 || j == 8) continue;
      ASSERT_EQ(box.holds(p), i > 0 && i < 8 && j > 0 && j < 8);
    }
  }
}

TEST(SurfaceWithin, AgreesWithTheDistanceToABox) {
  const Solid box(scenes::box({0, 0, 0}, {2, 2, 2}));
  const auto within = [&](Vec3 p, double d) { return surface_within(box.now(), p, ComponentId(0), d); };
  EXPECT_TRUE(within({1, 1, 2.5}, 0.51));
  EXPECT_FALSE(within({1, 1, 2.5}, 0.49));
  EXPECT_TRUE(within({1, 1, 1}, 1.01));
  EXPECT_FALSE(within({1, 1, 1}, 0.99));
  EXPECT_TRUE(within({3, 3, 3}, 1.7321));
  EXPECT_FALSE(within({3, 3, 3}, 1.7320));
}

}  // namespace
}  // namespace dismantle
