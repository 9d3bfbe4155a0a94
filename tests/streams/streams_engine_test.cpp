// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/sweep_engine.h"

#include "dismantle/certificates/ghosts/find_pair_ghosts.h"
#include "dismantle/streams/narrow_phase_kernel.h"
#include "dismantle/surface/ghost_surface.h"
#include "tests/support/engine_scene.h"
#include "tests/support/executors.h"
#include "tests/support/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

using scenes::EngineScene;
using scenes::pair_of;
using scenes::shift;

constexpr double kTolerance = 0.01;

CollisionOptions options(ElementaryTest test = ElementaryTest::Certified) {
  CollisionOptions o;
  o.test = test;
  o.initial_capacity = 1;
  return o;
}

constexpr ElementaryTest kBothTests[] = {ElementaryTest::Certified, ElementaryTest::Elementary};

// A plate of 1 um, and a box that is on its other side after one step.
TEST(StreamsEngine, CatchesABoxThatPassesThroughAThinPlateInOneStep) {
  const std::vector<Pose> targets{
      shift(0, 0, -20),
      shift(3, -2, -20),
      {{0, 0, -20}, quat_about({0, 0, 1}, 0.3)},
      {{1, 2, -25}, quat_about(normalized(Vec3{1, 1, 0}), 0.5)},
  };
  for (const ElementaryTest test : kBothTests) {
    for (const Pose& target : targets) {
      EngineScene scene(
          {{"plate", scenes::box({-30, -30, 0}, {30, 30, 0.001})}, {"box", scenes::box({-1, -1, 5}, {1, 1, 7})}}, {},
          kTolerance, options(test));
      const SweepResult result = scene.sweep({{1, target}});
      EXPECT_FALSE(result.free);
      EXPECT_FALSE(result.blocking_pairs.empty());
      EXPECT_GT(result.toi, 0.05);
      EXPECT_LT(result.toi, 0.5);
    }
  }
}

TEST(StreamsEngine, StopsATranslationAtItsContact) {
  for (const ElementaryTest test : kBothTests) {
    EngineScene scene({{"a", scenes::box({0, 0, 0}, {1, 1, 1})}, {"b", scenes::box({3, 0.2, 0.2}, {4, 0.8, 0.8})}}, {},
                      kTolerance, options(test));
    const SweepResult result = scene.sweep({{1, shift(-4, 0, 0)}});
    EXPECT_FALSE(result.free);
    EXPECT_NEAR(result.toi, 0.5, 0.5 * kTolerance);
    EXPECT_EQ(result.blocking_pairs.front().a, ComponentId(0));
    EXPECT_EQ(result.blocking_pairs.front().b, ComponentId(1));
  }
}

TEST(StreamsEngine, LetsABlockSlideOnWhatItTouchesAndTouchAgain) {
  EngineScene scene({{"floor", scenes::box({-20, -20, -1}, {20, 20, 0})}, {"block", scenes::box({0, 0, 0}, {2, 2, 2})}},
                    {pair_of(0, 1, PairState::Contact, kTolerance)}, kTolerance, options());
  for (int step = 1; step <= 20; ++step) ASSERT_TRUE(scene.move({{1, shift(0.3 * step, 0.1 * step, 0)}}).free) << step;
  ASSERT_TRUE(scene.move({{1, shift(6, 2, 1)}}).free);
  ASSERT_TRUE(scene.move({{1, shift(6, 2, 0)}}).free);
  EXPECT_FALSE(scene.move({{1, shift(6, 2, -0.5)}}).free);
}

TEST(StreamsEngine, LetsAPegTurnAndGoThroughATubeButNotThroughItsWall) {
  for (const ElementaryTest test : kBothTests) {
    EngineScene scene({{"tube", scenes::tube(10, 5, 0, 20, 48, 4)}, {"peg", scenes::tube(4.9, 0, 0, 20, 48, 4)}}, {},
                      kTolerance, options(test));
    for (int step = 1; step <= 30; ++step) {
      const SweepResult result = scene.move({{1, {{0, 0, step * 1.0}, quat_about({0, 0, 1}, 0.01 * step)}}});
      ASSERT_TRUE(result.free) << step;
    }
    ASSERT_TRUE(scene.move({{1, {{0, 0, 5}, quat_about({0, 0, 1}, 0.3)}}}).free);
    const SweepResult blocked = scene.sweep({{1, {{3, 0, 5}, quat_about({0, 0, 1}, 0.3)}}});
    EXPECT_FALSE(blocked.free);
    EXPECT_LT(blocked.toi, 0.1);
  }
}

