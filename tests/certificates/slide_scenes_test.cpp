// SPDX-License-Identifier: Apache-2.0
#include "tests/support/slide_scenes.h"

#include "dismantle/engine/classify_pairs.h"
#include "tests/support/large_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using namespace scenes;

/// Expects closed meshes, oriented outwards, without degenerate triangles; and the pair's state.
void expect_sound(const SlideScene& scene, PairState state, double depth = 0) {
  for (const Component& c : scene.assembly.components) {
    EXPECT_EQ(c.faults, MeshFaults{}) << c.name;
    EXPECT_GT(signed_volume(*c.mesh), 0) << c.name;
  }
  ClassifyOptions options;
  options.tolerance = 5e-4;
  const Result<PairStates> states = classify_pairs(scene.assembly, options);
  ASSERT_TRUE(states.ok());
  const ComponentPair* pair = states->find(ComponentId(0), scene.moving);
  EXPECT_EQ(pair ? pair->state : PairState::Clear, state);
  if (depth > 0) {
    ASSERT_NE(pair, nullptr);
    EXPECT_GT(pair->depth, 0.5 * depth);
    EXPECT_LT(pair->depth, 1.5 * depth);
  }
}

TEST(SlideScenes, HaveValidMeshesAtEveryClearance) {
  for (const double clearance : {0.0, 0.001, 0.05}) {
    const PairState state = clearance > 0 ? PairState::Clear : PairState::Contact;
    for (const std::uint32_t sides : {24u, 64u, 256u}) expect_sound(peg_in_hole(sides, clearance), PairState::Contact);
    expect_sound(key_in_slot(clearance, {0, 1, 0}), state);
    expect_sound(dovetail(clearance), state);
  }
  expect_sound(part_in_corner(), PairState::Contact);
  expect_sound(plate_in_slot(0.0004), PairState::Contact);
  expect_sound(press_fit_pin(64, 0.02), PairState::Overlapping, 0.02);
}

TEST(SlideScenes, HaveGearsThatMeshWhereverTheyHaveRolled) {
  for (const std::size_t triangles : {2000u, 20000u}) {
    const GearPair pair = large_gear_pair(triangles, 0.1);
    SlideScene scene = meshing_gears(pair);
    expect_sound(scene, PairState::Clear);
    // The rim's fans do not overlap: the triangles of an end face add up to its area.
    const TriangleMesh mesh = gear_mesh(pair.moving);
    double up = 0, all = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const Triangle t = mesh.triangle(f);
      const Vec3 area = cross(t[1] - t[0], t[2] - t[0]);
      if (t[0].z == pair.moving.width && t[1].z == t[0].z && t[2].z == t[0].z) up += area.z, all += std::abs(area.z);
    }
    EXPECT_NEAR(up, all, 1e-9 * all);
    for (int k = 1; k < 8; ++k) {
      SlideScene rolled = meshing_gears(pair);
      Component& pinion = rolled.assembly.components[1];
      pinion = component("pinion", moved(*pinion.mesh, pair.rolled(0.03 * k)));
      expect_sound(rolled, PairState::Clear);
    }
  }
}

TEST(SlideScenes, HaveThreadsThatStayClearWhileTheyAreUnscrewed) {
  for (const std::size_t triangles : {10000u, 60000u}) {
    for (const double degrees : {0.0, 1.8, 45.0, 400.0}) {
      SlideScene scene = bolt_in_nut(triangles, 0.05);
      Component& bolt = scene.assembly.components[1];
      bolt = component("bolt", moved(*bolt.mesh, unscrewed(degrees * kTurn / 360)));
      expect_sound(scene, PairState::Clear);
    }
  }
}

TEST(SlideScenes, HaveAboutTheRequestedNumberOfTriangles) {
  for (const std::size_t triangles : {10000u, 100000u}) {
    const std::vector<SlideScene> all = {shaft_in_hole(triangles, 0.1), ring_on_torus(triangles, 0.1),
                                         sliver_peg(triangles, 0.1), bolt_in_nut(triangles, 0.05),
                                         meshing_gears(large_gear_pair(triangles, 0.1))};
    for (const SlideScene& scene : all) {
      const auto count = static_cast<double>(triangle_count(scene.assembly));
      EXPECT_GT(count, 0.8 * static_cast<double>(triangles)) << scene.assembly.components[1].name;
      EXPECT_LT(count, 1.25 * static_cast<double>(triangles)) << scene.assembly.components[1].name;
      for (const Component& c : scene.assembly.components) EXPECT_EQ(c.faults, MeshFaults{}) << c.name;
    }
  }
  expect_sound(shaft_in_hole(10000, 0.02), PairState::Clear);
  expect_sound(shaft_in_hole(10000, 0), PairState::Contact);
  expect_sound(ring_on_torus(10000, 0.1), PairState::Clear);
}

TEST(Hand, HasTremorWithinItsLimitsAndIsDeterministic) {
  const SlideScene scene = peg_in_hole(24, 0.01);
  Hand hand(scene, {}), same(scene, {}), other(scene, {0.5, 0.3, 0.06, 2});
  for (int k = 1; k <= 20; ++k) {
    const Pose target = hand.next();
    EXPECT_EQ(target, same.next());
    EXPECT_NE(target, other.next());
    EXPECT_NEAR(distance_moved(scene, target), 0.5 * k, 0.3 + 1e-9);
    const double angle = 2 * std::acos(std::min(1.0, std::abs(target.rotation.w)));
    EXPECT_LE(angle, 0.06 + 1e-9);
  }
}

}  // namespace
}  // namespace dismantle
