// SPDX-License-Identifier: Apache-2.0
// Components that overlap in the assembled state keep their allowance until they have been apart.
#include "tests/certificates/grabbed_component.h"
#include "tests/support/depth_oracle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

using namespace grabbed;

/// A block that is 0.2 mm deep in a floor.
Assembly sunken_block() {
  return scenes::assembly({scenes::component("block", scenes::box({0, 0, -0.2}, {5, 5, 5})),
                           scenes::component("floor", scenes::box({-20, -20, -5}, {20, 20, 0}))});
}

TEST(PairParting, EndsAnAllowanceWhereTwoAreApartAtTheEndOfAStepOnly) {
  const Assembly assembly = sunken_block();
  const PairStates states = states_of(assembly);
  for (const ResponseKind response : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide}) {
    SCOPED_TRACE(static_cast<int>(response));
    Grabbed block(assembly, states, 0);
    EXPECT_TRUE(block.engine.step({{0, 0, 0.25}, {}}, response).reached);
    EXPECT_TRUE(block.engine.overlapping_pairs().empty());
    EXPECT_FALSE(block.engine.step({}, response).reached);
    EXPECT_GE(block.engine.poses()[0].position.z, 0.2 - kTolerance);
  }
}

TEST(PairParting, KeepsAnAllowanceAsLongAsTwoOverlap) {
  const Assembly assembly = sunken_block();
  const PairStates states = states_of(assembly);
  Grabbed block(assembly, states, 0);
  EXPECT_TRUE(block.engine.step({{2, 0, 0.15}, {}}, ResponseKind::Slide).reached);
  EXPECT_EQ(block.engine.overlapping_pairs().size(), 1u);
  EXPECT_TRUE(block.engine.step({}, ResponseKind::Slide).reached);
}

TEST(PairParting, KeepsTheAllowanceOfAPartInsideAnother) {
  // Nowhere near the surface that it is inside of, and 1 mm deep.
  const Assembly assembly = scenes::assembly({scenes::component("part", scenes::box({-1, -1, -2}, {1, 1, -1})),
                                              scenes::component("block", scenes::box({-20, -20, -20}, {20, 20, 0}))});
  const PairStates states = states_of(assembly);
  const double start = states.pairs.at(0).depth;
  for (const ResponseKind response : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide}) {
    SCOPED_TRACE(static_cast<int>(response));
    Grabbed deeper(assembly, states, 0), out(assembly, states, 0);
    for (int k = 1; k <= 3; ++k) {
      const Pose pose = deeper.engine.step({{0, 0, -0.1 * k}, {}}, response).pose;
      const TriangleMesh part = scenes::moved(*assembly.components[0].mesh, pose);
      EXPECT_LE(oracle::sampled_depth(part, *assembly.components[1].mesh, 0.5).depth, start + kTolerance);
      out.engine.step({{0, 0, 0.2 * k}, {}}, response);
      EXPECT_EQ(out.engine.overlapping_pairs().size(), 1u);
    }
  }
}

TEST(PairParting, KeepsTheAllowanceOfAPartInsideAnotherAfterAJump) {
  const Assembly assembly = scenes::assembly({scenes::component("part", scenes::box({-1, -1, -2}, {1, 1, -1})),
                                              scenes::component("block", scenes::box({-20, -20, -20}, {20, 20, 0}))});
  const PairStates states = states_of(assembly);
  Grabbed part(assembly, states, 0);
  part.engine.jump(std::vector<Pose>{{{0.5, 0, 0}, {}}, {}});
  EXPECT_EQ(part.engine.overlapping_pairs().size(), 1u);
  const ComponentId id(0);
  part.engine.grab({&id, 1});
  const Pose pose = part.engine.step({{0.5, 0, -1}, {}}, ResponseKind::Touch).pose;
  EXPECT_GE(pose.position.z, -kTolerance);
}

/// Two rods, for which there are no ghosts; the first parts from the other one at x = -1.8.
Assembly crossing_rods() {
  const TriangleMesh rod = scenes::tube(1, 0, -10, 10, 12);
  return scenes::assembly(
      {scenes::component("rod", rod),
       scenes::component("across", scenes::moved(rod, {{0.2, 0, 0}, quat_about({1, 0, 0}, kTurn / 4)}))});
}

/// The audit ends an allowance where two components are a tenth of the tolerance apart, so the engine must, too.
TEST(PairParting, EndsTheAllowanceOfRodsWithoutGhostsThatAreHardlyApart) {
  const Assembly assembly = crossing_rods();
  const PairStates states = states_of(assembly);
  for (const ResponseKind response : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide}) {
    Grabbed moving(assembly, states, 0);
    ASSERT_TRUE(moving.engine.step({{-1.8 - 0.3 * kTolerance, 0, 0}, {}}, response).reached);
    EXPECT_TRUE(moving.engine.overlapping_pairs().empty());
    moving.engine.step({}, response);
    EXPECT_LE(moving.engine.poses()[0].position.x, -1.8 + kTolerance);
  }
}

