// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/removal_search.h"

#include "tests/planner/plan_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

const KeepGoing kAlways = [] { return true; };

/// A product given by its blocking relations: boxes in random order, whose table is filled directly.
class RemovalSearchTest : public testing::Test {
 protected:
  /// @param blocked the blocked component and its blockers, one entry per direction
  using Relations = std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>>;

  /// The table of `count` boxes far apart, along as many directions as there are relations.
  void make(std::uint32_t count, const Relations& relations) {
    std::vector<Component> components;
    for (std::uint32_t k = 0; k < count; ++k)
      components.push_back(scenes::component("box", scenes::box({0, 0, 0}, {1, 1, 1})));
    scene_ = {scenes::assembly(std::move(components)), {0.01, {}}};
    // Free pairs do not block: only the given relations do.
    for (std::uint32_t a = 0; a < count; ++a)
      for (std::uint32_t b = a + 1; b < count; ++b)
        scene_.pairs.pairs.push_back({ComponentId(a), ComponentId(b), PairState::Free, 0, 1, 1});
    engine_.emplace(scene_.assembly, scene_.pairs);
    features_.assign(count, shape_features(*scene_.assembly.components[0].mesh));
    groups_.emplace(count);
    table_.emplace(*engine_, features_, *groups_, kAlways);
    directions_.assign(count, {});
    for (std::size_t k = 0; k < relations.size(); ++k) {
      const DirectionId d = table_->add_direction(normalized(Vec3{1, 0.1 * static_cast<double>(k), 0}));
      for (std::vector<DirectionId>& own : directions_) own.push_back(d);
      for (const auto& [moving, fixed] : relations[k]) table_->add_blocker(ComponentId(moving), d, ComponentId(fixed));
    }
  }

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

  scenes::PlanScene scene_;
  std::optional<CertificateEngine> engine_;
  std::vector<ShapeFeatures> features_;
  std::optional<RigidGroups> groups_;
  std::optional<BlockingTable> table_;
  DirectionLists directions_;
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
    // In each direction, a random few block those before them in an order, so that all can be removed.
    const std::uint32_t count = 9;
    Relations relations(3);
    for (auto& direction : relations) {
      std::vector<std::uint32_t> order(count);
      for (std::uint32_t k = 0; k < count; ++k) order[k] = k;
      std::shuffle(order.begin(), order.end(), random);
      for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t j = i + 1; j < count; ++j)
          if (random() % 2 == 0) direction.emplace_back(order[i], order[j]);
    }
    make(count, relations);
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
