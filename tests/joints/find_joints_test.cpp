// SPDX-License-Identifier: Apache-2.0
#include "dismantle/joints/find_joints.h"

#include "dismantle/fasteners/find_fasteners.h"
#include "tests/support/joint_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

std::vector<Joint> joints_of(const Assembly& assembly) {
  return find_joints(assembly, find_fasteners(assembly), Executor());
}

using Names = std::vector<std::string>;

Names names(const Assembly& assembly, const std::vector<ComponentId>& components) {
  Names found;
  for (const ComponentId c : components) found.push_back(assembly[c].name);
  return found;
}

TEST(FindJoints, ClampACoverBetweenTheHeadAndTheThread) {
  const Assembly a = scenes::covered_case();
  const std::vector<Joint> joints = joints_of(a);
  ASSERT_EQ(joints.size(), 4u);
  for (const Joint& joint : joints) {
    EXPECT_EQ(names(a, joint.held), (Names{"case", "cover"}));
    EXPECT_EQ(a[joint.thread_in].name, "case");
    EXPECT_TRUE(joint.has_head);
    EXPECT_NEAR(joint.axis.z, 1, 1e-9);
    // 16 mm of screw through a cover of 4 mm.
    EXPECT_NEAR(joint.screw_leaves.travel, 12, 0.6);
    EXPECT_NEAR(joint.screw_leaves.turns, 15, 0.8);
    EXPECT_EQ(joint.screw_leaves.pitch, 0.8);
    EXPECT_TRUE(joint.screw_leaves.nominal);
    EXPECT_FALSE(joint.screw_leaves.left_handed);
  }
}

TEST(FindJoints, KnowTheStackOfABolt) {
  const Assembly a = scenes::bolted_plates();
  const std::vector<Joint> joints = joints_of(a);
  ASSERT_EQ(joints.size(), 1u) << "the nut has no joint of its own";
  const Joint& joint = joints[0];
  EXPECT_EQ(a[joint.screw].name, "bolt");
  EXPECT_EQ(names(a, joint.stack()), (Names{"nut", "washer#2", "bolt", "washer"}));
  EXPECT_EQ(names(a, joint.held), (Names{"lower", "upper"}));
  EXPECT_EQ(a[joint.thread_in].name, "nut");
  // From the tip, 15 mm below the plates' middle, to the upper end of the nut.
  EXPECT_NEAR(joint.nut_leaves.travel, 10, 0.6);
}

TEST(FindJoints, CountTheInsertOfALockNutAsAPartOfIt) {
  const Assembly a = scenes::bolted_plates_with_lock_nut();
  const std::vector<Joint> joints = joints_of(a);
  ASSERT_EQ(joints.size(), 1u);
  EXPECT_EQ(names(a, joints[0].nuts), (Names{"nut"}));
  EXPECT_EQ(joints[0].nut_inserts, (std::vector<NutInsert>{{*a.find("ring"), *a.find("nut")}}));
  EXPECT_EQ(names(a, joints[0].stack()), (Names{"nut", "ring", "washer#2", "bolt", "washer"}));
  EXPECT_EQ(names(a, joints[0].held), (Names{"lower", "upper"}));
  EXPECT_EQ(a[joints[0].thread_in].name, "nut");
}

TEST(FindJoints, HoldWhatHangsFromScrewsWithTheirHeadsDown) {
  const Assembly a = scenes::hanging_plate();
  const std::vector<Joint> joints = joints_of(a);
  ASSERT_EQ(joints.size(), 6u);
  for (const Joint& joint : joints) {
    EXPECT_EQ(names(a, joint.held), (Names{"beam", "plate"}));
    EXPECT_EQ(a[joint.thread_in].name, "beam");
    EXPECT_NEAR(joint.axis.z, -1, 1e-9);
  }
}

