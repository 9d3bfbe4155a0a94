// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/assembly_scene.h"

#include "dismantle/geometry/adjacency.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Assembly two_boxes() {
  return scenes::assembly({scenes::component("left", scenes::box({0, 0, 0}, {2, 2, 2})),
                           scenes::component("right", scenes::box({4, 0, 0}, {6, 2, 2}))});
}

TEST(MakeScene, KeepsTheComponentsOrderAndSharesTheMeshesOfInstances) {
  Assembly assembly = two_boxes();
  assembly.components[1].mesh = assembly.components[0].mesh;
  assembly.components[1].assembly_from_mesh.translation = {4, 0, 0};
  const RenderScene scene = make_scene(assembly);
  ASSERT_EQ(scene.items.size(), 2u);
  EXPECT_EQ(scene.items[0].mesh, scene.items[1].mesh);
  EXPECT_EQ(scene.items[1].world_from_mesh.translation, (Vec3{4, 0, 0}));
  EXPECT_TRUE(scene.items[0].closed);
}

TEST(MakeScene, PlacesComponentsAtTheirPoses) {
  AssemblySceneOptions options;
  options.poses = {{}, {{0, 7, 0}, {}}};
  const RenderScene scene = make_scene(two_boxes(), options);
  EXPECT_EQ(scene.items[0].world_from_mesh.translation, Vec3{});
  EXPECT_EQ(scene.items[1].world_from_mesh.translation, (Vec3{0, 7, 0}));
}

TEST(MakeScene, ExplodesAwayFromTheMiddle) {
  const RenderScene scene = make_scene(two_boxes(), {.explode = 0.5});
  EXPECT_EQ(scene.items[0].world_from_mesh.translation, (Vec3{-1, 0, 0}));
  EXPECT_EQ(scene.items[1].world_from_mesh.translation, (Vec3{1, 0, 0}));
}

TEST(MakeScene, GivesColorsOnlyToComponentsWithoutOne) {
  Assembly assembly = two_boxes();
  EXPECT_NE(make_scene(assembly).items[0].color, make_scene(assembly).items[1].color);
  assembly.components[1].color = {1, 0, 0};
  EXPECT_EQ(make_scene(assembly).items[0].color, Color{});
  EXPECT_EQ(make_scene(assembly).items[1].color, (Color{1, 0, 0}));
}

TEST(MakeArrow, IsClosedAndReachesFromOneEndToTheOther) {
  const RenderItem arrow = make_arrow({1, 2, 3}, {4, 6, 3}, 0.1, {});
  EXPECT_EQ(edge_faults(arrow.mesh->mesh).boundary, 0u);
  EXPECT_GT(signed_volume(arrow.mesh->mesh), 0);
  const std::vector<Vec3> points = item_points(Span<const RenderItem>(&arrow, 1));
  double nearest_to_tip = 1e9;
  for (const Vec3& p : points) nearest_to_tip = std::min(nearest_to_tip, length(p - Vec3{4, 6, 3}));
  EXPECT_NEAR(nearest_to_tip, 0, 1e-9);
}

}  // namespace
}  // namespace dismantle
