// SPDX-License-Identifier: Apache-2.0
#include "bench/baselines/front_based_engine.h"

#include "dismantle/streams/step_towards.h"
#include "tests/support/engine_scene.h"
#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

constexpr double kTolerance = 0.01;

std::vector<RigidTransform> shaken(std::mt19937_64& random, const SweepEngine& engine) {
  std::vector<RigidTransform> next(engine.state().begin(), engine.state().end());
  for (RigidTransform& t : next)
    if (random() % 5 == 0) t = transform_from_pose(scenes::random_pose(random, 0.3, 0.1)) * t;
  return next;
}

TEST(FrontBasedEngine, FindsTheContactsOfStreamsBitForBitWhereEveryPairIsOrdinary) {
  std::size_t contacts = 0, free = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const Assembly assembly = scenes::random_assembly(random, 10, 4.5);
    const PairStates states{kTolerance, {}};
    const auto streams = make_streams_engine(assembly, states, {ElementaryTest::Elementary, {}, 1});
    std::vector<std::unique_ptr<SweepEngine>> engines;
    for (const FrontBasedWork work : {FrontBasedWork::AllComponents, FrontBasedWork::MovingComponents})
      for (const Executor& executor : all_executors())
        engines.push_back(make_front_based_engine(assembly, states, {ElementaryTest::Elementary, executor, 1}, work));
    for (int step = 0; step < 40; ++step) {
      const std::vector<RigidTransform> next = shaken(random, *streams);
      const SweepResult expected = streams->sweep(next, 1e-4);
      contacts += expected.blocking_pairs.size();
      free += expected.free ? 1 : 0;
      for (const auto& engine : engines) {
        const SweepResult result = engine->sweep(next, 1e-4);
        ASSERT_EQ(result.blocking_pairs, expected.blocking_pairs) << "step " << step;
        ASSERT_EQ(result.toi, expected.toi);
        if (result.free) engine->commit();
      }
      if (expected.free) streams->commit();
    }
  }
  EXPECT_GT(contacts, 50u);
  EXPECT_GT(free, 20u);
}

TEST(FrontBasedEngine, DecidesAsStreamsDoesAmongPairsInContactAndFreeOnes) {
  for (const ElementaryTest test : {ElementaryTest::Certified, ElementaryTest::Elementary}) {
    std::mt19937_64 random(21);
    const Assembly assembly = scenes::random_assembly(random, 12, 4);
    const PairStates states = scenes::states_by_brute_force(assembly, kTolerance);
    const auto streams = make_streams_engine(assembly, states, {test, {}, 64});
    const Executor two(ExecutorKind::Threads, 2);
    const auto engine = make_front_based_engine(assembly, states, {test, two, 64});
    const auto rigid = make_front_based_engine(assembly, states, {test, two, 64}, FrontBasedWork::MovingComponents);
    const std::size_t free_before = streams->overlapping_pairs().size();
    std::size_t free = 0, blocked = 0;
    for (int step = 0; step < 60; ++step) {
      const std::vector<RigidTransform> next = shaken(random, *streams);
      const SweepResult expected = streams->sweep(next, 1e-4), result = engine->sweep(next, 1e-4);
      ASSERT_EQ(result.free, expected.free) << "step " << step;
      ASSERT_EQ(rigid->sweep(next, 1e-4).free, expected.free) << "step " << step;
      ++(result.free ? free : blocked);
      if (!result.free) continue;
      streams->commit();
      engine->commit();
      rigid->commit();
      ASSERT_EQ(rigid->overlapping_pairs(), streams->overlapping_pairs());
      ASSERT_EQ(engine->overlapping_pairs(), streams->overlapping_pairs());
    }
    EXPECT_GT(free, 5u);
    EXPECT_GT(blocked, 5u);
    EXPECT_LT(engine->overlapping_pairs().size(), free_before);
  }
}

TEST(FrontBasedEngine, JumpsAsStreamsDoes) {
  const Assembly assembly = scenes::assembly({scenes::component("plate", scenes::box({-10, -10, -3}, {10, 10, 0})),
                                              scenes::component("peg", scenes::box({-1, -1, -2}, {1, 1, 2}))});
  const PairStates states{kTolerance, {scenes::pair_of(0, 1, PairState::Free, 0)}};
  const auto engine = make_front_based_engine(assembly, states, {});
  std::vector<RigidTransform> state(2);
  state[1] = transform_from_pose(scenes::shift(2, 0, 1));
  engine->jump(state);
  EXPECT_EQ(engine->overlapping_pairs().size(), 1u);
  state[1] = transform_from_pose(scenes::shift(2, 0, 10));
  engine->jump(state);
  EXPECT_TRUE(engine->overlapping_pairs().empty());
  state[1] = transform_from_pose(scenes::shift(2, 0, 0));
  EXPECT_FALSE(engine->sweep(state, 0).free);
}

}  // namespace
}  // namespace dismantle
