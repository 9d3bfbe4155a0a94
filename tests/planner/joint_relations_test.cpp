// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/joint_relations.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

constexpr Vec3 kUp{0, 0, 1}, kDown{0, 0, -1}, kAside{1, 0, 0};
constexpr std::size_t kCount = 8;
const ComponentId kBase(0), kCover(1), kBolt(2), kWasher(3), kLowerWasher(4), kNut(5), kScrew(6), kOther(7);

/// A bolt with two washers and a nut through base and cover, and a screw through the cover into the base.
std::vector<Joint> two_joints() {
  Joint bolt;
  bolt.screw = kBolt;
  bolt.nuts = {kNut};
  bolt.head_washers = {kWasher};
  bolt.nut_washers = {kLowerWasher};
  bolt.held = {kBase, kCover};
  bolt.thread_in = kNut;
  bolt.axis = kUp;
  bolt.screw_leaves = {20, 16, 0.8, false, true};
  bolt.nut_leaves = {10, 8, 0.8, false, true};
  Joint screw;
  screw.screw = kScrew;
  screw.held = {kBase, kCover};
  screw.thread_in = kBase;
  screw.axis = kUp;
  screw.screw_leaves = {5, 4, 0.8, false, true};
  return {bolt, screw};
}

class Relations : public ::testing::Test {
 protected:
  Relations() : relations_(joints_, groups_, kCount) {}
  static ComponentSet all_but(const std::vector<ComponentId>& gone) {
    ComponentSet present = ComponentSet::all(kCount);
    present.erase(gone);
    return present;
  }
  static PlanStep step(const std::vector<ComponentId>& components, const Vec3& exit) {
    PlanStep made;
    made.components = components;
    made.exit = exit;
    return made;
  }
  const std::vector<Joint> joints_ = two_joints();
  RigidGroups groups_{kCount};
  JointRelations relations_;
};

TEST_F(Relations, BlockWhatIsHeldUntilAllItsFastenersAreGone) {
  EXPECT_EQ(relations_.blocker(kCover, kUp, all_but({})), kBolt);
  EXPECT_EQ(relations_.blocker(kCover, kUp, all_but({kBolt, kNut})), kScrew);
  EXPECT_FALSE(relations_.blocker(kCover, kUp, all_but({kBolt, kScrew})));
  EXPECT_FALSE(relations_.blocker(kOther, kUp, all_but({})));
}

TEST_F(Relations, LetFastenersLeaveAlongTheirAxesOnly) {
  EXPECT_FALSE(relations_.blocker(kScrew, kUp, all_but({})));
  EXPECT_TRUE(relations_.blocker(kScrew, kDown, all_but({}))) << "its head is above";
  EXPECT_TRUE(relations_.blocker(kScrew, kAside, all_but({})));
  EXPECT_FALSE(relations_.blocker(kScrew, kAside, all_but({kBase, kCover}))) << "it is in nothing any more";
  EXPECT_FALSE(relations_.blocker(kNut, kDown, all_but({})));
  EXPECT_EQ(relations_.blocker(kNut, kAside, all_but({})), kBolt);
}

TEST_F(Relations, KeepWashersUntilTheirSideIsOpen) {
  EXPECT_EQ(relations_.blocker(kWasher, kUp, all_but({kNut})), kBolt);
  EXPECT_EQ(relations_.blocker(kLowerWasher, kDown, all_but({})), kNut);
  EXPECT_FALSE(relations_.blocker(kLowerWasher, kDown, all_but({kNut})));
  EXPECT_EQ(relations_.washers_with(kBolt, kUp), std::vector<ComponentId>{kWasher});
  EXPECT_EQ(relations_.washers_with(kNut, kDown), std::vector<ComponentId>{kLowerWasher});
}

TEST_F(Relations, MoveJointsAsOneBody) {
  EXPECT_EQ(relations_.tied_to(kScrew, all_but({})), (std::vector<ComponentId>{kBase, kCover}));
  EXPECT_EQ(relations_.tied_to(kCover, all_but({kBolt})), (std::vector<ComponentId>{kBase, kScrew}));
  EXPECT_TRUE(relations_.tied_to(kCover, all_but({kBolt, kScrew})).empty());
}

