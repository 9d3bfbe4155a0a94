// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/assembly_triangles.h"

#include "dismantle/bvh/bvh_validate.h"
#include "dismantle/geometry/adjacency.h"
#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(AssemblyTriangles, ContainEveryTriangleOfEveryComponentInTheAssembledPose) {
  std::mt19937_64 random(1);
  Assembly assembly = scenes::random_assembly(random, 7, 5);
  assembly.components[3].assembly_from_mesh = transform_from_pose(scenes::random_pose(random, 10, 3));
  const AssemblyTriangles streams = make_assembly_triangles(assembly, {});
  EXPECT_EQ(bvh_validate(streams.bvh), "");
  ASSERT_EQ(streams.faces.size(), triangle_count(assembly));
  std::vector<std::vector<bool>> seen;
  for (const Component& c : assembly.components) seen.emplace_back(c.mesh->faces.size(), false);
  for (NodeIndex leaf = 0; leaf < streams.bvh.leaf_count(); ++leaf) {
    const std::uint32_t c = streams.bvh.component_of[leaf];
    const std::uint32_t f = streams.face_of[leaf].value;
    ASSERT_FALSE(seen[c][f]);
    seen[c][f] = true;
    const Triangle expected = assembled_mesh(assembly.components[c]).triangle(f);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = streams.faces[leaf].v[k];
      ASSERT_GE(v, streams.vertex_begin[c]);
      ASSERT_LT(v, streams.vertex_begin[c + 1]);
      ASSERT_EQ(streams.vertices[v], expected[k]);
    }
    ASSERT_EQ(streams.features[leaf], representative_features(*assembly.components[c].mesh)[f]);
  }
}

TEST(AssemblyTriangles, AreTheSameOnEveryExecutor) {
  std::mt19937_64 random(2);
  const Assembly assembly = scenes::random_assembly(random, 20, 9);
  const AssemblyTriangles expected = make_assembly_triangles(assembly, {});
  for (const Executor& executor : all_executors()) {
    const AssemblyTriangles streams = make_assembly_triangles(assembly, executor);
    EXPECT_EQ(streams.vertices, expected.vertices);
    EXPECT_EQ(streams.faces, expected.faces);
    EXPECT_EQ(streams.face_of, expected.face_of);
    EXPECT_EQ(streams.features, expected.features);
    EXPECT_EQ(streams.bvh, expected.bvh);
  }
}

TEST(AssemblyTriangles, TakeAnEmptyAssemblyAndAnEmptyMesh) {
  EXPECT_EQ(make_assembly_triangles(scenes::assembly({}), {}).faces.size(), 0u);
  const AssemblyTriangles streams = make_assembly_triangles(
      scenes::assembly({scenes::component("none", {}), scenes::component("box", scenes::box({0, 0, 0}, {1, 1, 1}))}),
      {});
  EXPECT_EQ(bvh_validate(streams.bvh), "");
  EXPECT_EQ(streams.vertices_of(ComponentId(0)).size(), 0u);
  EXPECT_EQ(streams.vertices_of(ComponentId(1)).size(), 8u);
}

}  // namespace
}  // namespace dismantle
