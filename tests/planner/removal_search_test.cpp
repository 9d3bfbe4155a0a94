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
  const auto body = smallest_body(*table_, directions_, ComponentSet::all(3),
                                  ComponentSet(3, std::vector{ComponentId(2)}), Executor(), kAlways);
  ASSERT_TRUE(body);
  EXPECT_EQ(body->components, (std::vector{ComponentId(0), ComponentId(1)}));
}

TEST_F(RemovalSearchTest, FindsTheSmallestBodyOnAnyExecutor) {
  std::mt19937_64 random(8);
  const std::uint32_t count = 8;
  int of_several = 0;
  for (int round = 0; round < 80; ++round) {
    // Along each direction, sets of two to four block each other in a circle, and some of others that come after them.
    scenes::Relations relations = scenes::random_relations(count, 4, random);
    for (auto& direction : relations) {
      std::vector<std::uint32_t> order(count);
      for (std::uint32_t k = 0; k < count; ++k) order[k] = k;
      std::shuffle(order.begin(), order.end(), random);
      std::erase_if(direction, [&](const auto&) { return random() % 4 != 0; });
      for (std::uint32_t begin = 0, end; begin < count; begin = end) {
        end = std::min<std::uint32_t>(count, begin + 2 + static_cast<std::uint32_t>(random() % 3));
        if (end + 1 == count) end = count;
        for (std::uint32_t k = begin; k < end; ++k)
          direction.emplace_back(order[k], order[k + 1 < end ? k + 1 : begin]);
      }
    }
    make(count, relations);
    const ComponentSet all = ComponentSet::all(count), none(count);
    if (!free_components(*table_, directions_, all, none, Executor(), kAlways).empty()) continue;

    std::size_t least = count;
    for (const auto& direction : relations)
      for (std::uint32_t mask = 1; mask + 1 < 1u << count; ++mask)
        if (std::all_of(direction.begin(), direction.end(), [&](const auto& pair) {
              return (mask >> pair.first & 1) == 0 || (mask >> pair.second & 1) == 1;
            }))
          least = std::min(least, static_cast<std::size_t>(__builtin_popcount(mask)));

    const auto serial = smallest_body(*table_, directions_, all, none, Executor(), kAlways);
    EXPECT_EQ(serial ? serial->components.size() : count, least) << round;
    for (const Executor& executor : {Executor(ExecutorKind::Threads, 4), Executor(ExecutorKind::Shuffled)}) {
      const auto found = smallest_body(*table_, directions_, all, none, executor, kAlways);
      ASSERT_EQ(found.has_value(), serial.has_value()) << round;
      if (!found) continue;
      EXPECT_EQ(found->components, serial->components) << round;
      EXPECT_EQ(found->direction, serial->direction) << round;
    }
    of_several += serial.has_value();
  }
  EXPECT_GT(of_several, 20) << "many of these must have a body that can be removed";
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
