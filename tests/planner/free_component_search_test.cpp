// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/free_component_search.h"

#include "tests/planner/blocking_relations.h"

namespace dismantle {
namespace {

using scenes::random_relations;

class FreeComponentSearchTest : public scenes::RelationsTest {
 protected:
  /// Takes components out, the one of `found` that `choice` picks each time, and compares each result with that of a
  /// new search. @return the number taken out
  std::size_t take_out(const ComponentSet& never, std::mt19937_64& choice) {
    ComponentSet left = ComponentSet::all(features_.size());
    FreeComponentSearch search(*table_, directions_, left, never);
    std::size_t taken = 0;
    for (;; ++taken) {
      const std::vector<StraightRemoval> found = search.find(Executor(ExecutorKind::Threads, 2), kAlways);
      const std::vector<StraightRemoval> anew = free_components(*table_, directions_, left, never, Executor(), kAlways);
      EXPECT_EQ(found.size(), anew.size());
      for (std::size_t i = 0; i < std::min(found.size(), anew.size()); ++i) {
        EXPECT_EQ(found[i].components, anew[i].components);
        EXPECT_EQ(found[i].direction, anew[i].direction);
      }
      if (found.empty()) return taken;
      const std::vector<ComponentId>& chosen = found[choice() % found.size()].components;
      left.erase(chosen);
      search.remove(chosen);
    }
  }
};

TEST_F(FreeComponentSearchTest, FindsWhatANewSearchFinds) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 10; ++round) {
    constexpr std::uint32_t kCount = 40;
    make(kCount, random_relations(kCount, 3, random));
    const ComponentId stays(static_cast<std::uint32_t>(random() % kCount));
    EXPECT_GT(take_out(ComponentSet(kCount, {&stays, 1}), random), 0u) << round;
  }
}

TEST_F(FreeComponentSearchTest, FindsWhatANewSearchFindsWithPredictions) {
  std::mt19937_64 random(12);
  for (int round = 0; round < 10; ++round) {
    constexpr std::uint32_t kCount = 40;
    make(kCount, {{}, {}});
    // Some predictions hold, as far as these blockers go.
    const auto relations = random_relations(kCount, 2, random);
    table_->expect_blockers([&](ComponentId c, const Vec3& direction) {
      std::vector<ComponentId> expected;
      for (const auto& [moving, fixed] : relations[direction.y > 0 ? 1 : 0])
        if (moving == c.value && (moving + fixed) % 3 == 0) expected.emplace_back(fixed);
      return expected;
    });
    for (std::size_t k = 0; k < relations.size(); ++k)
      for (const auto& [moving, fixed] : relations[k])
        if ((moving * fixed) % 2 == 0) table_->add_blocker(ComponentId(moving), directions_[0][k], ComponentId(fixed));
    EXPECT_EQ(take_out(ComponentSet(kCount), random), kCount) << round;
  }
}

TEST_F(FreeComponentSearchTest, TakesAGroupAsOneComponent) {
  // 0 and 3 are one group, which is free along the second direction once 1 is gone: there 3 blocks 2 only.
  make(4, {{{0, 1}, {3, 2}, {1, 0}}, {{0, 1}, {2, 3}}});
  groups_->unite(std::vector{ComponentId(0), ComponentId(3)});
  table_.emplace(*engine_, features_, *groups_, kAlways);
  const std::vector<DirectionId> d{table_->add_direction({1, 0, 0}), table_->add_direction({0, 1, 0})};
  directions_.assign(4, d);
  for (const auto& [moving, fixed] : {std::pair(0u, 1u), {3, 2}, {1, 0}, {2, 3}})
    table_->add_blocker(ComponentId(moving), d[0], ComponentId(fixed));
  for (const auto& [moving, fixed] : {std::pair(0u, 1u), {2, 3}})
    table_->add_blocker(ComponentId(moving), d[1], ComponentId(fixed));
  FreeComponentSearch search(*table_, directions_, ComponentSet::all(4), ComponentSet(4));
  std::vector<StraightRemoval> found = search.find(Executor(), kAlways);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].components, (std::vector{ComponentId(1)}));
  EXPECT_EQ(found[0].direction, d[1]);
  search.remove(found[0].components);
  found = search.find(Executor(), kAlways);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].components, (std::vector{ComponentId(0), ComponentId(3)}));
  EXPECT_EQ(found[0].direction, d[1]) << "along the first, 2 blocks 3";
  search.remove(found[0].components);
  found = search.find(Executor(), kAlways);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].components, (std::vector{ComponentId(2)}));
}

TEST_F(FreeComponentSearchTest, FindsNothingMoreOnceTheTimeIsOver) {
  make(4, {{{0, 1}}});
  FreeComponentSearch search(*table_, directions_, ComponentSet::all(4), ComponentSet(4));
  EXPECT_TRUE(search.find(Executor(), [] { return false; }).empty());
  EXPECT_FALSE(search.find(Executor(), kAlways).empty());
}

}  // namespace
}  // namespace dismantle
