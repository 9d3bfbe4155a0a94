// SPDX-License-Identifier: Apache-2.0
// Steps that end at a limit of their work, and go on.
#include "dismantle/certificates/certificate_engine.h"

#include "tests/certificates/grabbed_component.h"
#include "tests/support/large_scenes.h"
#include "tests/support/slide_scenes.h"
#include "tests/support/swept_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

using namespace grabbed;
using scenes::box;
using scenes::component;
using scenes::tube;

TEST(StepLimit, BoundsTheWorkOfAStepWhereDepthsAreHardToBoundAndGoesOn) {
  // A foil thinner than the tolerance across the end of a tube, pulled off aslant: no ghost, and nothing to bound its
  // depth by but ever smaller pieces.
  TriangleMesh ring = tube(1.5, 1, 0, 1, 36);
  for (Vec3& p : ring.vertices) p = p + Vec3{0.5, 4, 8};
  const Assembly assembly =
      scenes::assembly({component("foil", box({0, 2.5, 8}, {3, 5.5, 8.02})), component("ring", std::move(ring))});
  const PairStates states = *classify_pairs(assembly, {});
  ASSERT_EQ(states.pairs.size(), 1u);
  const Pose target{{2.875, -2.5625, -0.6875}, {}};
  struct Way {
    Pose end;
    std::size_t most_tests = 0;
    int steps = 0, unfinished = 0;
  };
  const auto pulled = [&](std::size_t depth_tests, ResponseKind response) {
    CertificateOptions options;
    options.depth_tests = depth_tests;
    Grabbed foil(assembly, states, 0, options);
    Way way;
    for (bool goes_on = true; goes_on && way.steps < 400;) {
      const StepResult made = foil.engine.step(target, response);
      ++way.steps;
      way.unfinished += made.unfinished ? 1 : 0;
      goes_on = made.unfinished || (!made.reached && !made.poses.empty());
      way.most_tests = std::max(way.most_tests, made.cost.depth_tests);
      way.end = made.pose;
    }
    return way;
  };
  for (const ResponseKind response : {ResponseKind::Slide, ResponseKind::Touch}) {
    SCOPED_TRACE(response == ResponseKind::Slide ? "slide" : "touch");
    constexpr std::size_t kMost = 1500;
    const Way bounded = pulled(kMost, response), unbounded = pulled(0, response);
    ASSERT_GT(unbounded.most_tests, 10 * kMost);  // else it shows nothing
    EXPECT_EQ(unbounded.unfinished, 0);
    EXPECT_GT(bounded.unfinished, 0);
    EXPECT_LT(bounded.steps, 400);
    EXPECT_LT(bounded.most_tests, unbounded.most_tests / 2);
    EXPECT_GE(length(bounded.end.position), length(unbounded.end.position) - 0.1);
  }
}

TEST(StepLimit, EndsStepsOfSlideEarlyAndGoesOn) {
  // A shaft that fills its hole, pulled by a trembling hand: many contacts, of which few are known at first.
  const scenes::SlideScene scene = scenes::shaft_in_hole(4000, 0);
  const PairStates states = states_of(scene.assembly);
  struct Way {
    double out = 0;
    int most_sweeps = 0;
    int ended_early = 0;
  };
  const auto pulled = [&](std::size_t limit) {
    CertificateOptions options;
    options.slide_tests = limit;
    Grabbed shaft(scene.assembly, states, scene.moving.value, options);
    scenes::Hand hand(scene, {0.1, 0.3, 0.06, 1});
    Way way;
    Pose target;
    bool is_settled = false;
    for (int k = 1; k <= 400 && !(k > 60 && is_settled); ++k) {
      if (k <= 60) target = hand.trembling(hand.steady(0.05 * k));  // then the hand waits
      const StepResult made = shaft.engine.step(target, ResponseKind::Slide);
      is_settled = made.reached || (made.poses.empty() && !made.unfinished);
      way.most_sweeps = std::max(way.most_sweeps, made.sweeps);
      way.ended_early += limit > 0 && made.cost.tests >= limit ? 1 : 0;
      way.out = dot(made.pose.position, scene.pull);
    }
    return way;
  };
  const Way free = pulled(0);
  EXPECT_GT(free.out, 2.5);
  // With a limit of 1, a step may find the contacts only that the next one needs.
  for (const std::size_t limit : {1u, 20u, 100u}) {
    SCOPED_TRACE(limit);
    const Way limited = pulled(limit);
    EXPECT_GT(limited.ended_early, 3);  // else it shows nothing
    EXPECT_LT(limited.most_sweeps, free.most_sweeps);
    EXPECT_NEAR(limited.out, free.out, 0.05);
  }
}