TEST(StreamsEngine, ExemptsAPegUntilItPartsAndBlocksItWhenItComesBack) {
  for (const ElementaryTest test : kBothTests) {
    EngineScene scene(
        {{"plate", scenes::box({-10, -10, -3}, {10, 10, 0})}, {"peg", scenes::tube(1.5, 0, -2, 6, 24, 6)}},
        {pair_of(0, 1, PairState::Free, 0)}, kTolerance, options(test));
    for (int step = 1; step <= 19; ++step) {
      ASSERT_TRUE(scene.move({{1, shift(0.05 * step, 0, 0.1 * step)}}).free) << step;
      EXPECT_EQ(scene.engine().overlapping_pairs().size(), 1u) << step;
    }
    ASSERT_TRUE(scene.move({{1, shift(1, 0, 1)}}).free);  // back in is free, too, until they have separated
    ASSERT_TRUE(scene.move({{1, shift(1, 0, 2.5)}}).free);
    EXPECT_TRUE(scene.engine().overlapping_pairs().empty());
    const SweepResult blocked = scene.move({{1, shift(1, 0, 1)}});
    EXPECT_FALSE(blocked.free);
    EXPECT_NEAR(blocked.toi, 0.5 / 1.5, 0.02);
  }
}

// Out of one wall and into the next in one step: it is apart in between, so the second wall blocks.
TEST(StreamsEngine, NoticesThatAFreePairPartsAndMeetsAgainWithinOneStep) {
  TriangleMesh channel = scenes::box({0, -5, -5}, {1, 5, 5});
  const TriangleMesh wall = scenes::box({6, -5, -5}, {7, 5, 5});
  for (const Vec3& p : wall.vertices) channel.vertices.push_back(p);
  for (const Face& f : wall.faces) channel.faces.push_back({{f.v[0] + 8, f.v[1] + 8, f.v[2] + 8}});
  for (const double end : {5.0, 20.0}) {  // into the second wall; through it
    EngineScene scene({{"channel", channel}, {"peg", scenes::box({0.4, -1, -1}, {2, 1, 1})}},
                      {pair_of(0, 1, PairState::Free, 0)}, kTolerance, options());
    const SweepResult result = scene.sweep({{1, shift(end, 0, 0)}});
    EXPECT_FALSE(result.free);
    EXPECT_NEAR(result.toi, 4 / end, 0.02 / end);
    EXPECT_EQ(scene.engine().overlapping_pairs().size(), 1u);  // only a commit ends its exemption
  }
}

TEST(StreamsEngine, KeepsASolidInsideAnotherFreeUntilItIsOut) {
  EngineScene scene({{"block", scenes::box({-5, -5, -5}, {5, 5, 5})}, {"core", scenes::box({-1, -1, -1}, {1, 1, 1})}},
                    {pair_of(0, 1, PairState::Free, 0)}, kTolerance, options());
  for (int step = 1; step <= 11; ++step) {
    ASSERT_TRUE(scene.move({{1, shift(0.01, 0.02, 0.53 * step)}}).free) << step;
    EXPECT_EQ(scene.engine().overlapping_pairs().size(), 1u) << step;
  }
  ASSERT_TRUE(scene.move({{1, shift(0.01, 0.02, 6.5)}}).free);
  EXPECT_TRUE(scene.engine().overlapping_pairs().empty());
  EXPECT_FALSE(scene.move({{1, shift(0, 0, 0)}}).free);
}

TEST(StreamsEngine, DropsFreePairsThatAJumpParts) {
  EngineScene scene({{"plate", scenes::box({-10, -10, -3}, {10, 10, 0})},
                     {"peg", scenes::box({-1, -1, -2}, {1, 1, 2})},
                     {"core", scenes::box({5, 5, -2}, {6, 6, -1})}},
                    {pair_of(0, 1, PairState::Free, 0), pair_of(0, 2, PairState::Free, 0)}, kTolerance, options());
  scene.jump({{1, shift(2, 0, 1)}, {2, shift(0, 1, 0)}});
  EXPECT_EQ(scene.engine().overlapping_pairs().size(), 2u);
  scene.jump({{1, shift(2, 0, 10)}});
  ASSERT_EQ(scene.engine().overlapping_pairs().size(), 1u);
  EXPECT_EQ(scene.engine().overlapping_pairs().front().b, ComponentId(2));
  EXPECT_EQ(scene.engine().state()[1].translation, (Vec3{2, 0, 10}));
  EXPECT_FALSE(scene.move({{1, shift(2, 0, 0)}}).free);
  scene.jump({{1, shift(2, 0, 0)}});
  EXPECT_EQ(scene.engine().overlapping_pairs().size(), 1u);  // it is not exempted again
}

