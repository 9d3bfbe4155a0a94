// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/bvh_refit.h"

#include "dismantle/bvh/bvh_validate.h"
#include "dismantle/surface/assembly_triangles.h"
#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

/// True if the point's projections lie within the bounds; rounding of the projections in double is far below the
/// outward rounding of the bounds.
bool holds(const Kdop16& k, Vec3 p) {
  const double along[8] = {p.x, p.y, p.z, p.x + p.y, p.x + p.z, p.y + p.z, p.x - p.y, p.x - p.z};
  for (int i = 0; i < 8; ++i)
    if (along[i] < k.lower[i] || along[i] > k.upper[i]) return false;
  return true;
}

struct Step {
  AssemblyTriangles streams;
  std::vector<Vec3> end;
  BvhRefitInput input(double margin = 0) const { return {streams.vertices, end, streams.faces, margin}; }
};

Step random_step(unsigned seed) {
  std::mt19937_64 random(seed);
  Step step{make_assembly_triangles(scenes::random_assembly(random, 9, 6), {}), {}};
  step.end = step.streams.vertices;
  for (std::uint32_t c = 0; c < step.streams.component_count(); ++c) {
    const RigidTransform t = transform_from_pose(scenes::random_pose(random, 2, 1));
    for (std::uint32_t v = step.streams.vertex_begin[c]; v < step.streams.vertex_begin[c + 1]; ++v)
      step.end[v] = t * step.end[v];
  }
  return step;
}

TEST(BvhRefit, BoundsContainEveryVertexAllAlongItsPath) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    const Step step = random_step(seed);
    const Bvh& bvh = step.streams.bvh;
    const std::vector<Kdop16> bounds = bvh_fit(bvh, step.streams.refit_plan, step.input(), {});
    EXPECT_EQ(bvh_validate(bvh, bounds), "");
    for (NodeIndex leaf = 0; leaf < bvh.leaf_count(); ++leaf) {
      for (const std::uint32_t v : step.streams.faces[leaf].v) {
        for (const double s : {0.0, 0.3, 1.0}) {
          const Vec3 p = (1 - s) * step.streams.vertices[v] + s * step.end[v];
          ASSERT_TRUE(holds(bounds[leaf], p));
          ASSERT_TRUE(holds(bounds[bvh.components[bvh.component_of[leaf]].root], p));
          ASSERT_TRUE(holds(bounds[bvh.root()], p));
        }
      }
    }
  }
}

TEST(BvhRefit, OfSomeComponentsEqualsTheRefitOfAll) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Step step = random_step(seed);
    const Bvh& bvh = step.streams.bvh;
    std::vector<Kdop16> bounds = bvh_fit(bvh, step.streams.refit_plan, step.input(), {});
    const std::vector<ComponentId> some{ComponentId(1), ComponentId(4), ComponentId(5)};
    for (const ComponentId c : some)
      for (std::uint32_t v = step.streams.vertex_begin[c.value]; v < step.streams.vertex_begin[c.value + 1]; ++v)
        step.end[v] += Vec3{1, 2, 3};
    bvh_refit(bvh, step.streams.refit_plan, step.input(), some, bounds, {});
    EXPECT_EQ(bounds, bvh_fit(bvh, step.streams.refit_plan, step.input(), {}));
  }
}

TEST(BvhRefit, IsTheSameOnEveryExecutorAndAcrossBlocks) {
  const AssemblyTriangles streams =
      make_assembly_triangles(scenes::assembly({scenes::component("a", scenes::tube(10, 5, 0, 20, 100, 50)),
                                                scenes::component("b", scenes::tube(4, 3, 0, 20, 64, 20))}),
                              {});
  EXPECT_GT(streams.refit_plan.blocks.size(), 10u);
  EXPECT_GT(streams.refit_plan.rest.size(), 10u);
  const std::vector<Kdop16> expected = bounds_at(streams, streams.vertices, 0.5, {});
  EXPECT_EQ(bvh_validate(streams.bvh, expected), "");
  for (const Executor& executor : all_executors())
    EXPECT_EQ(bounds_at(streams, streams.vertices, 0.5, executor), expected);
}

TEST(BvhRefit, TakesOneTriangle) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.faces = {{{0, 1, 2}}};
  const AssemblyTriangles streams = make_assembly_triangles(scenes::assembly({scenes::component("t", mesh)}), {});
  EXPECT_EQ(bvh_validate(streams.bvh, bounds_at(streams, streams.vertices, 0, {})), "");
}

}  // namespace
}  // namespace dismantle
