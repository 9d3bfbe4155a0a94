// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/play_motion.h"

#include "dismantle/engine/classify_pairs.h"
#include "dismantle/math/screw.h"
#include "dismantle/streams/streams_motion_engine.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dismantle {
namespace {

using scenes::box;
using scenes::component;
using scenes::tube;

constexpr double kTolerance = 0.01;

PlayedMotion played(const Assembly& assembly, const Motion& motion) {
  ClassifyOptions classify;
  classify.tolerance = kTolerance;
  const Result<PairStates> states = classify_pairs(assembly, classify);
  const auto engine = make_streams_motion_engine(assembly, *states, {});
  Result<PlayedMotion> result = play_motion(assembly, *states, motion, *engine);
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
  return *result;
}

/// `steps` targets along a straight line.
MotionMove straight(std::string name, Vec3 by, int steps, Vec3 from = {}) {
  MotionMove move{{std::move(name)}, {}};
  for (int k = 0; k <= steps; ++k)
    move.targets.push_back({0.01 * k, {from + (static_cast<double>(k) / steps) * by, {}}});
  return move;
}

Assembly wall_and_block() {
  return scenes::assembly(
      {component("block", box({0, 0, 0}, {10, 10, 10})), component("wall", box({20.5, -50, -50}, {21, 50, 50}))});
}

TEST(PlayMotion, StopsAtTheLastWholeStepBeforeTheWall) {
  const PlayedMotion result = played(wall_and_block(), {ResponseKind::Stop, {straight("block", {40, 0, 0}, 40)}});
  ASSERT_EQ(result.path.moves.size(), 1u);
  const std::vector<Frame>& frames = result.path.moves[0].frames;
  EXPECT_EQ(frames.size(), 41u);
  EXPECT_EQ(frames.front().pose, Pose{});
  EXPECT_DOUBLE_EQ(frames[10].pose.position.x, 10);
  // The 11th target and all later ones are beyond the wall: longer and longer sweeps, all stopped.
  EXPECT_DOUBLE_EQ(frames.back().pose.position.x, 10);
  EXPECT_FALSE(result.steps.back().result.reached);
  ASSERT_FALSE(result.steps.back().result.blocking_pairs.empty());
  EXPECT_EQ(result.steps.back().result.blocking_pairs[0].b, ComponentId(1));
}

TEST(PlayMotion, TouchesTheWallWithinTheTolerance) {
  const PlayedMotion result = played(wall_and_block(), {ResponseKind::Touch, {straight("block", {40, 0, 0}, 7)}});
  EXPECT_NEAR(result.path.moves[0].frames.back().pose.position.x, 10.5, kTolerance);
}

TEST(PlayMotion, ComesAwayFromTheWallAfterTouchingIt) {
  Motion motion{ResponseKind::Touch, {straight("block", {40, 0, 0}, 7)}};
  MotionMove back = straight("block", {0, 0, 0}, 1);
  motion.moves[0].targets.push_back({1, {{3, 0, 0}, {}}});
  const PlayedMotion result = played(wall_and_block(), motion);
  EXPECT_EQ(result.path.moves[0].frames.back().pose.position, (Vec3{3, 0, 0}));
  EXPECT_TRUE(result.steps.back().result.reached);
}

TEST(PlayMotion, NeverLetsARotatingBladeThroughThePost) {
  // The blade's tip sweeps half a turn in one step, through a thin post.
  const Assembly assembly = scenes::assembly(
      {component("blade", box({0, -0.5, 0}, {100, 0.5, 1})), component("post", box({-0.05, 60, -5}, {0.05, 60.1, 5}))});
  for (const ResponseKind response : {ResponseKind::Stop, ResponseKind::Touch}) {
    Motion motion{response, {{{"blade"}, {{0.1, {{}, quat_about({0, 0, 1}, 3.0)}}}}}};
    const PlayedMotion result = played(assembly, motion);
    const Quat q = result.path.moves[0].frames.back().pose.rotation;
    const double angle = 2 * std::atan2(q.z, q.w);
    // Stop is all or nothing.
    EXPECT_LT(angle, response == ResponseKind::Stop ? 1e-12 : 1.5708);
    EXPECT_GT(angle, response == ResponseKind::Stop ? -1e-12 : 1.5);
  }
}

TEST(PlayMotion, PullsAPressedPinOutAlongItsAxisAndNotSideways) {
  const Assembly assembly =
      scenes::assembly({component("pin", tube(5, 0, -2, 22, 48)), component("plate", tube(20, 4.98, 0, 20, 48))});
  const PlayedMotion out = played(assembly, {ResponseKind::Touch, {straight("pin", {0, 0, 60}, 30)}});
  EXPECT_EQ(out.path.moves[0].frames.back().pose.position, (Vec3{0, 0, 60}));
  EXPECT_EQ(out.path.removed, std::vector<std::string>{"pin"});
  ASSERT_EQ(out.path.pairs.size(), 1u);
  EXPECT_EQ(out.path.pairs[0].state, PathPairState::Overlapping);
  const PlayedMotion sideways = played(assembly, {ResponseKind::Touch, {straight("pin", {60, 0, 0}, 30)}});
  EXPECT_LT(sideways.path.moves[0].frames.back().pose.position.x, 0.1);
}

TEST(PlayMotion, LetsAnOverlappingPairPartOnceAndThenKeepsItApart) {
  const Assembly assembly = scenes::assembly(
      {component("lump", box({0, 0, 0}, {10, 10, 10})), component("body", box({5, -5, -5}, {30, 15, 15}))});
  Motion motion{ResponseKind::Touch, {straight("lump", {-20, 0, 0}, 20)}};
  for (int k = 1; k <= 20; ++k) motion.moves[0].targets.push_back({0.2 + 0.01 * k, {{-20.0 + k, 0, 0}, {}}});
  const PlayedMotion result = played(assembly, motion);
  const std::vector<Frame>& frames = result.path.moves[0].frames;
  EXPECT_EQ(result.path.pairs.at(0).state, PathPairState::Overlapping);
  EXPECT_EQ(frames[20].pose.position.x, -20);
  EXPECT_NEAR(frames.back().pose.position.x, -5, kTolerance);
}

TEST(PlayMotion, MovesSeveralComponentsAsOneBody) {
  const Assembly assembly =
      scenes::assembly({component("a", box({0, 0, 0}, {10, 10, 10})), component("b", box({10, 0, 0}, {20, 10, 10})),
                        component("wall", box({40, -5, -5}, {50, 15, 15}))});
  Motion motion{ResponseKind::Touch, {straight("a", {100, 0, 0}, 10)}};
  motion.moves[0].components = {"a", "b"};
  EXPECT_NEAR(played(assembly, motion).path.moves[0].frames.back().pose.position.x, 20, kTolerance);
}

TEST(PlayMotion, RefusesUnknownComponentsAndTornSets) {
  const Assembly assembly = wall_and_block();
  const PairStates states{kTolerance, {}};
  const auto play = [&](const Motion& motion) {
    const auto engine = make_streams_motion_engine(assembly, states, {});
    return play_motion(assembly, states, motion, *engine);
  };
  const Result<PlayedMotion> unknown = play({ResponseKind::Stop, {straight("blok", {1, 0, 0}, 1)}});
  ASSERT_FALSE(unknown.ok());
  EXPECT_NE(unknown.error().message.find("'blok'"), std::string::npos);
  Motion torn{ResponseKind::Stop, {straight("block", {1, 0, 0}, 1), straight("block", {2, 0, 0}, 1)}};
  torn.moves[1].components.push_back("wall");
  EXPECT_FALSE(play(torn).ok());
}

TEST(PlayMotion, KeepsWhatWasMovedWhenCancelled) {
  const Assembly assembly = wall_and_block();
  const PairStates states{kTolerance, {}};
  const auto engine = make_streams_motion_engine(assembly, states, {});
  int calls = 0;
  const Result<PlayedMotion> result =
      play_motion(assembly, states, {ResponseKind::Stop, {straight("block", {5, 0, 0}, 10)}}, *engine,
                  [&](std::string_view, double) { return ++calls < 5; });
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(result->cancelled);
  EXPECT_EQ(result->path.moves[0].frames.back().pose.position.x, 1.5);
}

}  // namespace
}  // namespace dismantle
