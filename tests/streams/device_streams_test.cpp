// SPDX-License-Identifier: Apache-2.0
// Steps on streams of a device compared with the streams of the host: on emulated devices, and on a CUDA device if
// there is one.
#include "dismantle/streams/streams_backend.h"
#include "tests/support/engine_scene.h"
#include "tests/support/random_scenes.h"
#include "tests/support/tested_device.h"

#include <gtest/gtest.h>

#include <optional>
#include <ostream>

namespace dismantle {
namespace {

using scenes::pair_of;
using scenes::shift;

constexpr double kTolerance = 0.01;

const TestedDevice kDevices[] = {{"Serial", Executor()},
                                 {"Shuffled", Executor(ExecutorKind::Shuffled)},
                                 {"Threads2", Executor(ExecutorKind::Threads, 2)},
                                 {"Threads7", Executor(ExecutorKind::Threads, 7)},
                                 {"Cuda", std::nullopt}};

/// Sweeps both to the same candidates and expects equal results.
class Comparison {
 public:
  Comparison(const Assembly& assembly, const PairStates& states, const CollisionOptions& options,
             std::unique_ptr<StreamsBackend> backend)
      : expected_(make_streams_engine(assembly, states, options)),
        engine_(make_streams_engine(assembly, states, options, std::move(backend))) {}

  SweepResult sweep(const std::vector<RigidTransform>& next) {
    const SweepResult expected = expected_->sweep(next, 1e-4);
    const SweepResult result = engine_->sweep(next, 1e-4);
    EXPECT_EQ(result.blocking_pairs, expected.blocking_pairs);
    EXPECT_EQ(result.toi, expected.toi);
    EXPECT_EQ(result.free, expected.free);
    EXPECT_EQ(result.sizes.triangle_pairs, expected.sizes.triangle_pairs);
    EXPECT_EQ(result.sizes.elementary_tests, expected.sizes.elementary_tests);
    return result;
  }
  SweepResult move(const std::vector<RigidTransform>& next) {
    SweepResult result = sweep(next);
    if (result.free) {
      expected_->commit();
      engine_->commit();
    }
    EXPECT_EQ(engine_->overlapping_pairs(), expected_->overlapping_pairs());
    return result;
  }
  void jump(const std::vector<RigidTransform>& state) {
    expected_->jump(state);
    engine_->jump(state);
    EXPECT_EQ(engine_->overlapping_pairs(), expected_->overlapping_pairs());
  }
  std::vector<RigidTransform> state() const { return {engine_->state().begin(), engine_->state().end()}; }

 private:
  std::unique_ptr<SweepEngine> expected_, engine_;
};

class DeviceStreams : public testing::TestWithParam<TestedDevice> {
 protected:
  void SetUp() override {
    if (GetParam().emulated_by) return;
    const auto cuda = make_cuda_streams_backend(scenes::assembly({}), {});
    if (!cuda) GTEST_SKIP() << "nothing runs on CUDA: " << cuda.error().message;
  }

