// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/session.h"

#include "tests/session/session_table.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using namespace scenes;

constexpr double kTolerance = kTableTolerance;

TEST(Session, RecordsEachDragAsOneMove) {
  Table table(wall_and_block());
  table.move(kFirst, {-5, 0, 0}, 10);
  table.move(kFirst, {0, 3, 0}, 3);
  const Path path = table.session().recording();
  ASSERT_EQ(path.moves.size(), 2u);
  EXPECT_EQ(path.moves[0].label, "move block");
  EXPECT_EQ(path.moves[0].frames.size(), 11u);
  EXPECT_DOUBLE_EQ(path.moves[0].frames.back().time, 0.1);
  EXPECT_EQ(path.moves[1].frames.back().pose.position, (Vec3{-5, 3, 0}));
}

TEST(Session, SlidesAlongTheWall) {
  Table table(wall_and_block());
  const StepResult last = table.drag(kFirst, {30, 20, 0}, 60);
  EXPECT_NEAR(last.pose.position.x, 10.5, kTolerance);
  EXPECT_NEAR(last.pose.position.y, 20, 0.05);
}

TEST(Session, KeepsNoEntryOfADragThatWentNowhere) {
  Table table(wall_and_block());
  EXPECT_TRUE(table.session().hold(kFirst).ok());
  EXPECT_FALSE(table.session().release());
  EXPECT_FALSE(table.session().undo().ok());
}

TEST(Session, TakesADragBackInMidDragAndDoesItAgain) {
  Table table(wall_and_block());
  table.move(kFirst, {0, 4, 0}, 4);
  table.drag(kFirst, {-5, 0, 0}, 10);
  EXPECT_TRUE(table.session().undo().ok());
  EXPECT_EQ(table.session().activity(), SessionActivity::Idle);
  EXPECT_EQ(table.pose(0).position, (Vec3{0, 4, 0}));
  EXPECT_EQ(table.session().recording().moves.size(), 1u);
  EXPECT_TRUE(table.session().redo().ok());
  EXPECT_EQ(table.pose(0).position, (Vec3{-5, 4, 0}));
  EXPECT_EQ(table.session().recording().moves.size(), 2u);
}

TEST(Session, UndoesNothingElseIfTheDragHasNotMovedYet) {
  Table table(wall_and_block());
  table.move(kFirst, {0, 4, 0}, 4);
  EXPECT_TRUE(table.session().hold(kFirst).ok());
  EXPECT_TRUE(table.session().undo().ok());
  EXPECT_EQ(table.pose(0).position, (Vec3{0, 4, 0}));
}

TEST(Session, GoesBackToTheStartOfACancelledDragWithoutAnEntry) {
  Table table(wall_and_block());
  table.drag(kFirst, {-5, 0, 0}, 10);
  table.session().cancel_drag();
  EXPECT_EQ(table.pose(0), Pose{});
  EXPECT_TRUE(table.session().done().empty());
  EXPECT_FALSE(table.session().redo().ok());
}

TEST(Session, ForgetsWhatWasUndoneOnceSomethingElseIsDone) {
  Table table(wall_and_block());
  table.move(kFirst, {-5, 0, 0}, 5);
  EXPECT_TRUE(table.session().undo().ok());
  table.move(kFirst, {0, 5, 0}, 5);
  EXPECT_FALSE(table.session().redo().ok());
  EXPECT_EQ(table.session().done().size(), 1u);
}

TEST(Session, UndoesAndRedoesToTheSameBits) {
  Table table(wall_and_block());
  std::vector<std::vector<Pose>> states{{table.pose(0), table.pose(1)}};
  for (int i = 0; i < 6; ++i) {
    table.move(i % 2 ? kSecond : kFirst, {0.1 + i, 0.3 * i, -0.7}, 9);
    states.push_back({table.pose(0), table.pose(1)});
  }
  for (std::size_t i = states.size() - 1; i-- > 0;) {
    ASSERT_TRUE(table.session().undo().ok());
    EXPECT_EQ((std::vector<Pose>{table.pose(0), table.pose(1)}), states[i]);
  }
  for (std::size_t i = 1; i < states.size(); ++i) {
    ASSERT_TRUE(table.session().redo().ok());
    EXPECT_EQ((std::vector<Pose>{table.pose(0), table.pose(1)}), states[i]);
  }
}

TEST(Session, LetsAnOverlappingPairPartAgainAfterItsPartingWasUndone) {
  Table table(scenes::assembly(
      {component("lump", box({0, 0, 0}, {10, 10, 10})), component("body", box({5, -5, -5}, {30, 15, 15}))}));
  table.move(kFirst, {-20, 0, 0}, 20);
  EXPECT_EQ(table.pose(0).position.x, -20);
  table.drag(kFirst, {20, 0, 0}, 20);  // separated for good: it cannot enter again
  EXPECT_NEAR(table.pose(0).position.x, -5, kTolerance);
  EXPECT_TRUE(table.session().undo().ok());
  EXPECT_TRUE(table.session().undo().ok());
  EXPECT_EQ(table.pose(0), Pose{});
  table.move(kFirst, {-3, 0, 0}, 3);
  EXPECT_EQ(table.pose(0).position.x, -3);  // still inside, and free to move
}

TEST(Session, MovesASetAsOneBodyAndRefusesATornOne) {
  Table table(wall_and_block());
  table.move(kBoth, {0, 0, 5}, 5);
  EXPECT_EQ(table.pose(0), table.pose(1));
  EXPECT_EQ(table.session().done()[0].label, "move block and wall");
  table.move(kFirst, {-1, 0, 0}, 1);
  const Result<Done> torn = table.session().hold(kBoth);
  ASSERT_FALSE(torn.ok());
  EXPECT_NE(torn.error().message.find("'block'"), std::string::npos);
}

TEST(Session, GrabsNothingThatIsHidden) {
  Table table(wall_and_block());
  table.session().visibility().hide(kFirst);
  EXPECT_FALSE(table.session().hold(kFirst).ok());
  EXPECT_FALSE(table.session().hold({}).ok());
}

TEST(Session, SaysUntilWhenASetRested) {
  Table table(wall_and_block());
  ASSERT_TRUE(table.session().hold(kFirst).ok());
  table.session().drag({{-1, 0, 0}, {}}, 0.5);
  table.session().drag({{-2, 0, 0}, {}}, 3);
  table.session().release();
  const std::vector<Frame> frames = table.session().recording().moves.at(0).frames;
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_EQ(frames[3].pose.position.x, -1);
  EXPECT_GT(frames[3].time, 2.9);
}

TEST(Session, IsAsNewAfterReset) {
  Table table(wall_and_block());
  table.move(kFirst, {-5, 0, 0}, 5);
  table.session().visibility().hide(kSecond);
  table.session().reset();
  EXPECT_EQ(table.pose(0), Pose{});
  EXPECT_TRUE(table.session().recording().moves.empty());
  EXPECT_FALSE(table.session().visibility().is_hidden(ComponentId(1)));
}

}  // namespace
}  // namespace dismantle
