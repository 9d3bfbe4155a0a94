// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/explanation.h"

#include "tests/planner/blocking_relations.h"
#include "tests/planner/plan_scenes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Explanation why(const Assembly& assembly, const std::string& name) {
  const scenes::PlanScene scene = scenes::plan_scene(assembly);
  return why_blocked(scene.assembly, scene.pairs, *scene.assembly.find(name), {});
}

TEST(Explanation, NamesTheBlockerTheDirectionAndTheContact) {
  const Assembly pot = scenes::covered_pot();
  const Explanation e = why(pot, "block");
  ASSERT_EQ(e.blockers.size(), 1u);
  // The block is a cube of 10 mm about (0, 0, 5) that touches everything around it.
  EXPECT_NEAR(dot(e.blockers[0].contact.point - Vec3{0, 0, 5}, e.direction), 5, 0.02);
  const std::string text = explanation_text(pot, e), blocker = pot[e.blockers[0].component].name;
  EXPECT_EQ(text.find("block is blocked by " + blocker + " (contact at ("), 0u) << text;
  EXPECT_NE(text.find(") along " + direction_text(e.direction)), std::string::npos) << text;
}

TEST(Explanation, IsTrueOnceTheBlockersAreRemoved) {
  for (const Assembly& assembly : {scenes::covered_pot(), scenes::stack_in_tube(4), scenes::closed_shell(),
                                   scenes::assembly(scenes::chain_links())})
    for (const Component& c : assembly.components) {
      const Explanation e = why(assembly, c.name);
      std::vector<ComponentId> blockers;
      for (const Blocker& b : e.blockers) blockers.push_back(b.component);
      const Assembly left = scenes::without(assembly, blockers);
      EXPECT_TRUE(why(left, c.name).blockers.empty()) << explanation_text(assembly, e);
      if (blockers.empty()) continue;
      blockers.pop_back();
      const Assembly rest = scenes::without(assembly, blockers);
      EXPECT_FALSE(why(rest, c.name).blockers.empty()) << explanation_text(assembly, e);
    }
}

TEST(Explanation, TellsWhatLocksEachOther) {
  const Assembly chain = scenes::assembly(scenes::chain_links());
  const Explanation e = why(chain, "link");
  EXPECT_EQ(e.locked.size(), 2u);
  EXPECT_NE(explanation_text(chain, e).find("interlocked with next link"), std::string::npos);
}

using LeastBlockedWayTest = scenes::RelationsTest;

TEST_F(LeastBlockedWayTest, HasTheFewestBlockersOfAllDirectionsOnAnyExecutor) {
  std::mt19937_64 random(5);
  const std::uint32_t count = 9;
  std::size_t most = 0;
  for (int round = 0; round < 40; ++round) {
    const scenes::Relations relations = scenes::random_relations(count, 3, random);
    make(count, relations);
    const ComponentId component(static_cast<std::uint32_t>(random() % count));
    ComponentSet present = ComponentSet::all(count);
    present.erase(ComponentId((component.value + 1) % count));
    std::size_t fewest = count;
    for (const auto& direction : relations)
      fewest = std::min(
          fewest, static_cast<std::size_t>(std::count_if(direction.begin(), direction.end(), [&](const auto& pair) {
            return pair.first == component.value && present.has(ComponentId(pair.second));
          })));
    const std::vector<DirectionId>& directions = directions_[component.value];
    const BlockedWay serial = least_blocked_way(*table_, component, directions, present, Executor());
    EXPECT_EQ(serial.blockers.size(), fewest) << round;
    for (const Executor& executor : {Executor(ExecutorKind::Threads, 4), Executor(ExecutorKind::Shuffled)}) {
      make(count, relations);  // nothing is known yet
      const BlockedWay way = least_blocked_way(*table_, component, directions, present, executor);
      EXPECT_EQ(way.direction, serial.direction) << round;
      ASSERT_EQ(way.blockers.size(), fewest) << round;
      for (std::size_t i = 0; i < fewest; ++i) EXPECT_EQ(way.blockers[i].component, serial.blockers[i].component);
    }
    most = std::max(most, fewest);
  }
  EXPECT_GT(most, 1u) << "some must be blocked by several along every direction";
}

TEST(Explanation, SpeaksOfAGroupAsOfOnePart) {
  const Assembly stack = scenes::stack_in_tube(5);
  const scenes::PlanScene scene = scenes::plan_scene(stack);
  const ComponentId first = *stack.find("box 1"), second = *stack.find("box 2");
  PlanOptions options;
  options.together = {{first, second}};
  const Explanation e = why_blocked(scene.assembly, scene.pairs, first, options);
  EXPECT_EQ(e.group, (std::vector<ComponentId>{first, second}));
  ASSERT_EQ(e.blockers.size(), 1u);
  EXPECT_EQ(explanation_text(stack, e).find("box 1 (with 1 more of its group) is blocked by box"), 0u)
      << explanation_text(stack, e);
}

TEST(Explanation, NamesAFewAndCountsTheRest) {
  std::vector<Component> components;
  for (int i = 0; i < 9; ++i)
    components.push_back(scenes::component("c" + std::to_string(i), scenes::box({0, 0, 0}, {1, 1, 1})));
  const Assembly assembly = scenes::assembly(std::move(components));
  Explanation e;
  e.component = ComponentId(0);
  e.group = {ComponentId(0)};
  e.direction = {0, 0, 1};
  for (std::uint32_t c = 1; c < 9; ++c) e.blockers.push_back({ComponentId(c), {}});
  for (std::uint32_t c = 0; c < 9; ++c) e.locked.emplace_back(c);
  EXPECT_EQ(
      explanation_text(assembly, e),
      "c0 is blocked by c1 (contact at (0, 0, 0)), c2 (contact at (0, 0, 0)), c3 (contact at (0, 0, 0)) and 5 more "
      "along +Z, interlocked with c1, c2, c3, c4 and 4 more");
}

TEST(Explanation, SaysThatNothingBlocks) {
  const Assembly pot = scenes::covered_pot();
  EXPECT_EQ(explanation_text(pot, why(pot, "lid")), "lid can be removed along +Z");
}

TEST(DirectionText, NamesTheAxes) {
  EXPECT_EQ(direction_text({0, 0, 1}), "+Z");
  EXPECT_EQ(direction_text({-1, 1e-9, 0}), "-X");
  EXPECT_EQ(direction_text({0.6, 0, -0.8}), "(0.6, 0, -0.8)");
  EXPECT_EQ(direction_text({-1e-12, -0.6, 0.8}), "(0, -0.6, 0.8)");
}

}  // namespace
}  // namespace dismantle