  static Comparison compared(const Assembly& assembly, const PairStates& states, ElementaryTest test,
                             std::size_t capacity) {
    const CollisionOptions options{test, Executor(), capacity};
    if (GetParam().emulated_by)
      return {assembly, states, options, make_emulated_streams_backend(assembly, options, *GetParam().emulated_by)};
    return {assembly, states, options, std::move(make_cuda_streams_backend(assembly, options).value())};
  }
};

std::string name_of_device(const testing::TestParamInfo<TestedDevice>& device) {
  return device.param.name;
}

INSTANTIATE_TEST_SUITE_P(On, DeviceStreams, testing::ValuesIn(kDevices), name_of_device);

TEST_P(DeviceStreams, GiveTheContactsOfTheHostsStreamsFromEveryCapacity) {
  for (const ElementaryTest test : {ElementaryTest::Certified, ElementaryTest::Elementary}) {
    std::mt19937_64 random(21);
    const Assembly assembly = scenes::random_assembly(random, 12, 4);
    const PairStates states = scenes::states_by_brute_force(assembly, kTolerance);
    for (const std::size_t capacity : {1u, 5'000u}) {
      random.seed(22);
      Comparison engines = compared(assembly, states, test, capacity);
      std::size_t contacts = 0, free = 0, replays = 0;
      for (int step = 0; step < 40 && !HasFailure(); ++step) {
        SCOPED_TRACE(step);
        std::vector<RigidTransform> next = engines.state();
        for (RigidTransform& t : next)
          if (random() % 5 == 0) t = transform_from_pose(scenes::random_pose(random, 0.3, 0.1)) * t;
        if (random() % 8 == 0) {
          engines.jump(next);
          continue;
        }
        const SweepResult result = engines.move(next);
        contacts += result.blocking_pairs.size();
        free += result.free ? 1 : 0;
        replays += result.sizes.replays;
      }
      EXPECT_GT(contacts, 10u);
      EXPECT_GT(free, 3u);
      EXPECT_EQ(replays > 0, capacity == 1);
    }
  }
}

/// A peg in a tube with 0.1 mm of clearance.
struct PegInTube {
  Assembly assembly = scenes::assembly({scenes::component("tube", scenes::tube(10, 5, 0, 20, 96, 20)),
                                        scenes::component("peg", scenes::tube(4.9, 0, 0, 20, 96, 20))});
  PairStates states{kTolerance, {}};
};

// One moving component for many steps: the front is kept, grows, and restarts, which takes more rounds than are
// recorded.
TEST_P(DeviceStreams, KeepTheirFrontFromStepToStepAndRestartItWhenItHasGrown) {
  const PegInTube scene;
  Comparison engines = compared(scene.assembly, scene.states, ElementaryTest::Certified, 64);
  std::size_t largest = 0, last = 0;
  bool shrank = false;
  for (int step = 1; step <= 30 && !HasFailure(); ++step) {
    const Pose pose{{0.01 * (step % 3), 0, 0.8 * step}, quat_about({0, 0, 1}, 0.02 * step)};
    const SweepResult result = engines.move({{}, transform_from_pose(pose)});
    EXPECT_TRUE(result.free) << step;
    shrank = shrank || result.sizes.front < last;
    last = result.sizes.front;
    largest = std::max(largest, last);
  }
  EXPECT_GT(largest, 1000u);
  EXPECT_TRUE(shrank);
}

// More contacts than the report of a step can contain.
TEST_P(DeviceStreams, BringDownAnyNumberOfContactsFromCapacityOne) {
  const PegInTube scene;
  Comparison engines = compared(scene.assembly, scene.states, ElementaryTest::Certified, 1);
  const SweepResult blocked = engines.sweep({{}, transform_from_pose(shift(1, 0, 0))});
  EXPECT_GT(blocked.blocking_pairs.size(), 256u);
}

TEST_P(DeviceStreams, FollowFreePairsUntilTheyPartFromCapacityOne) {
  const Assembly assembly = scenes::assembly({scenes::component("plate", scenes::box({-10, -10, -3}, {10, 10, 0})),
                                              scenes::component("peg", scenes::tube(1.5, 0, -2, 6, 24, 6)),
                                              scenes::component("core", scenes::box({5, 5, -2}, {6, 6, -1}))});
  const PairStates states{kTolerance, {pair_of(0, 1, PairState::Free, 0), pair_of(0, 2, PairState::Free, 0)}};
  Comparison engines = compared(assembly, states, ElementaryTest::Certified, 1);
  const auto peg_at = [](double z) { return std::vector<RigidTransform>{{}, transform_from_pose(shift(0, 0, z)), {}}; };
  for (int step = 1; step <= 15; ++step) EXPECT_TRUE(engines.move(peg_at(0.1 * step)).free);
  EXPECT_TRUE(engines.move(peg_at(2.5)).free);
  EXPECT_FALSE(engines.move(peg_at(1)).free);
  engines.jump(peg_at(5));
  EXPECT_TRUE(engines.move(peg_at(4)).free);
}

TEST_P(DeviceStreams, TakeAssembliesOfNoneAndOneComponent) {
  const PairStates states{kTolerance, {}};
  const Assembly none = scenes::assembly({});
  EXPECT_TRUE(compared(none, states, ElementaryTest::Certified, 1).sweep({}).free);
  const Assembly one = scenes::assembly({scenes::component("a", scenes::box({0, 0, 0}, {1, 1, 1}))});
  Comparison alone = compared(one, states, ElementaryTest::Certified, 1);
  EXPECT_TRUE(alone.move({transform_from_pose(shift(1, 2, 3))}).free);
  EXPECT_EQ(alone.state()[0].translation, (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace dismantle
