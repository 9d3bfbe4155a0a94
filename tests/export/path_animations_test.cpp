// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/path_animations.h"

#include "tests/export/export_scene.h"
#include "tests/support/check_glb.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

struct Animated {
  Assembly assembly = scenes::knob_on_block();
  Timeline timeline = scenes::timeline_of(assembly, scenes::knob_path());
  CheckedGlb glb{bytes({path_animations(timeline), {}})};

  std::string bytes(const std::pair<std::vector<GlbAnimation>, std::vector<Pose>>& what) const {
    GlbOptions options;
    options.animations = what.first;
    options.poses = what.second;
    const Result<std::string> made = glb_from_assembly(assembly, options);
    EXPECT_TRUE(made.ok());
    return *made;
  }
};

/// The node's position [mm] and rotation at the key nearest to a time.
RigidTransform at(const CheckedGlb& glb, const nlohmann::json& animation, const std::string& component, double time) {
  const std::size_t node = glb.node_of(component);
  const auto [times, places] = glb.keys(animation, node, "translation");
  const std::vector<float> turns = glb.keys(animation, node, "rotation").second;
  EXPECT_FALSE(times.empty()) << component;
  if (times.empty()) return {};
  const auto nearest = std::min_element(times.begin(), times.end(), [time](float a, float b) {
    return std::abs(static_cast<double>(a) - time) < std::abs(static_cast<double>(b) - time);
  });
  const auto k = static_cast<std::size_t>(nearest - times.begin());
  const auto d = [](float value) { return static_cast<double>(value); };
  return {mat3_from_quat({d(turns[4 * k + 3]), d(turns[4 * k]), d(turns[4 * k + 1]), d(turns[4 * k + 2])}),
          1e3 * Vec3{d(places[3 * k]), d(places[3 * k + 1]), d(places[3 * k + 2])}};
}

void expect_near(const RigidTransform& a, const RigidTransform& b) {
  // Rounding of floats: 2^-24 of 0.2 m, and of a rotation at 100 mm.
  for (const Vec3& p : {Vec3{}, Vec3{100, 0, 0}, Vec3{0, 100, 0}}) EXPECT_LT(length(a * p - b * p), 5e-5);
}

TEST(PathAnimations, MakeAValidFile) {
  const Animated made;
  EXPECT_EQ(made.glb.faults(), std::vector<std::string>{});
  const std::vector<Pose> ends = made.timeline.poses_at(made.timeline.end(), 3);
  const CheckedGlb other(made.bytes({path_animations(made.timeline, PathDirection::Reversed), ends}));
  EXPECT_EQ(other.faults(), std::vector<std::string>{});
}

TEST(PathAnimations, AreOneForTheWholePathAndOnePerMoveInBothDirections) {
  const Animated made;
  std::vector<std::string> names;
  for (const auto& animation : made.glb.json()["animations"]) names.push_back(animation["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"all", "all, reversed", "1 screw off knob", "1 screw off knob, reversed",
                                             "2 knob aside", "2 knob aside, reversed", "3 block aside",
                                             "3 block aside, reversed"}));
  EXPECT_EQ(path_animations(made.timeline, PathDirection::Reversed)[0].name, "all, reversed");
}

TEST(PathAnimations, HaveTheFramesOfThePathAsKeys) {
  const Animated made;
  const auto& animations = made.glb.json()["animations"];
  std::size_t number = 0;
  for (const TimelineMove& move : made.timeline.moves()) {
    for (const ComponentId c : move.components) {
      const Component& component = made.assembly[c];
      for (const Frame& frame : move.frames) {
        const RigidTransform truth = transform_from_pose(frame.pose) * component.assembly_from_mesh;
        expect_near(at(made.glb, animations[0], component.name, move.start + frame.time), truth);
        expect_near(at(made.glb, animations[1], component.name, made.timeline.duration() - move.start - frame.time),
                    truth);
        expect_near(at(made.glb, animations[2 + 2 * number], component.name, frame.time), truth);
        expect_near(at(made.glb, animations[3 + 2 * number], component.name, move.duration() - frame.time), truth);
      }
    }
    ++number;
  }
}

TEST(PathAnimations, DoNotMoveOtherComponents) {
  const Animated made;
  const auto& animations = made.glb.json()["animations"];
  const Pose aside = made.timeline.moves()[1].frames.back().pose;
  const RigidTransform knob = transform_from_pose(aside) * made.assembly.components[2].assembly_from_mesh;
  expect_near(at(made.glb, animations[6], "knob", 0), knob);
  expect_near(at(made.glb, animations[6], "knob", 2), knob);
  const auto plate = made.glb.keys(animations[6], made.glb.node_of("plate"), "translation");
  EXPECT_TRUE(plate.first.empty()) << "components that never move have no channel";
  const auto block = made.glb.keys(animations[2], made.glb.node_of("block"), "translation");
  EXPECT_TRUE(block.first.empty()) << "it is the node's own pose";
}

TEST(PathAnimations, KeepInstancesShared) {
  Assembly a = scenes::knob_on_block();
  a.components.push_back(a.components[2]);
  a.components[3].name = "knob#2";
  a.components[3].assembly_from_mesh.translation.x += 12;
  GlbOptions options;
  options.animations = path_animations(scenes::timeline_of(a, scenes::knob_path()));
  const CheckedGlb glb(*glb_from_assembly(a, options));
  EXPECT_EQ(glb.faults(), std::vector<std::string>{});
  EXPECT_EQ(glb.json()["meshes"].size(), 3u);
  EXPECT_EQ(glb.json()["nodes"][glb.node_of("knob")]["mesh"], glb.json()["nodes"][glb.node_of("knob#2")]["mesh"]);
}

TEST(PathAnimations, AreNoneWithoutMoves) {
  EXPECT_TRUE(path_animations(Timeline{}).empty());
}

TEST(PathAnimations, StopWhenCancelled) {
  const Animated made;
  GlbOptions options;
  options.animations = path_animations(made.timeline);
  int calls = 0;
  options.progress = [&calls](std::string_view, double) { return ++calls < 3; };
  const Result<std::string> glb = glb_from_assembly(made.assembly, options);
  ASSERT_FALSE(glb.ok());
  EXPECT_EQ(glb.error().kind, ErrorKind::Failed);
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace dismantle