TEST_F(Relations, TellWhatAStepTears) {
  EXPECT_EQ(relations_.torn_by(step({kCover}, kUp), all_but({})), (std::vector<ComponentId>{kBolt, kScrew}));
  EXPECT_EQ(relations_.torn_by(step({kCover}, kUp), all_but({kNut})), std::vector<ComponentId>{kScrew})
      << "a bolt without its nut holds nothing";
  EXPECT_EQ(relations_.torn_by(step({kCover, kScrew}, kUp), all_but({kBolt})), std::vector<ComponentId>{kScrew});
  EXPECT_TRUE(relations_.torn_by(step({kBase, kCover, kScrew}, kUp), all_but({kBolt})).empty());
  EXPECT_TRUE(relations_.torn_by(step({kScrew}, kUp), all_but({})).empty());
  EXPECT_EQ(relations_.torn_by(step({kScrew}, kAside), all_but({})), std::vector<ComponentId>{kBase});
}

TEST_F(Relations, TellHowAFastenerIsUnscrewed) {
  EXPECT_EQ(relations_.unscrewing(step({kScrew}, kUp), all_but({})), joints_[1].screw_leaves);
  EXPECT_EQ(relations_.unscrewing(step({kBolt, kWasher}, kUp), all_but({})), joints_[0].screw_leaves);
  EXPECT_EQ(relations_.unscrewing(step({kNut}, kDown), all_but({})), joints_[0].nut_leaves);
  EXPECT_FALSE(relations_.unscrewing(step({kBolt}, kUp), all_but({kNut})));
  EXPECT_FALSE(relations_.unscrewing(step({kScrew}, kAside), all_but({})));
  EXPECT_FALSE(relations_.unscrewing(step({kCover}, kUp), all_but({})));
}

TEST_F(Relations, TellThePitchOfAPathThatTurns) {
  PlanStep turned = step({kScrew}, kUp);
  turned.tier = PlanTier::Helical;
  for (int k = 1; k <= 8; ++k)
    turned.poses.push_back({{0, 0, -0.2 * k}, quat_about({0, 0, 1}, 1.5707963267948966 * k)});
  turned.exit = kDown;
  const auto found = relations_.unscrewing(turned, all_but({}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->turns, 2, 1e-9);
  EXPECT_NEAR(found->travel, 1.6, 1e-9);
  EXPECT_NEAR(found->pitch, 0.8, 1e-9);
  EXPECT_TRUE(found->left_handed) << "a left-hand thread comes out clockwise";
  EXPECT_FALSE(found->nominal);
}

TEST_F(Relations, TellTheTurnsOfTheWholeThreadWhereAPathLeavesItEarly) {
  // Half a turn, then straight along the axis, as threads that are drawn into each other allow.
  PlanStep left = step({kScrew}, kUp);
  left.tier = PlanTier::Helical;
  for (int k = 1; k <= 2; ++k) left.poses.push_back({{0, 0, 0.2 * k}, quat_about({0, 0, 1}, 1.5707963267948966 * k)});
  auto found = relations_.unscrewing(left, all_but({}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->travel, 4, 1e-9);
  EXPECT_NEAR(found->turns, 5, 1e-9);
  EXPECT_NEAR(found->pitch, 0.8, 1e-9);
  EXPECT_FALSE(found->left_handed);
  // A path that turns for most of it tells how many turns there are.
  for (int k = 3; k <= 14; ++k) left.poses.push_back({{0, 0, 0.2 * k}, quat_about({0, 0, 1}, 1.5707963267948966 * k)});
  found = relations_.unscrewing(left, all_but({}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->turns, 3.5, 1e-9);
}

TEST_F(Relations, GoOnWithTheStackThenWithWhatHoldsTheSamePart) {
  const std::vector<ComponentId> kinds{kBase, kCover, kBolt, kWasher, kWasher, kNut, kBolt, kOther};
  EXPECT_EQ(relations_.next_after(step({kNut}, kDown), kinds, all_but({kNut})).front(), kLowerWasher);
  const std::vector<ComponentId> next =
      relations_.next_after(step({kBolt, kWasher}, kUp), kinds, all_but({kNut, kLowerWasher, kBolt, kWasher}));
  ASSERT_FALSE(next.empty());
  EXPECT_EQ(next.front(), kScrew);
  const ComponentSet without_fasteners = all_but({kNut, kLowerWasher, kBolt, kWasher, kScrew});
  const std::vector<ComponentId> freed = relations_.next_after(step({kScrew}, kUp), kinds, without_fasteners);
  EXPECT_EQ(freed, (std::vector<ComponentId>{kBase, kCover}));
}

TEST_F(Relations, IgnoreFastenersThatMoveWithOthers) {
  RigidGroups groups(kCount);
  groups.unite(std::vector<ComponentId>{kBolt, kOther});
  const JointRelations relations(joints_, groups, kCount);
  EXPECT_FALSE(relations.is_fastener(kBolt));
  EXPECT_EQ(relations.blocker(kCover, kUp, all_but({})), kScrew);
}

}  // namespace
}  // namespace dismantle
