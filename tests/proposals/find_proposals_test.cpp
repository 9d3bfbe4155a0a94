// SPDX-License-Identifier: Apache-2.0
#include "dismantle/proposals/find_proposals.h"

#include "dismantle/audit/audit_path.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/planner/plan_disassembly.h"
#include "dismantle/planner/plan_path.h"
#include "tests/proposals/ring_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace dismantle {
namespace {

PairStates states_of(const Assembly& assembly) {
  ClassifyOptions options;
  options.tolerance = 0.01;
  return *classify_pairs(assembly, options);
}

std::vector<Proposal> proposals_for(const Assembly& assembly) {
  return find_proposals(assembly, states_of(assembly));
}

std::vector<std::string> names(const Assembly& assembly, const std::vector<ComponentId>& components) {
  std::vector<std::string> names;
  for (const ComponentId c : components) names.push_back(assembly[c].name);
  std::sort(names.begin(), names.end());
  return names;
}

TEST(FindProposals, TakesBallsBetweenTwoRacesForABearing) {
  std::vector<Component> components{scenes::component("shaft", scenes::tube(9.9, 0, -30, 30, 32)),
                                    scenes::component("inner", scenes::tube(12, 10, -4, 4, 48)),
                                    scenes::component("outer", scenes::tube(20, 18, -4, 4, 48)),
                                    scenes::component("block", scenes::tube(40, 20.1, -5, 5, 48))};
  for (int k = 0; k < 8; ++k) {
    const double angle = kTurn * k / 8;
    components.push_back(scenes::component("ball " + std::to_string(k),
                                           scenes::ball(2.9, {15 * std::cos(angle), 15 * std::sin(angle), 0})));
  }
  const Assembly assembly = scenes::assembly(std::move(components));
  const std::vector<Proposal> found = proposals_for(assembly);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, Proposal::Kind::Together);
  EXPECT_EQ(names(assembly, found[0].components),
            (std::vector<std::string>{"ball 0", "ball 1", "ball 2", "ball 3", "ball 4", "ball 5", "ball 6", "ball 7",
                                      "inner", "outer"}));
  EXPECT_NE(found[0].reason.find("8 equal balls"), std::string::npos);
}

TEST(FindProposals, TakesABoardWithWhatTouchesNothingElse) {
  std::vector<Component> components{scenes::component("sheet", scenes::box({0, 0, 0}, {100, 60, 1.6})),
                                    scenes::component("case", scenes::box({-5, -5, -10}, {105, 65, -5}))};
  for (int k = 0; k < 12; ++k)
    components.push_back(
        scenes::component("chip " + std::to_string(k), scenes::box({8.0 * k + 1, 20, 1.5}, {8.0 * k + 5, 25, 4})));
  for (const double x : {2.0, 95.0})  // they stand on the case
    components.push_back(scenes::component("post", scenes::box({x, 2, -5}, {x + 3, 5, 0})));
  const Assembly assembly = scenes::assembly(std::move(components));
  const std::vector<Proposal> found = proposals_for(assembly);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].components.size(), 13u);
  EXPECT_EQ(found[0].name, "sheet");
  const std::vector<std::string> all = names(assembly, found[0].components);
  EXPECT_EQ(std::count(all.begin(), all.end(), "case") + std::count(all.begin(), all.end(), "post"), 0);
}

