// SPDX-License-Identifier: Apache-2.0
// Candidate motions of a batch compared with the same motions swept one by one, on every executor and on a CUDA device
// if there is one.
#include "dismantle/candidates/fallback_motion_batch.h"

#include "dismantle/candidates/candidate_kernel.h"
#include "dismantle/math/screw.h"
#include "dismantle/streams/step_towards.h"
#include "tests/support/engine_scene.h"
#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using scenes::pair_of;

constexpr double kTolerance = 0.01;

/// Batches on every executor, and on a CUDA device if there is one.
std::vector<std::unique_ptr<MotionBatch>> all_batches(const Assembly& assembly, const PairStates& states) {
  std::vector<std::unique_ptr<MotionBatch>> batches;
  for (const Executor& executor : all_executors())
    batches.push_back(make_motion_batch(assembly, states, executor, DeviceChoice::Cpu).batch);
  if (auto cuda = make_cuda_motion_batch(assembly, states, Executor())) batches.push_back(std::move(*cuda));
  return batches;
}

/// A random assembly in a random state, with a moving set of two components.
struct RandomState {
  Assembly assembly;
  PairStates states;
  std::vector<Pose> poses;
  std::vector<ComponentId> moving{ComponentId(3), ComponentId(4)};
  explicit RandomState(std::mt19937_64& random) : assembly(scenes::random_assembly(random, 12, 9)), poses(12) {
    states = scenes::states_by_brute_force(assembly, kTolerance);
    for (Pose& pose : poses)
      if (random() % 3 == 0) pose = scenes::random_pose(random, 2, 1);
    poses[3] = poses[4] = scenes::random_pose(random, 2, 1);
  }

  /// The result of a sweep of method `streams` to a pose, in the given number of pieces.
  FirstContact swept(const Pose& target, int pieces) const {
    std::vector<RigidTransform> state;
    for (const Pose& pose : poses) state.push_back(transform_from_pose(pose));
    const std::unique_ptr<SweepEngine> engine = make_streams_engine(assembly, states, {});
    FirstContact result;
    for (int k = 0; k < pieces && result.free; ++k) {
      std::vector<RigidTransform> from = state, to = state;
      for (const ComponentId c : moving) {
        from[c.value] = transform_from_pose(pose_between(poses[3], target, static_cast<double>(k) / pieces));
        to[c.value] = transform_from_pose(pose_between(poses[3], target, (k + 1.0) / pieces));
      }
      engine->jump(from);
      const SweepResult sweep = engine->sweep(to, kArcShare * kTolerance);
      result.free = sweep.free;
      result.toi = (k + sweep.toi) / pieces;
    }
    return result;
  }
};

void expect_agree(const FirstContact& batch, const FirstContact& swept) {
  ASSERT_EQ(batch.free, swept.free);
  EXPECT_NEAR(batch.toi, swept.toi, 1e-4);
}