/// The ghost of a foil may be on the far side of what the foil touches, but no ghost of a thick block gets past its
/// middle.
TEST(PairParting, EndsTheAllowanceOfAFoilThatIsHardlyOffItsBlock) {
  const double depth = 4 * kTolerance;
  const Assembly assembly =
      scenes::assembly({scenes::component("foil", scenes::box({-5, -5, -depth}, {5, 5, kTolerance})),
                        scenes::component("block", scenes::box({-20, -20, -5}, {20, 20, 0}))});
  const PairStates states = states_of(assembly);
  for (const ResponseKind response : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide}) {
    Grabbed foil(assembly, states, 0);
    EXPECT_EQ(foil.engine.overlapping_pairs().size(), 1u);
    ASSERT_TRUE(foil.engine.step({{0, 0, depth + 0.3 * kTolerance}, {}}, response).reached);
    EXPECT_TRUE(foil.engine.overlapping_pairs().empty());
    foil.engine.step({}, response);
    EXPECT_GE(foil.engine.poses()[0].position.z, depth - kTolerance);
  }
}

/// Rods without ghosts: they part across both axes, and have the tolerance from then on.
TEST(PairParting, LetsRodsThatCrossPartAndNotCrossAgain) {
  const Assembly assembly = crossing_rods();
  const PairStates states = states_of(assembly);
  for (const ResponseKind response : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide}) {
    Grabbed moving(assembly, states, 0);
    EXPECT_EQ(moving.engine.overlapping_pairs().size(), 1u);
    for (const double x : {-0.5, -1.0, -1.7}) {
      EXPECT_TRUE(moving.engine.step({{x, 0, 0}, {}}, response).reached) << x;
      EXPECT_EQ(moving.engine.overlapping_pairs().size(), 1u) << x;
    }
    EXPECT_TRUE(moving.engine.step({{-3, 0, 0}, {}}, response).reached);
    EXPECT_TRUE(moving.engine.overlapping_pairs().empty());
    EXPECT_LE(moving.engine.step({}, response).pose.position.x, -1.8 + kTolerance);
  }
}

TEST(PairParting, LetsFacetsOfAHingeMeetAgainAfterATurn) {
  // In phase the facets are 0.005 mm apart, and meet after half a facet.
  const Assembly assembly = scenes::assembly({scenes::component("pin", scenes::tube(4.995, 0, -2, 12, 16)),
                                              scenes::component("eye", scenes::tube(8, 5, 0, 10, 16))});
  const PairStates states = states_of(assembly);
  Grabbed pin(assembly, states, 0);
  for (int k = 1; k <= 40; ++k)
    EXPECT_TRUE(pin.engine.step({{}, quat_about({0, 0, 1}, 0.05 * k)}, ResponseKind::Slide).reached) << k;
}

/// A tube of which every fourth corner is on a chord of its circles instead: a half of the facets are pairs in a plane.
TriangleMesh with_facets_in_pairs(double outer, double inner, double z0, double z1, std::uint32_t sides) {
  TriangleMesh mesh = scenes::tube(outer, inner, z0, z1, 2 * sides);
  const double across = kTurn / (2 * sides);
  for (Vec3& p : mesh.vertices) {
    const double radius = std::hypot(p.x, p.y);
    if (radius == 0 || static_cast<long>(std::lround(std::atan2(p.y, p.x) / across)) % 4 != 1) continue;
    p.x *= std::cos(across);
    p.y *= std::cos(across);
  }
  return mesh;
}

TEST(PairParting, LetsHingesTurnWhoseFacetsAreDivided) {
  for (const std::uint32_t sides : {16u, 17u, 31u})
    for (const double phase : {0.0, 0.05, 0.1}) {
      const TriangleMesh eye = with_facets_in_pairs(8, 5, 0, 10, 24);
      const Assembly assembly =
          scenes::assembly({scenes::component("pin", with_facets_in_pairs(5.005, 0, -2, 12, sides)),
                            scenes::component("eye", scenes::moved(eye, {{}, quat_about({0, 0, 1}, phase)}))});
      const PairStates states = states_of(assembly);
      Grabbed pin(assembly, states, 0);
      for (int k = 1; k <= 63; ++k)
        ASSERT_TRUE(pin.engine.step({{}, quat_about({0, 0, 1}, 0.1 * k)}, ResponseKind::Stop).reached)
            << sides << " sides, phase " << phase << ", step " << k;
    }
}

}  // namespace
}  // namespace dismantle