TEST(FindJoints, AreTheSameInARotatedAssembly) {
  Assembly a = scenes::bolted_plates();
  const RigidTransform pose = transform_from_pose({{30, -20, 5}, quat_about(normalized(Vec3{1, 2, 3}), 0.7)});
  for (Component& c : a.components) c.assembly_from_mesh = pose * c.assembly_from_mesh;
  const std::vector<Joint> joints = joints_of(a);
  ASSERT_EQ(joints.size(), 1u);
  EXPECT_EQ(names(a, joints[0].stack()), (Names{"nut", "washer#2", "bolt", "washer"}));
  EXPECT_EQ(names(a, joints[0].held), (Names{"lower", "upper"}));
}

TEST(FindJoints, TakeTheHoleNearestToTheTipWhereAllAreWide) {
  Assembly a = scenes::covered_case();
  a.components[0] = scenes::component("case", scenes::joined({scenes::box({-20, -20, -4}, {20, 20, 0}),
                                                              scenes::four_hole_slab(scenes::kClear, 0, 20)}));
  for (const Joint& joint : joints_of(a)) EXPECT_EQ(a[joint.thread_in].name, "case");
}

TEST(FindJoints, HoldNothingWithAScrewThatIsInNoHole) {
  const Assembly a = scenes::assembly({scenes::component("screw", scenes::m5_screw(16)),
                                       scenes::component("block", scenes::box({3, -9, -9}, {9, 9, 9}))});
  EXPECT_TRUE(joints_of(a).empty());
}

TEST(FindJoints, HoldAPlateWithANutOnAStudOfAnotherPart) {
  const TriangleMesh stud = scenes::joined({scenes::box({-20, -20, -10}, {20, 20, 0}),
                                            scenes::turned({{0, scenes::circle(2.5)}, {14, scenes::circle(2.5)}})});
  const Assembly a =
      scenes::assembly({scenes::component("base", stud),
                        scenes::component("plate", scenes::bored(scenes::square(15), scenes::kClear, 0, 4)),
                        scenes::component("washer", scenes::bored(scenes::circle(5), 2.65, 4, 5)),
                        scenes::component("nut", scenes::bored(scenes::hexagon(8), scenes::kTapped, 5, 9.7))});
  const std::vector<Joint> joints = joints_of(a);
  ASSERT_EQ(joints.size(), 1u);
  EXPECT_FALSE(joints[0].screw.valid());
  EXPECT_EQ(names(a, joints[0].stack()), (Names{"nut", "washer"}));
  EXPECT_EQ(names(a, joints[0].held), (Names{"base", "plate"}));
  EXPECT_EQ(a[joints[0].thread_in].name, "base");
}

TEST(FindJoints, HoldAHubOnAShaftWithASetScrew) {
  const TriangleMesh shaft = scenes::turned({{-20, scenes::circle(6)}, {20, scenes::circle(6)}});
  const TriangleMesh hub = scenes::bored(scenes::square(10), scenes::kTapped, 6, 14);
  const Pose on_side{{}, quat_about({0, 1, 0}, kTurn / 4)};
  Fastener set_screw;
  set_screw.diameter = 5;
  set_screw.pitch = 0.8;
  set_screw.axis = {0, 0, 1};
  // Its tip is drawn into the shaft by 1 mm.
  const TriangleMesh rod = scenes::turned({{5, scenes::circle(2.5)}, {12, scenes::circle(2.5)}});
  const Assembly a = scenes::assembly({scenes::component("shaft", scenes::moved(shaft, on_side)),
                                       scenes::component("hub", hub), scenes::component("set screw", rod)});
  const std::vector<Joint> joints = find_joints(a, {std::nullopt, std::nullopt, set_screw}, Executor());
  ASSERT_EQ(joints.size(), 1u);
  EXPECT_FALSE(joints[0].has_head);
  EXPECT_EQ(names(a, joints[0].held), (Names{"shaft", "hub"}));
  EXPECT_EQ(a[joints[0].thread_in].name, "hub");
}

}  // namespace
}  // namespace dismantle
