// SPDX-License-Identifier: Apache-2.0
// Cylinders and threads whose clearance is many tolerances wide, pressed against each other: what is proven about whole
// cylinders and whole turns of a thread lets nothing get deeper than the tolerance.
#include "tests/certificates/grabbed_component.h"
#include "tests/support/large_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

constexpr double kFine = 0.001;
/// So many that facets are off their circles by less than the tolerance.
constexpr std::uint32_t kSides = 400;

PairStates fine_states_of(const Assembly& assembly) {
  ClassifyOptions classify;
  classify.tolerance = kFine;
  return *classify_pairs(assembly, classify);
}

/// Moves the first component towards a pose in steps that are shorter than the tolerance, so that the last free one
/// ends next to the contact. @return its depth in the second one [mm]
double depth_pressed(const Assembly& assembly, const Pose& to) {
  constexpr int kSteps = 60;
  grabbed::Grabbed first(assembly, fine_states_of(assembly), 0);
  Pose pose;
  for (int k = 1; k <= kSteps; ++k)
    pose = first.engine.step(pose_between({}, to, static_cast<double>(k) / kSteps), ResponseKind::Touch).pose;
  const Component pressed = scenes::component("pressed", scenes::moved(*assembly.components[0].mesh, pose));
  const PairStates states = fine_states_of(scenes::assembly({pressed, assembly.components[1]}));
  return states.pairs.empty() ? 0 : states.pairs[0].depth;
}

TEST(CloseFits, APinIsPressedNoDeeperIntoItsBoreThanTheTolerance) {
  const Assembly assembly = scenes::assembly({scenes::component("pin", scenes::tube(4.99, 0, -2, 12, kSides)),
                                              scenes::component("eye", scenes::tube(8, 5, 0, 10, kSides))});
  double deepest = 0;
  for (const double angle : {0.0, 0.03, 0.07, 1.0, 2.5}) {
    const Vec3 aside{std::cos(angle), std::sin(angle), 0};
    deepest = std::max(deepest, depth_pressed(assembly, {0.03 * aside, {}}));
    deepest = std::max(deepest, depth_pressed(assembly, {{}, quat_about(aside, 0.004)}));
    deepest = std::max(deepest, depth_pressed(assembly, {0.03 * aside + Vec3{0, 0, 0.01}, quat_about(aside, 0.002)}));
  }
  EXPECT_LE(deepest, kFine);
  EXPECT_GE(deepest, 0.3 * kFine) << "pressed against the bore";
}

TEST(CloseFits, ANutIsPressedNoDeeperIntoItsThreadThanTheTolerance) {
  scenes::Winding bolt = scenes::thread(0, 2), nut = scenes::thread(0.04, 2);
  bolt.sides = nut.sides = 128;
  bolt.turns = 4;
  bolt.start = -bolt.pitch;
  nut.turns = 2;
  const Assembly assembly = scenes::assembly(
      {scenes::component("nut", scenes::wound_hole(nut, 7)), scenes::component("bolt", scenes::wound_solid(bolt))});
  double deepest = 0;
  for (const Vec3 way : {Vec3{0, 0, 0.05}, Vec3{0, 0, -0.05}, Vec3{0.05, 0, 0}, Vec3{-0.03, 0.04, 0}}) {
    deepest = std::max(deepest, depth_pressed(assembly, {way, {}}));
    deepest = std::max(deepest, depth_pressed(assembly, {0.5 * way, quat_about({0, 1, 0}, 0.01)}));
  }
  deepest = std::max(deepest, depth_pressed(assembly, {{}, quat_about({0, 0, 1}, 0.3)}));
  EXPECT_LE(deepest, kFine);
  EXPECT_GE(deepest, 0.1 * kFine) << "pressed against the thread";
}

}  // namespace
}  // namespace dismantle