TEST(FindProposals, TakesSmallClustersOfSolidsOnABoardAlong) {
  std::vector<Component> components{scenes::component("sheet", scenes::box({0, 0, 0}, {100, 60, 1.6}))};
  for (int k = 0; k < 12; ++k)
    components.push_back(
        scenes::component("chip " + std::to_string(k), scenes::box({8.0 * k + 1, 20, 1.5}, {8.0 * k + 5, 25, 4})));
  // A body with its leads: the body does not touch the sheet.
  components.push_back(scenes::component("body", scenes::box({10, 40, 2}, {16, 44, 4})));
  for (const double x : {10.0, 15.0})
    components.push_back(scenes::component("lead", scenes::box({x, 39, 1.5}, {x + 1, 41, 2.5})));
  // A tower of two, too large to be soldered on.
  components.push_back(scenes::component("block", scenes::box({30, 35, 1.6}, {60, 55, 20})));
  components.push_back(scenes::component("roof", scenes::box({30, 35, 20}, {60, 55, 22})));
  const Assembly assembly = scenes::assembly(std::move(components));
  const std::vector<Proposal> found = proposals_for(assembly);
  ASSERT_EQ(found.size(), 1u);
  const std::vector<std::string> all = names(assembly, found[0].components);
  EXPECT_EQ(all.size(), 16u);
  EXPECT_EQ(std::count(all.begin(), all.end(), "lead"), 2);
  EXPECT_EQ(std::count(all.begin(), all.end(), "body"), 1);
  EXPECT_EQ(std::count(all.begin(), all.end(), "block") + std::count(all.begin(), all.end(), "roof"), 0);
}

TEST(FindProposals, TakesWhatIsOfOneBearingByItsNames) {
  std::vector<Component> components;
  for (const double x : {0.0, 50.0})  // two bearings of one name
    for (const char* part : {"cup", "cone", "roller", "roller#2"})
      components.push_back(
          scenes::component("Front bearing " + std::string(part), scenes::box({x, 0, 0}, {x + 9, 9, 9})));
  components.push_back(scenes::component("Front bearing cover", scenes::box({0, 0, 9}, {9, 9, 10})));
  const Assembly assembly = scenes::assembly(std::move(components));
  const std::vector<Proposal> found = proposals_for(assembly);
  ASSERT_EQ(found.size(), 2u);
  for (const Proposal& proposal : found) {
    EXPECT_EQ(proposal.name, "front bearing");
    EXPECT_EQ(proposal.components.size(), 4u);
  }
}

TEST(FindProposals, GoesByTheNamesOfSubAssembliesAndByProductsOfSeveralSolids) {
  std::vector<Component> components;
  for (int k = 0; k < 9; ++k)
    components.push_back(scenes::component("part", scenes::box({3.0 * k, 0, 0}, {3.0 * k + 1, 1, 1})));
  Assembly assembly = scenes::assembly(std::move(components));
  assembly.tree = {{"product", 0},       {"DC Motor", 0}, {"gear stage", 1},
                   {"Motor bracket", 0}, {"nut M3", 0},   {"nut M3", 0}};
  const std::array<std::uint32_t, 9> parents{1, 2, 2, 3, 3, 4, 4, 5, 5};
  const std::array<const char*, 9> own{"stator", "wheel",    "pinion",   "sheet",   "foot",
                                       "nut M3", "nut M3#2", "nut M3#3", "nut M3#4"};
  for (std::uint32_t c = 0; c < 9; ++c) {
    assembly.components[c].name = own[c];
    assembly.components[c].tree_node = static_cast<std::uint32_t>(assembly.tree.size());
    assembly.tree.push_back({own[c], parents[c]});
  }
  const std::vector<Proposal> found = proposals_for(assembly);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(names(assembly, found[0].components), (std::vector<std::string>{"pinion", "stator", "wheel"}));
  EXPECT_EQ(found[0].name, "DC Motor");
  EXPECT_EQ(found[0].reason, "its name says 'motor'");
  EXPECT_EQ(names(assembly, found[1].components), (std::vector<std::string>{"nut M3", "nut M3#2"}));
  EXPECT_EQ(found[1].reason, "one product of 2 solids, placed 2 times");
}

TEST(FindProposals, ProposesNothingThatIsEverything) {
  Assembly assembly = scenes::assembly({scenes::component("a", scenes::box({0, 0, 0}, {1, 1, 1})),
                                        scenes::component("b", scenes::box({2, 0, 0}, {3, 1, 1}))});
  assembly.tree = {{"all", 0}, {"Motor", 0}, {"a", 1}, {"b", 1}};
  assembly.components[0].tree_node = 2;
  assembly.components[1].tree_node = 3;
  EXPECT_TRUE(proposals_for(assembly).empty());
}

