// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/precedence_graph.h"

#include "dismantle/audit/audit_path.h"
#include "dismantle/planner/plan_disassembly.h"
#include "dismantle/planner/plan_path.h"
#include "tests/planner/plan_scenes.h"

#include <gtest/gtest.h>

#include <numeric>

namespace dismantle {
namespace {

using scenes::plan_scene;
using scenes::PlanScene;

const KeepGoing kAlways = [] { return true; };

/// Two towers of two boxes each on a plate: tower by tower from above.
///
///      [b]   [d]
///      [a]   [c]
///     ===========
Assembly two_towers() {
  return scenes::assembly({scenes::component("plate", scenes::box({-50, -50, -10}, {50, 50, 0})),
                           scenes::component("a", scenes::box({-30, -8, 0}, {-10, 8, 10})),
                           scenes::component("b", scenes::box({-28, -6, 10}, {-12, 6, 20})),
                           scenes::component("c", scenes::box({10, -8, 0}, {30, 8, 10})),
                           scenes::component("d", scenes::box({12, -6, 10}, {28, 6, 20}))});
}

/// A plan that removes each component in this order along its direction.
Plan straight_plan(const std::vector<std::pair<std::uint32_t, Vec3>>& steps) {
  Plan plan;
  for (const auto& [c, exit] : steps)
    plan.steps.push_back({{ComponentId(c)}, PlanTier::Straight, PlanStep::kWhole, {}, exit});
  return plan;
}

PrecedenceGraph graph_of(const PlanScene& scene, const Plan& plan) {
  return precedence_graph(scene.assembly, scene.pairs, plan, {}, kAlways);
}

/// Calls visit(order) for every order of the steps that complies with the graph.
template <class Visit>
void for_each_order(const PrecedenceGraph& graph, const Visit& visit) {
  std::vector<std::uint32_t> order(graph.before.size());
  std::iota(order.begin(), order.end(), 0);
  do {
    std::vector<std::uint32_t> place(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    bool allowed = true;
    for (std::uint32_t k = 0; k < order.size(); ++k)
      for (const std::uint32_t j : graph.before[k]) allowed = allowed && place[j] < place[k];
    if (allowed) visit(order);
  } while (std::next_permutation(order.begin(), order.end()));
}

bool is_clean(const PlanScene& scene, const Plan& plan) {
  return audit_path(scene.assembly, plan_path(scene.assembly, scene.pairs, plan)).holds();
}

TEST(PrecedenceGraph, HasAnEdgeForEachObstacle) {
  const PlanScene scene = plan_scene(two_towers());
  const Vec3 up{0, 0, 1};
  const PrecedenceGraph graph = graph_of(scene, straight_plan({{2, up}, {1, up}, {4, up}, {3, up}}));
  EXPECT_EQ(graph.before, (std::vector<std::vector<std::uint32_t>>{{}, {0}, {}, {2}}));
  EXPECT_EQ(graph.ranks, (std::vector<std::uint32_t>{0, 1, 0, 1}));
}

TEST(PrecedenceGraph, DependsOnTheMotionOfAStep) {
  const PlanScene scene = plan_scene(two_towers());
  const Vec3 up{0, 0, 1}, sideways{0, 1, 0}, along{1, 0, 0};
  // c leaves sideways from under d; a moves along, through the place of the other tower.
  const PrecedenceGraph graph = graph_of(scene, straight_plan({{3, sideways}, {2, up}, {4, up}, {1, along}}));
  EXPECT_EQ(graph.before, (std::vector<std::vector<std::uint32_t>>{{}, {}, {}, {0}}))
      << "it meets neither b on a nor d on c";
}

TEST(PrecedenceGraph, LeavesOutWhatFollowsFromOtherEdges) {
  const PlanScene scene =
      plan_scene(scenes::assembly({scenes::component("plate", scenes::box({-20, -20, -5}, {20, 20, 0})),
                                   scenes::component("low", scenes::box({-5, -5, 0}, {5, 5, 5})),
                                   scenes::component("mid", scenes::box({-5, -5, 5}, {5, 5, 10})),
                                   scenes::component("top", scenes::box({-5, -5, 10}, {5, 5, 15}))}));
  const Vec3 up{0, 0, 1};
  const PrecedenceGraph graph = graph_of(scene, straight_plan({{3, up}, {2, up}, {1, up}}));
  EXPECT_EQ(graph.before, (std::vector<std::vector<std::uint32_t>>{{}, {0}, {1}}));
  EXPECT_EQ(graph.ranks, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(PrecedenceGraph, AllowsOnlyOrdersThatPassTheAudit) {
  std::vector<std::pair<PlanScene, Plan>> cases;
  const Vec3 up{0, 0, 1};
  cases.emplace_back(plan_scene(two_towers()), straight_plan({{2, up}, {1, up}, {4, up}, {3, up}}));
  for (const Assembly& assembly : {scenes::stack_in_tube(4), scenes::dovetail(0.01).assembly}) {
    const PlanScene scene = plan_scene(assembly);
    cases.emplace_back(scene, plan_disassembly(scene.assembly, scene.pairs, {}));
  }
  for (const auto& [scene, plan] : cases) {
    std::size_t orders = 0;
    for_each_order(graph_of(scene, plan), [&](const std::vector<std::uint32_t>& order) {
      ++orders;
      EXPECT_TRUE(is_clean(scene, reordered(plan, order))) << scene.assembly.components[1].name;
    });
    EXPECT_GE(orders, 1u);
  }
}

TEST(PrecedenceGraph, ForbidsOrdersThatDoNot) {
  const PlanScene scene = plan_scene(two_towers());
  const Vec3 up{0, 0, 1};
  const Plan plan = straight_plan({{2, up}, {1, up}, {4, up}, {3, up}});
  std::size_t orders = 0;
  for_each_order(graph_of(scene, plan), [&](const auto&) { ++orders; });
  EXPECT_EQ(orders, 6u);
  EXPECT_FALSE(is_clean(scene, reordered(plan, {1, 0, 2, 3}))) << "a first, through b";
}

TEST(PrecedenceGraph, PutsABodyBeforeItsParts) {
  const PlanScene scene = plan_scene(two_towers());
  const Vec3 up{0, 0, 1};
  Plan plan = straight_plan({{2, up}, {2, up}, {4, up}});
  plan.steps[0].components = {ComponentId(1), ComponentId(2)};
  plan.steps[1].part_of = 0;
  EXPECT_EQ(graph_of(scene, plan).before, (std::vector<std::vector<std::uint32_t>>{{}, {0}, {}}));
  EXPECT_EQ(reordered(plan, {2, 0, 1}).steps[2].part_of, 1u);
}

TEST(PrecedenceGraph, UsesBoxesForCurvedPaths) {
  const PlanScene scene = plan_scene(two_towers());
  const Vec3 up{0, 0, 1};
  Plan plan = straight_plan({{2, up}, {1, up}, {4, up}, {3, up}});
  plan.steps[1].poses = {{{0, 20, 0}, {}}};
  plan.steps[3].poses = {{{0, 0, 1}, {}}};
  EXPECT_EQ(graph_of(scene, plan).before, (std::vector<std::vector<std::uint32_t>>{{}, {0}, {}, {2}}));
}

TEST(PrecedenceGraph, KeepsThePlansOrderIfItEndsEarly) {
  const PlanScene scene = plan_scene(two_towers());
  const Vec3 up{0, 0, 1};
  const PrecedenceGraph graph = precedence_graph(scene.assembly, scene.pairs,
                                                 straight_plan({{2, up}, {1, up}, {4, up}}), {}, [] { return false; });
  EXPECT_EQ(graph.ranks, (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace dismantle
