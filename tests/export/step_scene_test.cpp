// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/step_scene.h"

#include "tests/export/export_scene.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

struct Steps {
  Assembly assembly = scenes::knob_on_block();
  Timeline timeline = scenes::timeline_of(assembly, scenes::knob_path());
};

TEST(StepScene, ShowsThePosesBeforeTheMove) {
  const Steps s;
  const RenderScene scene = step_scene(s.assembly, s.timeline, 1);
  const RigidTransform knob =
      transform_from_pose(s.timeline.moves()[1].frames.front().pose) * s.assembly.components[2].assembly_from_mesh;
  EXPECT_EQ(scene.items[2].world_from_mesh, knob);
  EXPECT_EQ(scene.items[1].world_from_mesh, s.assembly.components[1].assembly_from_mesh);
}

TEST(StepScene, MarksTheMovingComponentsAndTheirMotion) {
  const Steps s;
  const RenderScene scene = step_scene(s.assembly, s.timeline, 2);
  ASSERT_EQ(scene.items.size(), 5u) << "three components, a ghost and an arrow";
  EXPECT_FALSE(scene.items[1].color == s.assembly.components[1].color);
  EXPECT_LT(scene.items[3].color.a, 0.5f);
  EXPECT_EQ(scene.items[3].world_from_mesh.translation, (Vec3{0, 60, 0}));
  EXPECT_TRUE(scene.items[4].overlay);
  EXPECT_EQ(scene.items[4].world_from_mesh.translation, (Vec3{0, 0, 10})) << "the arrow begins at the centre";
}

TEST(StepScene, IsReversedForAssembly) {
  const Steps s;
  const RenderScene scene = step_scene(s.assembly, s.timeline, 0, PathDirection::Reversed);
  EXPECT_EQ(scene.items[1].world_from_mesh.translation, (Vec3{0, 60, 0}));
  EXPECT_EQ(scene.items[3].world_from_mesh.translation, Vec3{});
  const Pose aside = s.timeline.moves()[1].frames.back().pose;
  EXPECT_EQ(scene.items[2].world_from_mesh, transform_from_pose(aside) * s.assembly.components[2].assembly_from_mesh);
}

TEST(StepScene, HasNoArrowForAShortMotion) {
  const Assembly a = scenes::knob_on_block();
  Path path = scenes::knob_path();
  path.moves = {{"turn knob", {"knob"}, {{0, {}}, {1, {{0, 0, 0.5}, {}}}}}};
  EXPECT_EQ(step_scene(a, scenes::timeline_of(a, path), 0).items.size(), 4u);
}

}  // namespace
}  // namespace dismantle