TEST(MotionBatch, StopsLinearMotionsWhereSweepsDoAndGivesTheSameBytesEverywhere) {
  std::size_t free = 0, stopped_on_the_way = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    RandomState scene(random);
    std::erase_if(scene.states.pairs, [](const ComponentPair& p) { return p.state == PairState::Free; });
    std::vector<Vec3> displacements;
    for (int i = 0; i < 60; ++i) displacements.push_back(scenes::random_vector(random, i % 2 == 0 ? 0.3 : 30));
    const auto batches = all_batches(scene.assembly, scene.states);
    std::vector<FirstContact> expected;
    for (const auto& batch : batches) {
      batch->set_state(scene.poses, scene.moving);
      const std::vector<FirstContact> contacts = batch->straight_contacts(displacements);
      if (expected.empty()) expected = contacts;
      EXPECT_EQ(contacts, expected);
    }
    for (std::size_t i = 0; i < displacements.size(); ++i) {
      Pose target = scene.poses[3];
      target.position = target.position + displacements[i];
      expect_agree(expected[i], scene.swept(target, 1));
      free += expected[i].free ? 1 : 0;
      stopped_on_the_way += !expected[i].free && expected[i].toi > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(free, 20u);
  EXPECT_GT(stopped_on_the_way, 20u);
}

TEST(MotionBatch, StopsScrewsWhereSweepsDoAndGivesTheSameBytesEverywhere) {
  std::size_t free = 0, stopped_on_the_way = 0;
  for (unsigned seed = 11; seed <= 13; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    RandomState scene(random);
    std::erase_if(scene.states.pairs, [](const ComponentPair& p) { return p.state == PairState::Free; });
    const RigidSet set = make_rigid_set(scene.assembly, scene.moving);
    std::vector<Pose> targets;
    for (int i = 0; i < 12; ++i) targets.push_back(scenes::random_pose(random, 4, 0.4) * scene.poses[3]);
    const auto batches = all_batches(scene.assembly, scene.states);
    std::vector<FirstContact> expected;
    for (const auto& batch : batches) {
      batch->set_state(scene.poses, scene.moving);
      const std::vector<FirstContact> contacts = batch->screw_contacts(targets);
      if (expected.empty()) expected = contacts;
      EXPECT_EQ(contacts, expected);
    }
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const Screw screw = screw_between(scene.poses[3], targets[i]);
      const double rho = screw_radius(screw, transform_from_pose(scene.poses[3]) * set.center, set.radius);
      const int pieces = chord_count(screw_chord_deviation(screw, rho), kArcShare * kTolerance);
      expect_agree(expected[i], scene.swept(targets[i], pieces));
      free += expected[i].free ? 1 : 0;
      stopped_on_the_way += !expected[i].free && expected[i].toi > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(free, 3u);
  EXPECT_GT(stopped_on_the_way, 3u);
}

/// A batch whose device fails in its n-th call.
class FailingBatch final : public MotionBatch {
 public:
  FailingBatch(std::unique_ptr<MotionBatch> batch, int calls_before) : batch_(std::move(batch)), left_(calls_before) {}
  void set_state(Span<const Pose> poses, Span<const ComponentId> moving) override { called().set_state(poses, moving); }
  std::vector<FirstContact> straight_contacts(Span<const Vec3> displacements) override {
    return called().straight_contacts(displacements);
  }
  std::vector<FirstContact> screw_contacts(Span<const Pose> targets) override {
    return called().screw_contacts(targets);
  }

 private:
  MotionBatch& called() {
    if (left_-- == 0) throw CudaError("a kernel failed (the device is lost)");
    return *batch_;
  }

  std::unique_ptr<MotionBatch> batch_;
  int left_;
};

TEST(FallbackMotionBatch, GivesTheSameContactsWhereverTheDeviceFails) {
  std::mt19937_64 random(3);
  RandomState scene(random);
  const std::vector<Vec3> displacements{{30, 0, 0}, {0, -30, 0}, {0.1, 0.2, 30}};
  const std::vector<Pose> targets{scenes::random_pose(random, 4, 0.4) * scene.poses[3]};
  const auto make_on_cpu = [&] {
    return make_motion_batch(scene.assembly, scene.states, Executor(), DeviceChoice::Cpu).batch;
  };
  const auto plain = make_on_cpu();
  plain->set_state(scene.poses, scene.moving);
  for (int calls = 0; calls < 3; ++calls) {
    const auto failure = std::make_shared<DeviceFailure>();
    FallbackMotionBatch batch(std::make_unique<FailingBatch>(make_on_cpu(), calls), make_on_cpu, failure);
    batch.set_state(scene.poses, scene.moving);
    EXPECT_EQ(batch.straight_contacts(displacements), plain->straight_contacts(displacements));
    EXPECT_EQ(batch.screw_contacts(targets), plain->screw_contacts(targets));
    EXPECT_EQ(failure->why, "a kernel failed (the device is lost)");
  }
}

TEST(MotionBatch, NamesTheComponentAndTheFacesThatMeetFirst) {
  const Assembly assembly = scenes::assembly({scenes::component("far", scenes::box({9, 0, 0}, {10, 1, 1})),
                                              scenes::component("near", scenes::box({5, 0, 0}, {6, 1, 1})),
                                              scenes::component("hand", scenes::box({0, 0.2, 0.2}, {1, 0.8, 0.8}))});
  const PairStates states{kTolerance, {}};
  const ChosenMotionBatch chosen = make_motion_batch(assembly, states, Executor(), DeviceChoice::Cpu);
  MotionBatch& batch = *chosen.batch;
  batch.set_state(std::vector<Pose>(3), std::vector<ComponentId>{ComponentId(2)});
  const std::vector<FirstContact> contacts =
      batch.straight_contacts(std::vector<Vec3>{{8, 0, 0}, {-8, 0, 0}, {0, 0, 0}});
  EXPECT_FALSE(contacts[0].free);
  EXPECT_NEAR(contacts[0].toi, 0.5, kTolerance / 8);
  EXPECT_EQ(contacts[0].moving, ComponentId(2));
  EXPECT_EQ(contacts[0].fixed, ComponentId(1));
  EXPECT_TRUE(contacts[1].free);
  EXPECT_TRUE(contacts[2].free);
}

TEST(MotionBatch, ExemptsFreePairsAndNoOthers) {
  const Assembly assembly = scenes::assembly({scenes::component("plate", scenes::box({-5, -5, -1}, {5, 5, 1})),
                                              scenes::component("peg", scenes::box({-1, -1, -2}, {1, 1, 2}))});
  const std::vector<ComponentId> peg{ComponentId(1)};
  const std::vector<Vec3> displacements{{2, 0, 0}, {0, 0, 9}};
  const auto exempt =
      make_motion_batch(assembly, {kTolerance, {pair_of(0, 1, PairState::Free, 0)}}, Executor(), DeviceChoice::Cpu);
  exempt.batch->set_state(std::vector<Pose>(2), peg);
  for (const FirstContact& contact : exempt.batch->straight_contacts(displacements)) EXPECT_TRUE(contact.free);
  const auto ordinary = make_motion_batch(assembly, {kTolerance, {}}, Executor(), DeviceChoice::Cpu);
  ordinary.batch->set_state(std::vector<Pose>(2), peg);
  for (const FirstContact& contact : ordinary.batch->straight_contacts(displacements)) EXPECT_EQ(contact.toi, 0);
}

OverlapTimes times_of(double displacement, double allowed) {
  OverlapTimes t;
  t.meet({0, 1}, displacement, {3, 4}, allowed);
  return t;
}

TEST(OverlapTimes, BeginAndEndWhereExtentsMeetAndSeparate) {
  EXPECT_NEAR(times_of(8, 0).begin, 0.25, 1e-9);
  EXPECT_NEAR(times_of(8, 0).end, 0.5, 1e-9);
  EXPECT_LE(times_of(8, 0).begin, 0.25);  // never late
  EXPECT_GE(times_of(8, 0).end, 0.5);
  EXPECT_GT(times_of(1, 0).contact(), 1);   // it does not reach it
  EXPECT_GT(times_of(0, 0).contact(), 1);   // it does not move
  EXPECT_GT(times_of(-5, 0).contact(), 1);  // it moves away
}

TEST(OverlapTimes, AllowADepthOnTheSideOfTheStart) {
  EXPECT_NEAR(times_of(8, 0.4).contact(), 0.3, 1e-9);
  EXPECT_LE(times_of(8, 0.4).contact(), 0.3);
  EXPECT_GT(times_of(2.3, 0.4).contact(), 1);
  OverlapTimes sheet;  // through a sheet without thickness
  sheet.meet({0, 0}, 8, {2, 2}, 0.4);
  EXPECT_NEAR(sheet.contact(), 0.3, 1e-9);
  OverlapTimes resting;  // resting on it, then away
  resting.meet({2, 3}, 8, {1, 2}, 0.4);
  EXPECT_GT(resting.contact(), 1);
}

}  // namespace
}  // namespace dismantle
