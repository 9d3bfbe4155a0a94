// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/removal_facts.h"

#include "tests/instructions/bolted_lid.h"

namespace dismantle {
namespace {

struct Lid {
  Assembly assembly = scenes::bolted_lid();
  PairStates pairs = scenes::bolted_lid_pairs();
  std::vector<WorkStep> steps =
      work_steps(assembly, scenes::timeline_of(assembly, scenes::bolted_lid_path()), PathDirection::Forward);
};

TEST(PathClearance, EndsContactWhenASetLeavesAndMeasuresTheRest) {
  Lid lid;
  RemovalFacts facts(lid.assembly, lid.pairs, {});
  const PathClearance up = facts.clearance(lid.steps[0], lid.steps[0].removals[0]);
  EXPECT_EQ(up.contact_length, 0);
  EXPECT_EQ(up.last_contact, ComponentId(1));
  EXPECT_FALSE(up.nearest.valid()) << "the lid that it leaves does not count";

  const RemovalMove along{{ComponentId(2)}, {{}, {{70, 0, 0}, {}}}};
  const PathClearance slid = facts.clearance(lid.steps[0], along);
  EXPECT_EQ(slid.contact_length, 70) << "it touches the lid all along";
  EXPECT_FALSE(slid.nearest.valid());

  const RemovalMove over{{ComponentId(2)}, {{}, {{0, 0, 6}, {}}, {{40, 0, 6}, {}}}};
  const PathClearance passing = facts.clearance(lid.steps[0], over);
  EXPECT_EQ(passing.nearest, ComponentId(3));
  EXPECT_NEAR(passing.min_distance, 2, 1e-9) << "over the other head, which is 4 mm high";
}

TEST(PathClearance, DoesNotCountWhatWasPutAside) {
  Lid lid;
  WorkStep step = lid.steps[0];
  step.before[3].position = {25, 0, 20};  // the other head, near the path of this one
  RemovalFacts facts(lid.assembly, lid.pairs, {});
  const RemovalMove over{{ComponentId(2)}, {{}, {{0, 0, 6}, {}}, {{30, 0, 22}, {}}}};
  EXPECT_FALSE(facts.clearance(step, over).nearest.valid());
}

TEST(PathClearance, TellsNothingOfWhatIsFarForTheSizeOfTheSet) {
  const Assembly a = scenes::assembly({scenes::component("bar", scenes::box({0, 0, 0}, {10, 0.1, 0.1})),
                                       scenes::component("near", scenes::box({0, 0, -5}, {10, 1, -1.9})),
                                       scenes::component("far", scenes::box({0, 2.2, 0}, {10, 9, 1}))});
  const PairStates pairs{0.01, {}};
  RemovalFacts facts(a, pairs, {});
  const WorkStep step{{{{ComponentId(0)}, {{}, {{0, 0, 100}, {}}}}}, std::vector<Pose>(3)};
  EXPECT_EQ(facts.clearance(step, step.removals[0]).nearest, ComponentId(1));
  const WorkStep up{{{{ComponentId(0)}, {{{0, 0, 1}, {}}, {{0, 0, 100}, {}}}}}, std::vector<Pose>(3)};
  EXPECT_FALSE(facts.clearance(up, up.removals[0]).nearest.valid());
}

TEST(UnsupportedAfter, IsWhatStoodOnWhatIsTakenAway) {
  // A shelf under a cup: the shelf moves sideways. The cup's neighbour, a wall, does not support it.
  const Assembly a = scenes::assembly({scenes::component("wall", scenes::box({-10, -50, -50}, {0, 50, 50})),
                                       scenes::component("shelf", scenes::box({0, -5, -2}, {20, 5, 0})),
                                       scenes::component("cup", scenes::box({5, -3, 0}, {12, 3, 9})),
                                       scenes::component("lamp", scenes::box({5, -3, -9}, {12, 3, -2}))});
  const auto contact = [](std::uint32_t p, std::uint32_t q) {
    return ComponentPair{ComponentId(p), ComponentId(q), PairState::Contact, 0, 0, 0.01};
  };
  PairStates pairs{0.01, {contact(0, 1), contact(1, 2), contact(1, 3)}};
  const WorkStep step{{{{ComponentId(1)}, {{}, {{100, 0, 0}, {}}}}}, std::vector<Pose>(4)};
  EXPECT_EQ(RemovalFacts(a, pairs, {}).unsupported_after(step, ComponentId(0)),
            std::vector<ComponentId>{ComponentId(2)})
      << "the lamp was unsupported before, too";

  pairs.pairs.insert(pairs.pairs.begin() + 1, {ComponentId(0), ComponentId(2), PairState::Overlapping, 0, 0.1, 0.11});
  EXPECT_TRUE(RemovalFacts(a, pairs, {}).unsupported_after(step, ComponentId(0)).empty()) << "it fits into the wall";
}

TEST(UnsupportedAfter, IsNothingIfTheRestStandsOnTheGround) {
  Lid lid;
  RemovalFacts facts(lid.assembly, lid.pairs, {});
  for (const WorkStep& step : lid.steps) EXPECT_TRUE(facts.unsupported_after(step, ComponentId(0)).empty());
}

TEST(StationaryComponents, AreThoseThatNoStepMovesTheLargestFirst) {
  Lid lid;
  EXPECT_EQ(stationary_components(lid.assembly, lid.steps), std::vector<ComponentId>{ComponentId(0)});
  lid.steps.pop_back();
  EXPECT_EQ(stationary_components(lid.assembly, lid.steps), (std::vector<ComponentId>{ComponentId(1), ComponentId(0)}));
}

}  // namespace
}  // namespace dismantle