TEST(FindProposals, KnowsAnORingAndACirclipByTheirShapes) {
  const Assembly groove = scenes::ring_in_groove();
  const std::vector<Proposal> seal = proposals_for(groove);
  ASSERT_EQ(seal.size(), 1u);
  EXPECT_EQ(seal[0].kind, Proposal::Kind::Flexible);
  EXPECT_EQ(seal[0].reason, "a torus, as O-rings are");
  EXPECT_NEAR(seal[0].flexible.overlap, 2, 0.05);
  EXPECT_NEAR(std::abs(seal[0].flexible.axis.z), 1, 1e-4);
  const Assembly clip = scenes::assembly({scenes::component("pin", scenes::tube(9, 0, -20, 20, 48)),
                                          scenes::component("ring", scenes::open_ring(8.9, 11, 1, 0.8))});
  const std::vector<Proposal> open = proposals_for(clip);
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].reason, "an open ring, as circlips are");
  // One that touches nothing needs no licence.
  EXPECT_TRUE(proposals_for(scenes::assembly({scenes::component("pin", scenes::tube(5, 0, -20, 20, 48)),
                                              scenes::component("ring", scenes::open_ring(8.9, 11, 1, 0.8))}))
                  .empty());
}

TEST(FlexibleParts, ComeOffTheirShaftsAlongTheirAxesOnly) {
  const Assembly assembly = scenes::ring_in_groove();
  PlanOptions options;
  options.slide_effort = options.sample_effort = 0;
  PairStates states = states_of(assembly);
  EXPECT_FALSE(plan_disassembly(assembly, states, options).complete());
  const Result<std::vector<FlexiblePart>> seal = named_flexible(assembly, std::vector<std::string>{"se*=1.7"});
  ASSERT_TRUE(seal.ok());
  options.flexible = *seal;
  allow_flexible(states, *seal);
  const Plan plan = plan_disassembly(assembly, states, options);
  ASSERT_TRUE(plan.complete());
  ASSERT_EQ(plan.steps.size(), 1u);
  EXPECT_NEAR(std::abs(plan.steps[0].exit.z), 1, 1e-3);
  Path path = plan_path(assembly, states, plan);
  ASSERT_EQ(path.pairs.size(), 1u);
  EXPECT_EQ(path.pairs[0].state, PathPairState::Declared);
  EXPECT_TRUE(audit_path(assembly, path, {}).holds());
  path.pairs[0].allowed_depth = 1.3;  // the groove is 1.5 deep, and the ring is 0.05 in its floor
  EXPECT_FALSE(audit_path(assembly, path, {}).holds());
  // One that gives too little stays.
  PairStates little = states_of(assembly);
  options.flexible = *named_flexible(assembly, std::vector<std::string>{"seal=1.2"});
  allow_flexible(little, options.flexible);
  EXPECT_FALSE(plan_disassembly(assembly, little, options).complete());
}

TEST(NamedFlexible, SaysWhatFitsNothing) {
  const Assembly assembly = scenes::ring_in_groove();
  const auto error = [&](const char* text) {
    const auto found = named_flexible(assembly, std::vector<std::string>{text});
    return found.ok() ? std::string() : found.error().message;
  };
  EXPECT_NE(error("gasket").find("'gasket' is unknown"), std::string::npos);
  EXPECT_NE(error("seal=").find("no number above 0"), std::string::npos);
  EXPECT_NE(error("seal=-1").find("no number above 0"), std::string::npos);
  EXPECT_NE(error("seal=1x").find("no number above 0"), std::string::npos);
  EXPECT_EQ(error("seal"), "");
  EXPECT_EQ(error("*=0.5"), "");
}

}  // namespace
}  // namespace dismantle