TEST(StreamsEngine, LetsComponentsThatMoveTogetherTouchAndTestsThoseThatDoNot) {
  EngineScene scene({{"a", scenes::box({0, 0, 0}, {1, 1, 1})},
                     {"b", scenes::box({1, 0, 0}, {2, 1, 1})},
                     {"c", scenes::box({5, 0, 0}, {6, 1, 1})}},
                    {}, kTolerance, options());
  EXPECT_TRUE(scene.move({{0, shift(2, 0, 0)}, {1, shift(2, 0, 0)}}).free);
  EXPECT_FALSE(scene.sweep({{0, shift(4, 0, 0)}, {1, shift(4, 0, 0)}}).free);
  const SweepResult head_on = scene.sweep({{0, shift(3, 0, 0)}, {1, shift(3, 0, 0)}, {2, shift(-1, 0, 0)}});
  EXPECT_FALSE(head_on.free);
  EXPECT_NEAR(head_on.toi, 0.5, 0.02);
}

/// The contacts found by testing every triangle of components that move relative to each other with the ghosts of all
/// of the other.
std::vector<BlockingPair> brute_force_contacts(const EngineScene& scene, const std::vector<RigidTransform>& next) {
  std::vector<BlockingPair> contacts;
  const Span<const RigidTransform> state = scene.engine().state();
  const auto moves = [&](std::size_t c) { return !(state[c] == next[c]); };
  const auto motions_of = [&](std::size_t c, const TriangleMesh& mesh) {
    std::vector<TriangleMotion> motions(mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (int k = 0; k < 3; ++k) {
        motions[f].t0[k] = state[c] * mesh.triangle(f)[k];
        motions[f].t1[k] = next[c] * mesh.triangle(f)[k];
      }
    return motions;
  };
  const std::size_t count = next.size();
  std::vector<std::vector<TriangleMotion>> motions(count), ghosts(count);
  for (std::size_t c = 0; c < count; ++c) {
    TriangleMesh mesh = assembled_mesh(scene.assembly().components[c]);
    motions[c] = motions_of(c, mesh);
    mesh.vertices = ghost_vertices(mesh.vertices, mesh.faces, kGhostLength * kTolerance);
    ghosts[c] = motions_of(c, mesh);
  }
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = a + 1; b < count; ++b) {
      if (state[a] == state[b] && next[a] == next[b]) continue;
      if (!moves(a) && !moves(b)) continue;
      for (std::uint32_t f = 0; f < motions[a].size(); ++f) {
        for (std::uint32_t g = 0; g < motions[b].size(); ++g) {
          const CcdResult ccd = ccd_with_ghosts({motions[a][f], ghosts[a][f]}, {motions[b][g], ghosts[b][g]});
          if (ccd.status == CcdStatus::Contact)
            contacts.push_back({ComponentId(a), ComponentId(b), FaceId(f), FaceId(g), ccd.toi});
        }
      }
    }
  }
  return contacts;
}

/// The sweep must report the earliest of all contacts; times of impact are conservative within this.
void expect_first_of(const std::vector<BlockingPair>& all, const SweepResult& result) {
  constexpr double kSlack = 5e-4;
  ASSERT_EQ(result.free, all.empty());
  double first = 1;
  for (const BlockingPair& contact : all) first = std::min(first, contact.toi);
  EXPECT_NEAR(result.toi, first, kSlack);
  const auto same = [](const BlockingPair& x) {
    return
        [x](const BlockingPair& y) { return x.a == y.a && x.b == y.b && x.face_a == y.face_a && x.face_b == y.face_b; };
  };
  for (const BlockingPair& contact : all) {
    if (contact.toi > result.toi + kContactWindow - kSlack) continue;
    EXPECT_EQ(std::count_if(result.blocking_pairs.begin(), result.blocking_pairs.end(), same(contact)), 1);
  }
  for (const BlockingPair& contact : result.blocking_pairs) {
    const auto place = std::find_if(all.begin(), all.end(), same(contact));
    ASSERT_NE(place, all.end());
    EXPECT_NEAR(contact.toi, place->toi, kSlack);
  }
}

