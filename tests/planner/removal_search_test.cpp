// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/removal_search.h"

#include "tests/planner/blocking_relations.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

/// Searches in products given by their blocking relations.
class RemovalSearchTest : public scenes::RelationsTest {
 protected:
  /// The minimum number of components to remove, by trying all sets.
  std::size_t by_brute_force(ComponentId target) {
    const std::size_t count = features_.size();
    std::size_t best = count + 1;
    for (std::uint32_t mask = 0; mask < 1u << count; ++mask) {
      if ((mask >> target.value & 1) == 0) continue;
      ComponentSet left = ComponentSet::all(count);
      for (bool any = true; any;) {
        any = false;
        for (std::uint32_t c = 0; c < count; ++c) {
          if ((mask >> c & 1) == 0 || !left.has(ComponentId(c))) continue;
          for (const DirectionId d : directions_[c]) {
            if (!left.has(ComponentId(c)) || table_->any_blocker(ComponentId(c), d, left)) continue;
            left.erase(ComponentId(c));
            any = true;
          }
        }
      }
      const auto size = static_cast<std::size_t>(__builtin_popcount(mask));
      if (count - left.size() == size) best = std::min(best, size);
    }
    return best;
  }
};

TEST_F(RemovalSearchTest, TakesTheShorterExit) {
  // 0 is under 1 and 2 in one direction, and behind 3 in the other; nothing blocks 3.
  make(4, {{{0, 1}, {0, 2}}, {{0, 3}}});
  const ComponentId target(0);
  const auto found =
      fewest_removals(*table_, directions_, ComponentSet::all(4), ComponentSet(4), {&target, 1}, kAlways);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->members(), (std::vector{ComponentId(0), ComponentId(3)}));
}

TEST_F(RemovalSearchTest, LeavesWhatMustStay) {
  make(4, {{{0, 1}, {0, 2}}, {{0, 3}}});
  const ComponentId target(0), fixed(3);
  const auto found =
      fewest_removals(*table_, directions_, ComponentSet::all(4), ComponentSet(4, {&fixed, 1}), {&target, 1}, kAlways);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->size(), 3u);
}

TEST_F(RemovalSearchTest, FindsNothingIfTheTargetIsLocked) {
  make(2, {{{0, 1}, {1, 0}}});
  const ComponentId target(0);
  EXPECT_FALSE(fewest_removals(*table_, directions_, ComponentSet::all(2), ComponentSet(2), {&target, 1}, kAlways));
}

TEST_F(RemovalSearchTest, TakesOutTogetherWhatLocksEachOther) {
  make(3, {{{0, 1}, {1, 0}}});
  const auto body =
      smallest_body(*table_, directions_, ComponentSet::all(3), ComponentSet(3, std::vector{ComponentId(2)}), kAlways);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->components, (std::vector{ComponentId(0), ComponentId(1)}));
}

TEST_F(RemovalSearchTest, NeverTakesOutMoreThanTheOptimum) {
  std::mt19937_64 random(7);
  int searched = 0;
  for (int round = 0; round < 60; ++round) {
    const std::uint32_t count = 9;
    make(count, scenes::random_relations(count, 3, random));
    const ComponentId target(0);
    const auto found =
        fewest_removals(*table_, directions_, ComponentSet::all(count), ComponentSet(count), {&target, 1}, kAlways);
    ASSERT_TRUE(found) << round;
    EXPECT_LE(found->size(), by_brute_force(target)) << round;
    searched += found->size() > 1;
  }
  EXPECT_GT(searched, 20) << "many of these must need a search";
}

}  // namespace
}  // namespace dismantle