TEST(StepLimit, BoundsThePairsOfNodesOfAStepAndGoesOn) {
  // A ring of many facets close around a torus: the front of the first step is built from its roots.
  const scenes::SlideScene scene = scenes::ring_on_torus(60'000, 0.01);
  const PairStates states = states_of(scene.assembly);
  struct Way {
    double out = 0;
    std::size_t of_first = 0, most = 0;
    int steps = 0, unfinished = 0;
  };
  const auto pulled = [&](std::size_t node_pairs, ResponseKind response) {
    CertificateOptions options;
    options.node_pairs = node_pairs;
    Grabbed ring(scene.assembly, states, scene.moving.value, options);
    Way way;
    for (int k = 1; k <= 10; ++k) {
      StepResult made;
      do {
        const Pose target{0.05 * k * scene.pull, {}};
        made = ring.engine.step(target, response);
        ++way.steps;
        way.unfinished += made.unfinished ? 1 : 0;
        if (way.steps == 1) way.of_first = made.cost.node_pairs;
        way.most = std::max(way.most, made.cost.node_pairs);
      } while (made.unfinished && way.steps < 2000);
      way.out = dot(made.pose.position, scene.pull);
    }
    return way;
  };
  for (const ResponseKind response : {ResponseKind::Slide, ResponseKind::Touch, ResponseKind::Stop}) {
    SCOPED_TRACE(static_cast<int>(response));
    constexpr std::size_t kMost = 4000;
    const Way unbounded = pulled(0, response), bounded = pulled(kMost, response);
    EXPECT_EQ(unbounded.unfinished, 0);
    ASSERT_GT(unbounded.of_first, 3 * kMost);  // else it shows nothing
    EXPECT_GT(bounded.unfinished, 2);
    EXPECT_LT(bounded.steps, 200);
    EXPECT_LT(bounded.most, 2 * kMost);
    EXPECT_NEAR(bounded.out, unbounded.out, 1e-3);
  }
}

TEST(StepLimit, KeepsContactsThatAreFarAheadForTheNextStep) {
  // A block that is pushed at a wall from afar, aslant: it stops there, and slides along it.
  const Assembly assembly = scenes::assembly(
      {component("block", box({0, 0, 0}, {2, 2, 2})), component("wall", box({5, -20, -20}, {6, 20, 20}))});
  const PairStates states = states_of(assembly);
  CertificateOptions options;
  options.slide_tests = 1;
  Grabbed block(assembly, states, 0, options);
  const Pose target{{20, 4, 0}, {}};
  StepResult made;
  int steps = 0;
  do {
    made = block.engine.step(target, ResponseKind::Slide);
    ++steps;
  } while (made.unfinished || !made.poses.empty());
  EXPECT_LT(steps, 12);
  EXPECT_NEAR(made.pose.position.x, 3, 0.05);
  EXPECT_NEAR(made.pose.position.y, 4, 0.05);
}

TEST(StepLimit, TakesPartsOutInShortSteps) {
  CertificateOptions few_tests, few_nodes;
  few_tests.slide_tests = 1;  // a step ends with the first contacts that it finds
  few_nodes.node_pairs = 1;   // sweeps are cut

  const scenes::SlideScene all[] = {
      scenes::peg_in_hole(24, 0.001),       scenes::peg_in_hole(64, 0), scenes::key_in_slot(0, {0, 1, 0}),
      scenes::key_in_slot(0.01, {0, 0, 1}), scenes::dovetail(0),        scenes::part_in_corner(),
      scenes::press_fit_pin(24, 0.02)};
  for (const CertificateOptions& options : {few_tests, few_nodes})
    for (const scenes::SlideScene& scene : all) {
      SCOPED_TRACE(scene.assembly[scene.moving].name);
      ClassifyOptions classify;
      classify.tolerance = 0.01;
      const PairStates states = *classify_pairs(scene.assembly, classify);
      Grabbed part(scene.assembly, states, scene.moving.value, options);
      scenes::Hand hand(scene, {});
      double moved = 0;
      int steps = 0;
      const int most =
          20 + (options.node_pairs > 0 ? 40 : 4) * static_cast<int>(scene.exit_distance / scenes::Hand::Options{}.step);
      for (; steps < most && moved < scene.exit_distance; ++steps)
        moved = scenes::distance_moved(scene, part.engine.step(hand.next(), ResponseKind::Slide).pose);
      EXPECT_GE(moved, scene.exit_distance);
    }
}

}  // namespace
}  // namespace dismantle