TEST(StreamsEngine, FindsTheFirstContactsOfBruteForce) {
  std::size_t found = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    EngineScene scene(scenes::random_assembly(random, 8, 4.5), {}, kTolerance, options());
    for (int step = 0; step < 12; ++step) {
      std::vector<RigidTransform> next(scene.engine().state().begin(), scene.engine().state().end());
      for (RigidTransform& t : next)
        if (random() % 4 == 0) t = transform_from_pose(scenes::random_pose(random, 0.3, 0.1)) * t;
      const SweepResult result = scene.engine().sweep(next, 0);
      expect_first_of(brute_force_contacts(scene, next), result);
      found += result.blocking_pairs.size();
      if (result.free) scene.engine().commit();
    }
  }
  EXPECT_GT(found, 100u);
}

TEST(StreamsEngine, GivesTheSameBytesOnEveryExecutorFromEveryCapacity) {
  for (const ElementaryTest test : kBothTests) {
    std::mt19937_64 random(21);
    const Assembly assembly = scenes::random_assembly(random, 12, 4);
    const PairStates states = scenes::states_by_brute_force(assembly, kTolerance);
    EXPECT_GT(states.pairs.size(), 3u);
    std::vector<std::unique_ptr<SweepEngine>> engines;
    for (const Executor& executor : all_executors())
      for (const std::size_t capacity : {1u, 100'000u})
        engines.push_back(make_streams_engine(assembly, states, {test, executor, capacity}));
    std::size_t contacts = 0, free = 0;
    for (int step = 0; step < 60; ++step) {
      std::vector<RigidTransform> next(engines[0]->state().begin(), engines[0]->state().end());
      for (RigidTransform& t : next)
        if (random() % 5 == 0) t = transform_from_pose(scenes::random_pose(random, 0.3, 0.1)) * t;
      const SweepResult expected = engines[0]->sweep(next, 1e-4);
      contacts += expected.blocking_pairs.size();
      free += expected.free ? 1 : 0;
      for (const auto& engine : engines) {
        const SweepResult result = engine->sweep(next, 1e-4);
        ASSERT_EQ(result.blocking_pairs, expected.blocking_pairs) << "step " << step;
        ASSERT_EQ(result.toi, expected.toi);
        ASSERT_EQ(result.sizes.front, expected.sizes.front);
        ASSERT_EQ(result.sizes.triangle_pairs, expected.sizes.triangle_pairs);
        ASSERT_EQ(result.sizes.elementary_tests, expected.sizes.elementary_tests);
        if (result.free) engine->commit();
        ASSERT_EQ(engine->overlapping_pairs(), engines[0]->overlapping_pairs());
      }
    }
    EXPECT_GE(contacts, 10u);
    EXPECT_GE(free, 5u);
  }
}

TEST(StreamsEngine, ReportsWhatAStepCostAndHowLargeTheStreamsAre) {
  EngineScene scene({{"tube", scenes::tube(10, 5, 0, 20, 48, 4)}, {"peg", scenes::tube(4.9, 0, 0, 20, 48, 4)}},
                    {pair_of(0, 1, PairState::Contact, kTolerance)}, kTolerance, options());
  const SweepResult result = scene.sweep({{1, shift(0, 0, 1)}});
  EXPECT_GT(result.sizes.front, 100u);
  EXPECT_GT(result.sizes.triangle_pairs, 10u);
  EXPECT_GT(result.sizes.replays, 0u);
  const StageTimings& t = result.timings;
  for (const double stage : {t.vertices, t.refit, t.front, t.intersection}) EXPECT_GT(stage, 0);
  EXPECT_GE(t.overall, t.vertices + t.refit + t.front + t.intersection - 1e-3);
}

TEST(StreamsEngine, TakesAssembliesOfNoneAndOneComponent) {
  EngineScene none(scenes::assembly({}), {}, kTolerance, options());
  EXPECT_TRUE(none.sweep({}).free);
  EngineScene one({{"a", scenes::box({0, 0, 0}, {1, 1, 1})}}, {}, kTolerance, options());
  EXPECT_TRUE(one.move({{0, shift(1, 2, 3)}}).free);
  EXPECT_EQ(one.engine().state()[0].translation, (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace dismantle
