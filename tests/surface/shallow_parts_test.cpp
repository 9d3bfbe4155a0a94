// SPDX-License-Identifier: Apache-2.0
// Tests of ShallowParts: the results that depth searches store and reuse.
#include "dismantle/surface/depth/shallow_parts.h"

#include "dismantle/surface/depth/swept_depth.h"
#include "tests/support/gear_meshes.h"
#include "tests/support/random_scenes.h"
#include "tests/support/shaped_solid.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <vector>

namespace dismantle {
namespace {

using Solid = scenes::ShapedSolid;

TEST(FirstDeeper, FindsTheSameWithPartsThatAreKnownFromOtherMotions) {
  std::mt19937_64 random(31);
  constexpr double kResolution = 0.002;
  std::size_t known_cost = 0, fresh_cost = 0;
  int deep = 0, free = 0;
  for (int i = 0; i < 24; ++i) {
    TriangleMesh ring = scenes::tube(2, i % 3 == 0 ? 1 : 0, -2, 2, 5 + static_cast<std::uint32_t>(i % 7));
    if (i % 4 == 3) ring.faces.pop_back();
    const Solid a(ring), b(scenes::box({-2, -1.5, -1}, {2, 1.5, 1}));
    const DepthLimits limits = i % 2 == 0 ? DepthLimits{0.4 + 0.02 * i} : DepthLimits{1.1, 0.02, 0.02};
    RigidTransform at = transform_from_pose(scenes::random_pose(random, 3.5, 1));
    ShallowParts of_a, of_b;
    for (int k = 0; k < 12; ++k) {
      const RigidTransform to = transform_from_pose(scenes::random_pose(random, 0.3, 0.1)) * at;
      SweptPair pair{&a.shape, &b.shape, at, to};
      if (k % 3 == 2) pair.until = 0.4;
      const auto fresh = first_deeper(pair, limits, kResolution, kMaxSweptPieces, {}, DeepSearch::First, &fresh_cost);
      pair.known_a = &of_a;
      pair.known_b = &of_b;
      const auto known = first_deeper(pair, limits, kResolution, kMaxSweptPieces, {}, DeepSearch::First, &known_cost);
      ASSERT_EQ(known.has_value(), fresh.has_value()) << i << " " << k;
      (known ? deep : free) += 1;
      if (!known) {
        if (k % 3 != 2) at = to;  // as a hand moves on
        continue;
      }
      EXPECT_NEAR(known->free_until, fresh->free_until, 3 * kResolution) << i << " " << k;
      EXPECT_LE(known->free_until, pair.until);
    }
  }
  EXPECT_GT(deep, 50);
  EXPECT_GT(free, 50);
  EXPECT_LT(known_cost, fresh_cost);
}

TEST(FirstDeeper, GoesOnWhereASearchEnded) {
  // The end of a beam in a plate, pushed on: many points get nearly as deep as they may.
  const Solid plate(scenes::box({-5, -5, 0}, {5, 5, 1})), beam(scenes::tube(0.4, 0, 0.5, 10, 48));
  const DepthLimits limits{0.51, 0.01, 0.51};
  SweptPair pair{&beam.shape, &plate.shape, {}, {{}, {0, 0, -0.51}}};
  std::size_t all = 0;
  EXPECT_FALSE(first_deeper(pair, limits, 1e-3, kMaxSweptPieces, {}, DeepSearch::First, &all));
  const std::size_t few = all / 6;
  const auto ended = first_deeper(pair, limits, 1e-3, few);
  ASSERT_TRUE(ended);
  EXPECT_FALSE(ended->is_certain);
  ShallowParts of_beam, of_plate;
  pair.known_a = &of_beam;
  pair.known_b = &of_plate;
  int searches = 0;
  for (bool is_free = false; !is_free && searches < 60; ++searches) {
    const auto found = first_deeper(pair, limits, 1e-3, few);
    is_free = !found;
    EXPECT_TRUE(is_free || !found->is_certain);
  }
  EXPECT_GT(searches, 1);
  EXPECT_LT(searches, 60);
}

TEST(FirstDeeper, ExaminesNothingTwiceOfAMotionThatIsSearchedAgain) {
  std::mt19937_64 random(37);
  int ended_early = 0;
  std::size_t at_once = 0, in_turns = 0;
  for (int i = 0; i < 40; ++i) {
    const Solid a(scenes::tube(2, 1, -2, 2, 40)), b(scenes::box({-2, -1.5, -1}, {2, 1.5, 1}));
    const RigidTransform start = transform_from_pose(scenes::random_pose(random, 3, 1)),
                         end = transform_from_pose(scenes::random_pose(random, 0.3, 0.1)) * start;
    SweptPair pair{&a.shape, &b.shape, start, end};
    const DepthLimits limits{0.6 + 0.02 * (i % 20)};
    std::size_t once = 0;
    const auto whole = first_deeper(pair, limits, 1e-3, kMaxSweptPieces, {}, DeepSearch::First, &once);
    if (once > 20000) continue;
    at_once += once;
    ShallowParts of_a, of_b;
    pair.known_a = &of_a;
    pair.known_b = &of_b;
    std::optional<DeepPoint> found;
    double free_until = 0;
    int searches = 0;
    do {
      found = first_deeper(pair, limits, 1e-3, 100, {}, DeepSearch::First, &in_turns);
      ASSERT_LT(++searches, 1000) << i;
      if (!found) break;
      EXPECT_GE(found->free_until, free_until) << i;
      free_until = found->free_until;
    } while (!found->is_certain);
    ended_early += searches > 1 ? 1 : 0;
    ASSERT_EQ(found.has_value(), whole.has_value()) << i;
    if (found) {
      EXPECT_NEAR(found->free_until, whole->free_until, 2e-3) << i;
    }
  }
  EXPECT_GT(ended_early, 5);
  EXPECT_LT(in_turns, 3 * at_once);
}

TEST(ShallowParts, TriesFacesOfManyPartsAnewEverMoreRarely) {
  ShallowParts known;
  known.set(3, std::vector<ShallowPart>(10));
  known.set(7, std::vector<ShallowPart>(100));
  std::vector<int> due;
  for (int i = 1; i <= 200; ++i) {
    EXPECT_EQ(known.due(3), 0u);
    if (known.due(7) > 0) due.push_back(i);
  }
  EXPECT_EQ(due, (std::vector<int>{1, 3, 7, 15, 31, 63, 127, 191}));
  known.set(7, std::vector<ShallowPart>(40));
  EXPECT_EQ(known.due(7), 20u);
}

TEST(ShallowParts, ForgetsAllOnceThereAreTooMany) {
  ShallowParts known;
  known.set(0, std::vector<ShallowPart>(60000));
  known.set(0, std::vector<ShallowPart>(60000));  // in place of those before
  EXPECT_NE(known.of(0), nullptr);
  known.set(1, std::vector<ShallowPart>(60000));
  EXPECT_EQ(known.of(0), nullptr);
  ASSERT_NE(known.of(1), nullptr);
  EXPECT_EQ(known.of(1)->size(), 60000u);
  known.refine(1, std::vector<ShallowPart>(120000));
  EXPECT_EQ(known.of(1), nullptr);
  known.set(1, std::vector<ShallowPart>(10));
  known.set(1, {});
  EXPECT_EQ(known.of(1), nullptr);
}

}  // namespace
}  // namespace dismantle
