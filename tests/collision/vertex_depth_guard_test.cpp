// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/vertex_depth_guard.h"

#include "dismantle/collision/classify_pairs.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using scenes::component;
using scenes::tube;

constexpr double kTolerance = 0.01;

/// A pin 0.2 mm too thick for its bore, both finer than that: no triangle pair can be deeper than a triangle's size.
Assembly fine_press_fit() {
  return scenes::assembly(
      {component("pin", tube(2, 0, -1, 5, 100, 50)), component("bush", tube(4, 1.8, 0, 4, 100, 36))});
}

PairStates states_of(const Assembly& assembly) {
  ClassifyOptions options;
  options.tolerance = kTolerance;
  options.fit = 0.5;
  return *classify_pairs(assembly, options);
}

std::vector<RigidTransform> pin_at(Vec3 position) {
  return {{{}, position}, {}};
}

TEST(VertexDepthGuard, LetsAFinePressedPinOutAlongItsAxis) {
  const Assembly assembly = fine_press_fit();
  const PairStates states = states_of(assembly);
  ASSERT_EQ(states.pairs.at(0).state, PairState::Fit);
  VertexDepthGuard guard(assembly, states, Executor());
  ASSERT_FALSE(guard.watches_nothing());
  for (int k = 0; k < 12; ++k) {
    EXPECT_TRUE(guard.sweep(pin_at({0, 0, 0.5 * k}), pin_at({0, 0, 0.5 * (k + 1)})).empty()) << k;
    guard.commit();
  }
}

TEST(VertexDepthGuard, HoldsItBackFromTheWall) {
  const Assembly assembly = fine_press_fit();
  const PairStates states = states_of(assembly);
  VertexDepthGuard guard(assembly, states, Executor());
  const std::vector<CollisionContact> contacts = guard.sweep(pin_at({0, 0, 0}), pin_at({2, 0, 0}));
  ASSERT_FALSE(contacts.empty());
  // 0.2 mm deep at the start; twice the allowance is what the deepest vertex may have.
  const double limit = 2 * states.pairs[0].allowed_penetration;
  EXPECT_LE(2 * contacts[0].toi + 0.2, limit + 1e-3);
  EXPECT_GE(2 * contacts[0].toi + 0.2, limit - 0.01);
  EXPECT_EQ(contacts[0].a, ComponentId(0));
  EXPECT_EQ(contacts[0].b, ComponentId(1));
}

TEST(VertexDepthGuard, FindsADiveThatIsOverAtBothEnds) {
  const Assembly assembly = fine_press_fit();
  const PairStates states = states_of(assembly);
  VertexDepthGuard guard(assembly, states, Executor());
  // From beside the bush to its other side in one sweep.
  EXPECT_FALSE(guard.sweep(pin_at({-10, 0, 0}), pin_at({10, 0, 0})).empty());
  EXPECT_TRUE(guard.sweep(pin_at({-10, 0, 20}), pin_at({10, 0, 20})).empty());
}

TEST(VertexDepthGuard, KeepsSlacksOnlyOfCommittedSweeps) {
  const Assembly assembly = fine_press_fit();
  const PairStates states = states_of(assembly);
  VertexDepthGuard guard(assembly, states, Executor());
  EXPECT_FALSE(guard.sweep(pin_at({0, 0, 0}), pin_at({2, 0, 0})).empty());
  EXPECT_TRUE(guard.sweep(pin_at({0, 0, 0}), pin_at({0, 0, 1})).empty());
  guard.commit();
  EXPECT_FALSE(guard.sweep(pin_at({0, 0, 1}), pin_at({2, 0, 1})).empty());
  guard.jump();
  EXPECT_FALSE(guard.sweep(pin_at({0, 0, 1}), pin_at({2, 0, 1})).empty());
}

TEST(VertexDepthGuard, HoldsBackVerticesOfCoarseFits) {
  // The bore's corners are 0.02 mm inside the pin from the start.
  const Assembly assembly =
      scenes::assembly({component("pin", tube(5, 0, -2, 22, 48)), component("plate", tube(20, 4.98, 0, 20, 48))});
  const PairStates states = states_of(assembly);
  VertexDepthGuard guard(assembly, states, Executor());
  EXPECT_FALSE(guard.sweep(pin_at({0, 0, 0}), pin_at({0.2, 0, 0})).empty());
  EXPECT_TRUE(guard.sweep(pin_at({0, 0, 0}), pin_at({0, 0, 5})).empty());
}

TEST(VertexDepthGuard, WatchesNothingWhereNothingOverlaps) {
  const Assembly assembly =
      scenes::assembly({component("pin", tube(5, 0, -2, 22, 48)), component("plate", tube(20, 5, 0, 20, 48))});
  ASSERT_EQ(states_of(assembly).pairs.at(0).state, PairState::Contact);
  EXPECT_TRUE(VertexDepthGuard(assembly, states_of(assembly), Executor()).watches_nothing());
}

}  // namespace
}  // namespace dismantle
